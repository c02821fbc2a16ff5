#include "render/surface/surface_interaction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "shapes/mesh_at.h"

namespace tyndall::render {

namespace {

// What a mesh gives its materials besides the rest (vm::is_of_mesh), at a hit. A mesh without colours is
// white.
void look_up_mesh(const compile::SurfaceHit& hit, std::array<float, vm::input_count>& values) {
  const auto first = static_cast<std::size_t>(vm::Input::t_x);
  const std::array<std::size_t, 3> places{first, static_cast<std::size_t>(vm::Input::red),
                                          static_cast<std::size_t>(vm::Input::second_u)};
  std::fill(values.begin() + first, values.end(), 0.0f);
  std::fill_n(values.begin() + places[1], 4, 1.0f);
  if (!hit.mesh) return;
  const auto& corners = hit.mesh->triangles[hit.part];
  const std::array<double, 3> weights{1 - hit.weights.x - hit.weights.y, hit.weights.x, hit.weights.y};
  const auto mix = [&](std::size_t place, std::size_t width, auto&& number) {
    for (std::size_t k = 0; k < width; ++k) {
      double sum = 0;
      for (std::size_t c = 0; c < 3; ++c) sum += weights[c] * double{number(corners[c], k)};
      values[place + k] = static_cast<float>(sum);
    }
  };
  const shapes::MeshAt now(*hit.mesh, hit.time);
  const auto& colors = hit.mesh->colors;
  if (!hit.mesh->tangents.empty())
    mix(places[0], 4, [&](std::uint32_t i, std::size_t k) { return now.tangent(i)[k]; });
  if (!colors.empty()) mix(places[1], 4, [&](std::uint32_t i, std::size_t k) { return colors[i][k]; });
  const auto& uvs = hit.mesh->second_uvs;
  if (!uvs.empty())
    mix(places[2], 2, [&](std::uint32_t i, std::size_t k) { return k == 0 ? uvs[i].x : uvs[i].y; });
}

// Outputs of a material's program at a hit, limited to what the renderer can take.
class MaterialAt {
 public:
  MaterialAt(const compile::CompiledScene& world, const compile::SurfaceHit& hit, ThreadContext& thread)
      : index_(hit.material), material_(world.scene.materials[hit.material]), bad_values_(thread.bad_values) {
    const Vec3d P = hit.position + world.origin;
    const std::array<double, static_cast<std::size_t>(vm::Input::t_x)> values{hit.position_object.x,
                                                                              hit.position_object.y,
                                                                              hit.position_object.z,
                                                                              P.x,
                                                                              P.y,
                                                                              P.z,
                                                                              hit.shading_normal_object.x,
                                                                              hit.shading_normal_object.y,
                                                                              hit.shading_normal_object.z,
                                                                              hit.shading_normal.x,
                                                                              hit.shading_normal.y,
                                                                              hit.shading_normal.z,
                                                                              hit.uv.x,
                                                                              hit.uv.y,
                                                                              world.seconds_at(hit.time)};
    std::array<float, vm::input_count> floats;
    vm::BatchInputs inputs;
    for (std::size_t i = 0; i < values.size(); ++i) floats[i] = static_cast<float>(values[i]);
    if (world.materials[index_].reads_mesh) look_up_mesh(hit, floats);
    for (std::size_t i = 0; i < floats.size(); ++i) inputs.lanes[i] = &floats[i];
    std::array<float*, most_outputs> to;
    const std::size_t count = material_.program.outputs.size();
    for (std::size_t i = 0; i < count; ++i) to[i] = &outputs_[i];
    thread.machine.run(material_.program, inputs, 1, std::span(to).first(count));
  }

  float number(const std::optional<std::uint8_t>& output, float standard) const {
    return output ? limited(*output, 1.0f) : standard;
  }
  Rgb color(const scene::RgbOutputs& outputs, float highest) const {
    Rgb c;
    for (std::size_t k = 0; k < 3; ++k) c[k] = limited(outputs[k], highest);
    return c;
  }
  // A direction of any length; zero where it is not finite.
  Vec3d direction(const scene::RgbOutputs& outputs) const {
    Vec3d v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = double{outputs_[outputs[k]]};
    if (all_finite(v)) return v;
    const bool undefined = std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z);
    note_bad(outputs[0], undefined ? BadValue::Kind::undefined : BadValue::Kind::above);
    return {};
  }

 private:
  // Within [0, highest], undefined values as 0; others are counted.
  float limited(std::size_t output, float highest) const {
    const float v = outputs_[output];
    if (v >= 0 && v <= highest) return v;
    note_bad(output, std::isnan(v) ? BadValue::Kind::undefined
                     : v < 0       ? BadValue::Kind::below
                                   : BadValue::Kind::above);
    return v > 0 ? highest : 0.0f;
  }
  void note_bad(std::size_t output, BadValue::Kind kind) const {
    const scene::GivenNumber& given = material_.given[output];
    const float branch = given.branches.empty() ? 0 : outputs_[given.branch_output];
    bad_values_.add_material(index_, output, kind, static_cast<std::size_t>(branch));
  }

