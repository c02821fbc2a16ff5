#include "compile/lights/area_emitters.h"

#include "base/overloaded.h"

namespace tyndall::compile {

namespace {

using optics::EmitterSurface;
using optics::EmitterTriangles;

// Nothing for what cannot be a light: planes have no end, curves no area to draw from.
std::optional<EmitterSurface> emitter_surface(const scene::Scene& scene, const scene::Shape& shape) {
  using Result = std::optional<EmitterSurface>;
  return std::visit(
      Overloaded{[&](const scene::Mesh& m) -> Result {
                   const scene::TriangleMesh& mesh = *scene.meshes[m.mesh.index];
                   EmitterTriangles out;
                   out.corners.reserve(mesh.triangles.size());
                   for (const auto& t : mesh.triangles)
                     out.corners.push_back({mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]});
                   return out;
                 },
                 [](const scene::Curves&) -> Result { return std::nullopt; },
                 [](const shapes::Analytic auto& s) -> Result {
                   if constexpr (shapes::Faceted<std::decay_t<decltype(s)>>)
                     return EmitterTriangles{s.triangles()};
                   else if constexpr (shapes::Sampled<std::decay_t<decltype(s)>>)
                     return shapes::Shape{s};
                   else
                     return std::nullopt;
                 }},
      shape);
}

}  // namespace

std::shared_ptr<const optics::Emitter> emitter_of(const scene::Scene& scene, const scene::Shape& shape,
                                                  const Transform& render_from_shape) {
  auto surface = emitter_surface(scene, shape);
  if (!surface) return nullptr;
  return std::make_shared<const optics::Emitter>(std::move(*surface), render_from_shape);
}

}  // namespace tyndall::compile
