#include "generate/made.h"

#include <fmt/format.h>

namespace tyndall::generate {

void want_few_facets(Problems& problems, std::string_view field, double facets) {
  if (facets <= static_cast<double>(most_facets)) return;
  problems.push_back({field,
                      fmt::format("the shape would have {:.0f} facets, more than {}", facets, most_facets),
                      "give fewer points, or divide it more coarsely"});
}

void want_segments(Problems& problems, std::string_view field, int segments, int least) {
  if (segments < least || segments > most_segments)
    problems.push_back(
        {field, fmt::format("'{}' must be from {} to {}, found {}", field, least, most_segments, segments)});
}

std::uint32_t MeshMaker::point(const Vec3d& position, const Vec3d& normal, const Pair<double>& uv) {
  mesh_.points.push_back(position);
  mesh_.normals.push_back(normal);
  mesh_.uvs.push_back(uv);
  return static_cast<std::uint32_t>(mesh_.points.size() - 1);
}

void MeshMaker::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const auto& p = mesh_.points;
  if (p[a] == p[b] || p[b] == p[c] || p[c] == p[a]) return;
  mesh_.triangles.push_back({a, b, c});
}

void MeshMaker::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  triangle(a, b, c);
  triangle(a, c, d);
}

void MeshMaker::strip(std::uint32_t below, std::uint32_t above, std::size_t points) {
  for (std::uint32_t i = 0; i + 1 < points; ++i) quad(below + i, below + i + 1, above + i + 1, above + i);
}

}  // namespace tyndall::generate