  std::uint32_t index_;
  const scene::Material& material_;
  BadValueCounts& bad_values_;
  static constexpr std::size_t most_outputs = 256;  // they are numbered by bytes
  std::array<float, most_outputs> outputs_;
};

// The normal to shade with, on the side of the ray: bent towards it where it looks away, as smoothed ones do
// at silhouettes.
Vec3d facing(const Vec3d& shading, const Vec3d& geometric, bool flipped, const Vec3d& direction) {
  constexpr double least_cosine = 1e-3;  // a grazing angle that is far above rounding
  const Vec3d n = flipped ? -shading : shading;
  const double cosine = -dot(n, direction);
  if (cosine >= least_cosine || n == geometric) return n;
  return normalize(n + direction * (cosine - least_cosine));
}

}  // namespace

SurfacePoint evaluate_surface(const compile::CompiledScene& world, const compile::SurfaceHit& hit,
                              const Vec3d& direction, ThreadContext& thread) {
  const scene::Material& material = world.scene.materials[hit.material];
  const compile::CompiledMaterial& compiled = world.materials[hit.material];
  const MaterialAt at(world, hit, thread);

  SurfacePoint point;
  const bool from_inside = dot(hit.normal, direction) > 0;
  point.position = hit.position;
  point.time = hit.time;
  point.normal = from_inside ? -hit.normal : hit.normal;
  point.offset_position = hit.position + point.normal * hit.offset_before;
  point.behind_position = hit.position - point.normal * hit.offset_behind;
  point.opacity = at.number(material.opacity, 1);
  if (material.emission) point.emission = at.color(*material.emission, largest_value);

  Vec3d shading = hit.shading_normal;
  if (material.normal) {
    const Vec3d n = at.direction(*material.normal);
    const Vec3d mapped = hit.normal_axes[0] * n.x + hit.normal_axes[1] * n.y + hit.normal_axes[2] * n.z;
    if (length_squared(mapped) > 0) shading = normalize(mapped);
  }
  // A normal that a body turned inwards on both sides alike is meant outwards.
  if (dot(shading, hit.normal) < 0) shading = -shading;
  point.frame = Frame<double>::around(facing(shading, point.normal, from_inside, direction));

  const Rgb base_color = at.color(material.base_color, 1.0f);
  if (compiled.matte) {
    point.reflectance = base_color;
    return point;
  }
  optics::SurfaceParameters p;
  p.base_color = base_color;
  p.metallic = at.number(material.metallic, p.metallic);
  p.roughness = at.number(material.roughness, p.roughness);
  p.specular = at.number(material.specular, p.specular);
  p.transmission = at.number(material.transmission, p.transmission);
  p.coat = at.number(material.coat, p.coat);
  if (material.specular_color) p.specular_color = at.color(*material.specular_color, largest_value);
  p.coat_roughness = at.number(material.coat_roughness, p.coat_roughness);
  if (material.sheen) p.sheen = at.color(*material.sheen, 1.0f);
  if (p.diffuse()) {
    point.reflectance = base_color;
    return point;
  }
  const double eta =
      from_inside && !hit.sheet ? hit.outside_ior / compiled.ior : compiled.ior / hit.outside_ior;
  if (!hit.sheet) point.eta = eta;
  point.model.emplace(*world.albedo_tables, p, eta, hit.sheet, point.frame.local(-direction));
  point.reflectance = point.model->albedo();
  point.transmits = point.model->transmits();
  point.only_deltas = point.model->only_deltas();
  return point;
}

float evaluate_opacity(const compile::CompiledScene& world, const compile::SurfaceHit& hit,
                       ThreadContext& thread) {
  const scene::Material& material = world.scene.materials[hit.material];
  return material.opacity ? MaterialAt(world, hit, thread).number(material.opacity, 1) : 1.0f;
}

Rgb SurfacePoint::value(const Vec3d& direction) const {
  const Vec3d i = frame.local(direction);
  const bool before = dot(normal, direction) > 0;
  if (before != (i.z > 0)) return {};
  if (model) return model->value(i);
  return before ? reflectance * static_cast<float>(i.z / pi) : Rgb{};
}

double SurfacePoint::pdf(const Vec3d& direction) const {
  const Vec3d i = frame.local(direction);
  if (model) return model->pdf(i);
  return i.z > 0 ? i.z / pi : 0.0;
}

std::optional<optics::SurfaceSample> SurfacePoint::sample(float u_layer, float u0, float u1, float u2) const {
  std::optional<optics::SurfaceSample> out;
  if (model) {
    out = model->sample(u_layer, u0, u1, u2);
    if (!out) return std::nullopt;
  } else {
    const Vec3d i = optics::sample_cosine_hemisphere(u0, u1);
    out = optics::SurfaceSample{i, reflectance, i.z / pi, false};  // (reflectance / pi) cosine / pdf
  }
  const bool before = out->direction.z > 0;
  out->direction = frame.world(out->direction);
  if (before != (dot(normal, out->direction) > 0)) return std::nullopt;
  return out;
}

}  // namespace tyndall::render
