#include "generate/height_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tyndall::generate {

namespace {

// How many cells of equal size are along each side.
struct Cells {
  std::size_t x, z;
};
Cells cells_of(const HeightField& field) {
  const double longer = std::max(field.size.x, field.size.y);
  const auto along = [&](double side) {
    return static_cast<std::size_t>(std::max(1.0, std::round(field.resolution * side / longer)));
  };
  return {along(field.size.x), along(field.size.y)};
}

// The heights at the corners of cells, in rows from low to high v, and where they are.
class Grid {
 public:
  Grid(const HeightField& field, const Cells& cells)
      : field_(field), columns(cells.x + 1), rows(cells.z + 1) {}

  Pair<double> uv(std::size_t i, std::size_t k) const {
    return {static_cast<double>(i) / static_cast<double>(columns - 1),
            static_cast<double>(k) / static_cast<double>(rows - 1)};
  }
  Vec3d at(std::size_t i, std::size_t k, double y) const {
    const Pair<double> place = uv(i, k);
    return {(place.x - 0.5) * field_.size.x, y, (0.5 - place.y) * field_.size.y};
  }
  Vec3d at(std::size_t i, std::size_t k) const { return at(i, k, heights[k * columns + i]); }
  // By differences to both sides, at the edge to one.
  Vec3d normal(std::size_t i, std::size_t k) const {
    const Vec3d along_x = at(std::min(i + 1, columns - 1), k) - at(i > 0 ? i - 1 : 0, k);
    const Vec3d along_v = at(i, std::min(k + 1, rows - 1)) - at(i, k > 0 ? k - 1 : 0);
    return normalize(cross(along_x, along_v));
  }

 private:
  const HeightField& field_;

 public:
  std::size_t columns, rows;
  std::vector<double> heights;
};

void add_top(MeshMaker& maker, const Grid& grid) {
  for (std::size_t k = 0; k < grid.rows; ++k)
    for (std::size_t i = 0; i < grid.columns; ++i)
      maker.point(grid.at(i, k), grid.normal(i, k), grid.uv(i, k));
  for (std::size_t k = 0; k + 1 < grid.rows; ++k)
    for (std::size_t i = 0; i + 1 < grid.columns; ++i) {
      const auto a = static_cast<std::uint32_t>(k * grid.columns + i), b = a + 1,
                 d = a + static_cast<std::uint32_t>(grid.columns), c = d + 1;
      // Diagonals in turn, so that no direction is preferred.
      if ((i + k) % 2 == 0)
        maker.quad(a, b, c, d);
      else
        maker.quad(b, c, d, a);
    }
}

// The places along the edge, counter-clockwise seen from above.
std::vector<std::pair<std::size_t, std::size_t>> edge_of(const Grid& grid) {
  std::vector<std::pair<std::size_t, std::size_t>> edge;
  for (std::size_t i = 0; i + 1 < grid.columns; ++i) edge.emplace_back(i, 0);
  for (std::size_t k = 0; k + 1 < grid.rows; ++k) edge.emplace_back(grid.columns - 1, k);
  for (std::size_t i = grid.columns - 1; i > 0; --i) edge.emplace_back(i, grid.rows - 1);
  for (std::size_t k = grid.rows - 1; k > 0; --k) edge.emplace_back(0, k);
  return edge;
}

// Sides down to the floor, and the floor.
void add_stand(MeshMaker& maker, const Grid& grid, double floor) {
  const auto edge = edge_of(grid);
  const std::uint32_t middle = maker.point({0, floor, 0}, {0, -1, 0}, {0.5, 0.5});
  for (std::size_t e = 0; e < edge.size(); ++e) {
    const auto [i, k] = edge[e];
    const auto [j, l] = edge[(e + 1) % edge.size()];
    const Vec3d along = normalize(grid.at(j, l, 0) - grid.at(i, k, 0));
    const Vec3d normal = cross(along, {0, 1, 0}), down{0, -1, 0};
    const auto point = [&](std::size_t u, std::size_t v, double y, const Vec3d& n) {
      return maker.point(grid.at(u, v, y), n, grid.uv(u, v));
    };
    const std::uint32_t above = maker.point(grid.at(i, k), normal, grid.uv(i, k));
    const std::uint32_t above_next = maker.point(grid.at(j, l), normal, grid.uv(j, l));
    maker.quad(point(i, k, floor, normal), point(j, l, floor, normal), above_next, above);
    maker.triangle(point(j, l, floor, down), point(i, k, floor, down), middle);
  }
}

}  // namespace

Problems HeightField::validate() const {
  Problems problems;
  if (!(size.x > 0 && size.y > 0))
    problems.push_back({"size", fmt::format("'size' must be above 0, found ({}, {})", size.x, size.y),
                        "write (4, 4): along x and along z"});
  if (resolution < 1)
    problems.push_back({"resolution", fmt::format("'resolution' must be 1 or more, found {}", resolution)});
  if (!problems.empty()) return problems;
  want_few_facets(problems, "resolution", facets());
  return problems;
}

double HeightField::facets() const {
  const Cells cells = cells_of(*this);
  return static_cast<double>(cells.x) * static_cast<double>(cells.z);
}

Made HeightField::make() const {
  Grid grid(*this, cells_of(*this));
  grid.heights.reserve(grid.columns * grid.rows);
  for (std::size_t k = 0; k < grid.rows; ++k)
    for (std::size_t i = 0; i < grid.columns; ++i) {
      const std::optional<double> y = height(grid.uv(i, k));
      if (!y) return {};
      if (floor && *y <= *floor)
        return {
            {},
            {{"floor",
              fmt::format("the floor at {} is not below the height at uv ({:.4g}, {:.4g}), which is {:.4g}",
                          *floor, grid.uv(i, k).x, grid.uv(i, k).y, *y),
              "set it lower, or keep heights above it with max(…)"}}};
      grid.heights.push_back(*y);
    }
  MeshMaker maker;
  add_top(maker, grid);
  if (floor) add_stand(maker, grid, *floor);
  return {maker.take(), {}};
}

}  // namespace tyndall::generate
