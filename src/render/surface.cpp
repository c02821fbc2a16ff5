#include "render/surface.h"

#include <algorithm>
#include <cmath>

#include "render/worker.h"

namespace tyndall::render {

namespace {

// Within [0, highest], undefined values as 0; others are counted.
float limited(float v, float highest, std::uint32_t material, std::size_t output, Worker& worker) {
  if (v >= 0 && v <= highest) return v;
  worker.bad_values.add_material(material, output,
                                 std::isnan(v) ? BadValue::Kind::undefined
                                 : v < 0       ? BadValue::Kind::below
                                               : BadValue::Kind::above);
  return v > 0 ? highest : 0.0f;
}

// Outputs of a material's program at a hit, limited to what the renderer can take.
class MaterialAt {
 public:
  MaterialAt(const compile::CompiledScene& world, const compile::SurfaceHit& hit, Worker& worker)
      : index_(hit.material), material_(world.scene.materials[hit.material]), worker_(worker) {
    const Vec3d P = hit.position + world.origin;
    const std::array<double, vm::input_count> values{hit.position_object.x,
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
    for (std::size_t i = 0; i < floats.size(); ++i) {
      floats[i] = static_cast<float>(values[i]);
      inputs.lanes[i] = &floats[i];
    }
    std::vector<float>& results = worker.material_outputs;
    results.resize(material_.program.outputs.size());
    worker.outputs.clear();
    for (float& result : results) worker.outputs.push_back(&result);
    worker.machine.run(material_.program, inputs, 1, worker.outputs);
  }

  float number(const std::optional<std::uint8_t>& output, float standard) const {
    if (!output) return standard;
    return limited(worker_.material_outputs[*output], 1.0f, index_, *output, worker_);
  }
  Rgb color(const scene::RgbOutputs& outputs, float highest) const {
    Rgb c;
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = limited(worker_.material_outputs[outputs[k]], highest, index_, outputs[k], worker_);
    return c;
  }
  // A direction of any length; zero where it is not finite.
  Vec3d direction(const scene::RgbOutputs& outputs) const {
    Vec3d v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = double{worker_.material_outputs[outputs[k]]};
    if (all_finite(v)) return v;
    worker_.bad_values.add_material(index_, outputs[0], BadValue::Kind::undefined);
    return {};
  }

 private:
  std::uint32_t index_;
  const scene::Material& material_;
  Worker& worker_;
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
                              const Vec3d& direction, Worker& worker) {
  const scene::Material& material = world.scene.materials[hit.material];
  const compile::CompiledMaterial& compiled = world.materials[hit.material];
  const MaterialAt at(world, hit, worker);

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

float evaluate_opacity(const compile::CompiledScene& world, const compile::SurfaceHit& hit, Worker& worker) {
  const scene::Material& material = world.scene.materials[hit.material];
  return material.opacity ? MaterialAt(world, hit, worker).number(material.opacity, 1) : 1.0f;
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
