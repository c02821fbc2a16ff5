#include "compile/emitters.h"

#include "base/overloaded.h"
#include "compile/compiled_scene.h"

namespace tyndall::compile {

namespace {

using optics::EmitterSurface;
using optics::EmitterTriangles;

// Two triangles, counter-clockwise as the corners run.
void add_quad(EmitterTriangles& out, const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  out.corners.push_back({a, b, c});
  out.corners.push_back({a, c, d});
}

EmitterTriangles triangles_of(const scene::Box& box) {
  EmitterTriangles out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool at_max : {false, true}) {
      Vec3d corner[4];
      for (std::size_t k = 0; k < 4; ++k) {
        corner[k][axis] = at_max ? box.max[axis] : box.min[axis];
        corner[k][u] = k == 1 || k == 2 ? box.max[u] : box.min[u];
        corner[k][v] = k >= 2 ? box.max[v] : box.min[v];
      }
      if (at_max)
        add_quad(out, corner[0], corner[1], corner[2], corner[3]);
      else
        add_quad(out, corner[0], corner[3], corner[2], corner[1]);
    }
  }
  return out;
}

std::optional<EmitterSurface> surface_of(const scene::Scene& scene, const scene::Shape& shape) {
  using Result = std::optional<EmitterSurface>;
  return std::visit(
      Overloaded{[](const scene::Sphere& s) -> Result {
                   return optics::EmitterSphere{s.center, s.radius};
                 },
                 [](const scene::Box& b) -> Result { return triangles_of(b); },
                 [](const scene::Plane&) -> Result { return std::nullopt; },
                 [](const scene::Quad& q) -> Result {
                   EmitterTriangles out;
                   add_quad(out, q.center - q.u - q.v, q.center + q.u - q.v, q.center + q.u + q.v,
                            q.center - q.u + q.v);
                   return out;
                 },
                 [](const scene::Disk& d) -> Result {
                   return optics::EmitterDisk{d.center, normalize(d.normal), d.radius};
                 },
                 [](const scene::Cylinder& c) -> Result {
                   return optics::EmitterCylinder{c.from, c.to, c.radius};
                 },
                 [](const scene::Curves&) -> Result { return std::nullopt; },
                 [&](const scene::Mesh& m) -> Result {
                   const scene::TriangleMesh& mesh = scene.meshes[m.mesh.index];
                   EmitterTriangles out;
                   out.corners.reserve(mesh.triangles.size());
                   for (const auto& t : mesh.triangles)
                     out.corners.push_back({mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]});
                   return out;
                 }},
      shape);
}

// The emission of a material, when it is one value and light.
std::optional<Rgb> constant_emission(const scene::Material& material) {
  if (!material.emission || material.opacity)
    return std::nullopt;  // what light goes through is met by chance
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

std::shared_ptr<const optics::Emitter> emitter_of(const scene::Scene& scene, const scene::Shape& shape,
                                                  const Transform& render_from_shape) {
  auto surface = surface_of(scene, shape);
  if (!surface) return nullptr;
  return std::make_shared<const optics::Emitter>(std::move(*surface), render_from_shape);
}

std::vector<std::uint32_t> add_glowing_shapes(const scene::Scene& scene, const Transform& render_from_world,
                                              std::vector<optics::Light>& lights) {
  std::vector<std::uint32_t> light_of_shape;
  auto moving = scene.motion.shapes.begin();
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const scene::ShapeInstance& shape = scene.shapes[i];
    if (moving != scene.motion.shapes.end() && moving->index == i) {
      ++moving;  // met by chance
      continue;
    }
    const auto emission = constant_emission(scene.materials[shape.material.index]);
    if (!emission) continue;
    optics::MeshLight light;
    light.radiance = *emission;
    light.visible = shape.visible;
    light.both_sides = true;
    light.world_from_shape = render_from_world * shape.world_from_object;
    light.emitter = emitter_of(scene, shape.shape, light.world_from_shape);
    if (!light.emitter || !(light.emitter->area() > 0)) continue;
    light_of_shape.resize(scene.shapes.size(), no_index);
    light_of_shape[i] = static_cast<std::uint32_t>(lights.size());
    lights.emplace_back(std::move(light));
  }
  return light_of_shape;
}

}  // namespace tyndall::compile
