// What the shapes of this layer are made into, and how a mesh grows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/problem.h"
#include "shapes/mesh.h"

namespace tyndall::generate {

inline constexpr std::size_t most_outline_points = 20'000;  // of a profile, or of all outlines of a prism
inline constexpr std::size_t most_facets = 2'000'000;       // four-sided ones, each of two triangles
inline constexpr int most_segments = 4096;

// The mesh, or why there is none.
struct Made {
  shapes::TriangleMesh mesh{};
  Problems problems{};
};

// Adds a problem, at the parameter that says how fine the shape is, if it would have too many facets.
void want_few_facets(Problems& problems, std::string_view field, double facets);
void want_segments(Problems& problems, std::string_view field, int segments, int least);

// Adds what has a corner in a point, in order.
class MeshMaker {
 public:
  std::uint32_t point(const Vec3d& position, const Vec3d& normal, const Pair<double>& uv);
  // Counter-clockwise seen from outside. Those whose corners coincide are left out.
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
  // The facets between two rows of so many points each, numbered from their first: `above` lies behind
  // `below` when the rows run to the right.
  void strip(std::uint32_t below, std::uint32_t above, std::size_t points);
  shapes::TriangleMesh take() { return std::move(mesh_); }

 private:
  shapes::TriangleMesh mesh_;
};

}  // namespace tyndall::generate
