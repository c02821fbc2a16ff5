#include "compile/lights/glowing_shapes.h"

#include "compile/compiled_scene.h"

namespace tyndall::compile {

namespace {

// The emission of a material, when it is one value and light.
std::optional<Rgb> constant_emission(const scene::Material& material) {
  if (!material.emission || material.opacity)
    return std::nullopt;  // what light goes through is found by paths alone
  Rgb emission;
  for (std::size_t c = 0; c < 3; ++c) {
    const vm::Operand operand = material.program.outputs[(*material.emission)[c]];
    if (!material.program.constant(operand)) return std::nullopt;
    emission[c] = material.program.constants[operand];
  }
  const bool shines = all_finite(emission) && min_component(emission) >= 0 && !is_black(emission);
  return shines ? std::optional(emission) : std::nullopt;
}

}  // namespace

std::vector<std::uint32_t> add_glowing_shapes(const scene::Scene& scene, const Vec3d& origin,
                                              std::vector<CompiledLight>& lights) {
  const Transform render_from_world = Transform::translate(-origin);
  std::vector<std::uint32_t> light_of_shape;
  auto moving = scene.motion.shapes.begin();
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const scene::ShapeInstance& shape = scene.shapes[i];
    if (moving != scene.motion.shapes.end() && moving->index == i) {
      ++moving;  // found by paths alone
      continue;
    }
    const auto* mesh = std::get_if<scene::Mesh>(&shape.shape);
    const auto* curves = std::get_if<scene::Curves>(&shape.shape);
    if ((mesh && !scene.meshes[mesh->mesh.index]->later.empty()) ||
        (curves && !scene.strand_sets[curves->strands.index].later.empty()))
      continue;  // so is what deforms
    const auto emission = constant_emission(scene.materials[shape.material.index]);
    if (!emission) continue;
    AnySurface surface = any_surface(scene, shape.shape, render_from_world * shape.world_from_object, origin,
                                     /*both_sides=*/true);
    if (!(surface.area() > 0)) continue;
    light_of_shape.resize(scene.shapes.size(), no_index);
    light_of_shape[i] = static_cast<std::uint32_t>(lights.size());
    lights.emplace_back(Compiled<scene::AreaLight>(std::move(surface), *emission));
  }
  return light_of_shape;
}

}  // namespace tyndall::compile
