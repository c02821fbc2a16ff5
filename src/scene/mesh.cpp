// Whether a mesh has an inside.
#include <algorithm>
#include <numeric>
#include <tuple>

#include "scene/scene.h"

namespace tyndall::scene {

namespace {

// For each point the first index, in an order of places, of those at the same place.
std::vector<std::uint32_t> places(const std::vector<Vec3d>& points) {
  std::vector<std::uint32_t> order(points.size()), place(points.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) { return std::tie(points[i].x, points[i].y, points[i].z); };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  for (std::size_t i = 0; i < order.size(); ++i)
    place[order[i]] = i > 0 && points[order[i]] == points[order[i - 1]] ? place[order[i - 1]] : order[i];
  return place;
}

}  // namespace

std::size_t open_edges(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> place = places(mesh.points);
  struct Edge {
    std::uint32_t low, high;
    int direction;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = place[triangle[i]], b = place[triangle[(i + 1) % 3]];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  const auto key = [](const Edge& e) { return std::tie(e.low, e.high); };
  std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return key(a) < key(b); });
  std::size_t open = 0;
  for (std::size_t i = 0; i < edges.size();) {
    int sum = 0;
    const Edge& first = edges[i];
    for (; i < edges.size() && key(edges[i]) == key(first); ++i) sum += edges[i].direction;
    open += sum != 0;
  }
  return open;
}

std::size_t open_edges(const SharedMesh& mesh) {
  std::optional<std::size_t>& known = mesh.findings().open_edges;
  if (!known) known = open_edges(*mesh);
  return *known;
}

}  // namespace tyndall::scene
