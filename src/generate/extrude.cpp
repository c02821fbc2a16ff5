#include "generate/extrude.h"

#include <GL/glu.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "generate/line.h"

namespace tyndall::generate {

namespace {

// What GLU calls back with; points travel by their numbers, as pointers.
struct Filling {
  Area area;
  std::vector<std::uint32_t> corners;

  std::uint32_t add(double x, double y) {
    area.points.push_back({x, y});
    return static_cast<std::uint32_t>(area.points.size() - 1);
  }
};

void* as_pointer(std::uint32_t number) {
  return reinterpret_cast<void*>(static_cast<std::uintptr_t>(number));
}

void take_corner(void* corner, void* filling) {
  static_cast<Filling*>(filling)->corners.push_back(
      static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(corner)));
}

// A point where sides cross or points coincide.
void join_points(GLdouble at[3], void* [4], GLfloat[4], void** joined, void* filling) {
  *joined = as_pointer(static_cast<Filling*>(filling)->add(at[0], at[1]));
}

// That there is such a function makes GLU give nothing but triangles.
void take_edge_flag(GLboolean, void*) {}

using Callback = void (*)();
template <class Function>
void set(GLUtesselator* tess, GLenum which, Function* function) {
  gluTessCallback(tess, which, reinterpret_cast<Callback>(function));
}

// The loops of the sides that belong to one triangle alone.
std::vector<std::vector<std::uint32_t>> loops_around(const Area& area) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const auto& t : area.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      if (const auto back = sides.find({b, a}); back != sides.end() && back->second > 0)
        --back->second;
      else
        ++sides[{a, b}];
    }
  std::multimap<std::uint32_t, std::uint32_t> next;
  for (const auto& [side, count] : sides)
    for (int i = 0; i < count; ++i) next.emplace(side.first, side.second);
  std::vector<std::vector<std::uint32_t>> loops;
  while (!next.empty()) {
    std::vector<std::uint32_t> loop;
    for (auto side = next.begin(); side != next.end(); side = next.find(loop.back())) {
      if (loop.empty()) loop.push_back(side->first);
      loop.push_back(side->second);
      next.erase(side);
      if (loop.back() == loop.front()) break;
    }
    loop.pop_back();  // the first again
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

Area fill(const std::vector<Outline>& outlines, Filled rule) {
  Filling filling;
  const std::unique_ptr<GLUtesselator, decltype(&gluDeleteTess)> tess(gluNewTess(), gluDeleteTess);
  set(tess.get(), GLU_TESS_VERTEX_DATA, take_corner);
  set(tess.get(), GLU_TESS_COMBINE_DATA, join_points);
  set(tess.get(), GLU_TESS_EDGE_FLAG_DATA, take_edge_flag);
  gluTessProperty(tess.get(), GLU_TESS_WINDING_RULE,
                  rule == Filled::odd ? GLU_TESS_WINDING_ODD : GLU_TESS_WINDING_NONZERO);
  gluTessNormal(tess.get(), 0, 0, 1);
  gluTessBeginPolygon(tess.get(), &filling);
  for (const Outline& outline : outlines) {
    gluTessBeginContour(tess.get());
    for (const Pair<double>& p : outline) {
      double at[3] = {p.x, p.y, 0};
      gluTessVertex(tess.get(), at, as_pointer(filling.add(p.x, p.y)));
    }
    gluTessEndContour(tess.get());
  }
  gluTessEndPolygon(tess.get());
  Area area = std::move(filling.area);
  for (std::size_t i = 0; i + 2 < filling.corners.size(); i += 3)
    area.triangles.push_back({filling.corners[i], filling.corners[i + 1], filling.corners[i + 2]});
  area.loops = loops_around(area);
  return area;
}

void extrude(MeshMaker& maker, const Area& area, const Extrusion& how) {
  const Pair<double> size{how.to.x - how.from.x, how.to.y - how.from.y};
  std::vector<std::uint32_t> low, high;
  for (const Pair<double>& p : area.points) {
    const Pair<double> uv{(p.x - how.from.x) / size.x, (p.y - how.from.y) / size.y};
    low.push_back(maker.point(how.position(p, how.low), -how.up, uv));
    high.push_back(maker.point(how.position(p, how.high), how.up, uv));
  }
  for (const auto& [a, b, c] : area.triangles) {
    maker.triangle(high[a], high[b], high[c]);
    maker.triangle(low[c], low[b], low[a]);
  }
  for (const std::vector<std::uint32_t>& loop : area.loops) {
    Outline line;
    for (const std::uint32_t i : loop) line.push_back(area.points[i]);
    // Both ends of a side, each at both heights.
    const auto end = [&](const Pair<double>& p, const Pair<double>& normal, double u) {
      const Vec3d n = how.direction(normal);
      const std::uint32_t below = maker.point(how.position(p, how.low), n, {u, 0});
      maker.point(how.position(p, how.high), n, {u, 1});
      return below;
    };
    std::uint32_t before = 0, after = 0;
    for (const Piece& piece : pieces_of(line, true)) {
      before = piece.begins_anew ? end(piece.from, piece.normal_from, piece.along_from) : after;
      after = end(piece.to, piece.normal_to, piece.along_to);
      maker.quad(before, after, after + 1, before + 1);
    }
  }
}

void bounds_of(const std::vector<Outline>& outlines, Pair<double>& from, Pair<double>& to) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  from = {infinity, infinity};
  to = {-infinity, -infinity};
  for (const Outline& outline : outlines)
    for (const Pair<double>& p : outline) {
      from = {std::min(from.x, p.x), std::min(from.y, p.y)};
      to = {std::max(to.x, p.x), std::max(to.y, p.y)};
    }
}

}  // namespace tyndall::generate
