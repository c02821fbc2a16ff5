// Ready-made parts of scenes: constant media and plain materials.
#include <fmt/format.h>

#include <algorithm>

#include "scene/scene.h"

namespace tyndall::scene {

namespace {

// Adds the constants of a colour to a program's outputs, one output when it is grey.
RgbOutputs add_constant_outputs(vm::Program& program, const Rgb& c) {
  RgbOutputs outputs{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (i > 0 && c[i] == c[i - 1]) {
      outputs[i] = outputs[i - 1];
      continue;
    }
    outputs[i] = static_cast<std::uint8_t>(program.outputs.size());
    program.outputs.push_back(static_cast<vm::Operand>(program.constants.size()));
    program.constants.push_back(c[i]);
  }
  return outputs;
}

bool all_uniform(const vm::Program& program) {
  return std::all_of(program.outputs.begin(), program.outputs.end(),
                     [&](vm::Operand output) { return program.uniform(output); });
}

}  // namespace

bool Medium::homogeneous() const { return all_uniform(full); }

MaterialId add_diffuse(Scene& scene, const Rgb& base_color, const Rgb& emission) {
  Material material;
  material.name = "diffuse";
  material.base_color = add_constant_outputs(material.program, base_color);
  if (!is_black(emission)) material.emission = add_constant_outputs(material.program, emission);
  material.given.resize(material.program.outputs.size());
  scene.materials.push_back(std::move(material));
  return MaterialId(scene.materials.size() - 1);
}

MaterialId add_surface(Scene& scene, const ConstantSurface& surface) {
  const optics::SurfaceParameters& p = surface.parameters;
  Material m;
  m.name = "surface";
  const auto add = [&](float value) { return add_constant_outputs(m.program, Rgb(value))[0]; };
  m.base_color = add_constant_outputs(m.program, p.base_color);
  if (!p.diffuse()) {
    m.metallic = add(p.metallic);
    m.roughness = add(p.roughness);
    m.specular = add(p.specular);
    if (p.transmission > 0) m.transmission = add(p.transmission);
    m.coat = add(p.coat);
    m.sheen = add_constant_outputs(m.program, p.sheen);
    m.ior = add(surface.ior);
  }
  if (surface.opacity < 1) m.opacity = add(surface.opacity);
  m.given.resize(m.program.outputs.size());
  scene.materials.push_back(std::move(m));
  return MaterialId(scene.materials.size() - 1);
}

MediumId add_constant_medium(Scene& scene, const ConstantMedium& given) {
  Medium medium;
  medium.name = "constant";
  medium.sigma_s = add_constant_outputs(medium.full, given.sigma_s);
  medium.sigma_t = add_constant_outputs(medium.full, given.sigma_t);
  if (!is_black(given.emission)) medium.emission = add_constant_outputs(medium.full, given.emission);
  medium.extinction_sigma_t = add_constant_outputs(medium.extinction, given.sigma_t);
  medium.given.resize(medium.full.outputs.size());
  if (!is_black(given.sigma_s)) {
    medium.phase = given.phase;
    if (medium.phase.empty()) medium.phase.push_back(PhaseLobe{});
  }
  scene.media.push_back(std::move(medium));
  return MediumId(scene.media.size() - 1);
}

std::string describe(const Clamp& clamp) {
  const auto text = [](double limit) {
    return limit < infinity ? fmt::format("{}", limit) : std::string(Clamp::off);
  };
  if (clamp.direct == clamp.indirect) return text(clamp.direct);
  return fmt::format("({}, {})", text(clamp.direct), text(clamp.indirect));
}

std::string describe(const Step& step) {
  if (step.fixed()) return fmt::format("{}", step.metres);
  if (step == Step{}) return "auto";
  return fmt::format("{}({}%)", step.proven ? "auto" : "adaptive", step.tolerance * 100);
}

namespace {

// A choice with its arguments.
template <class T>
std::string call_of(const T& choice) {
  std::string arguments;
  T::fields([&](auto member, const FieldInfo& info) {
    arguments += fmt::format("{}{}: {}", arguments.empty() ? "" : ", ", info.name, choice.*member);
  });
  return fmt::format("{}({})", T::keyword, arguments);
}

}  // namespace

std::string describe(const MultipleScattering& scattering) {
  return scattering.approximate ? call_of(*scattering.approximate) : std::string(MultipleScattering::full);
}

std::string describe(const ShutterCurve& curve) {
  return curve.trapezoid ? call_of(*curve.trapezoid) : std::string(ShutterCurve::box);
}

}  // namespace tyndall::scene
