#include "render/surface.h"

#include <algorithm>
#include <cmath>

#include "render/worker.h"

namespace tyndall::render {

namespace {

float clamped(float v, float highest, std::uint32_t material, std::size_t output, Worker& worker) {
  if (v >= 0 && v <= largest_value) return std::min(v, highest);
  worker.bad_values.add_material(
      material, output, v < 0 && v >= -largest_value ? BadValue::Kind::negative : BadValue::Kind::not_finite);
  return v > 0 ? highest : 0.0f;
}

}  // namespace

SurfacePoint evaluate_surface(const compile::CompiledScene& world, const compile::SurfaceHit& hit,
                              const Vec3d& direction, Worker& worker) {
  SurfacePoint point;
  point.position = hit.position;
  point.normal = dot(hit.normal, direction) > 0 ? -hit.normal : hit.normal;
  point.offset_position = hit.position + point.normal * compile::surface_offset(world, hit.position);

  const std::uint32_t index = hit.material;
  const scene::Material& material = world.scene.materials[index];
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
                                                   world.scene.time};
  std::array<float, vm::input_count> floats;
  vm::BatchInputs inputs;
  for (std::size_t i = 0; i < floats.size(); ++i) {
    floats[i] = static_cast<float>(values[i]);
    inputs.lanes[i] = &floats[i];
  }
  std::vector<float>& results = worker.material_outputs;
  results.resize(material.program.outputs.size());
  worker.outputs.clear();
  for (float& result : results) worker.outputs.push_back(&result);
  worker.machine.run(material.program, inputs, 1, worker.outputs);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint8_t color = material.base_color[c];
    point.reflectance[c] = clamped(results[color], 1.0f, index, color, worker);
    if (!material.emission) continue;
    const std::uint8_t emission = (*material.emission)[c];
    point.emission[c] = clamped(results[emission], largest_value, index, emission, worker);
  }
  return point;
}

Vec3d sample_cosine(const Vec3d& normal, float u0, float u1) {
  const double r = std::sqrt(double{u0}), phi = 2 * pi * u1;
  return Frame<double>::around(normal).world(
      {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - double{u0})});
}

}  // namespace tyndall::render
