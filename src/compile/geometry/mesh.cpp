#include "compile/geometry/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/numerics.h"
#include "compile/geometry/hit_error.h"
#include "shapes/mesh_at.h"

namespace tyndall::compile {

namespace {

// Up to this many triangles a plain loop is faster than a tree.
constexpr std::size_t few_triangles = 4;

struct Point2 {
  double x = 0, y = 0;
};

// The sign of p.x q.y - p.y q.x, exactly: rounding keeps the order of the products, and where both round to
// the same their errors decide.
int turn(const Point2& p, const Point2& q) {
  const double a = p.x * q.y, b = p.y * q.x;
  if (a != b) return a > b ? 1 : -1;
  const double a_rest = std::fma(p.x, q.y, -a), b_rest = std::fma(p.y, q.x, -b);
  return a_rest == b_rest ? 0 : a_rest > b_rest ? 1 : -1;
}

// Of the two sides of an edge through the ray one owns it: as if the ray were moved by (-e, e²).
bool owns(const Point2& from, const Point2& to) { return to.y > from.y || (to.y == from.y && to.x > from.x); }

struct TriangleHit {
  double t = 0;
  std::array<double, 3> weights{};  // of the corners
  int side = 0;                     // 1: hit from the front, -1: from behind
};

// The ray's own space: it runs along z through the origin, z is t, and the handedness is kept.
class RaySpace {
 public:
  RaySpace(const Vec3d& origin, const Vec3d& direction) : origin_(origin) {
    const Vec3d size{std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)};
    z_ = size.x > size.y ? (size.x > size.z ? 0u : 2u) : (size.y > size.z ? 1u : 2u);
    x_ = (z_ + 1) % 3;
    y_ = (z_ + 2) % 3;
    if (direction[z_] < 0) std::swap(x_, y_);
    shear_x_ = direction[x_] / direction[z_];
    shear_y_ = direction[y_] / direction[z_];
    scale_z_ = 1 / direction[z_];
  }

  // Where the line meets a triangle, at any t.
  std::optional<TriangleHit> meet(const Vec3d& a, const Vec3d& b, const Vec3d& c) const {
    const std::array<Vec3d, 3> from_origin{a - origin_, b - origin_, c - origin_};
    std::array<Point2, 3> corner;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d& v = from_origin[i];
      corner[i] = {v[x_] - shear_x_ * v[z_], v[y_] - shear_y_ * v[z_]};
    }
    // turns[i] belongs to the edge opposite corner i.
    std::array<int, 3> turns{};
    int orientation = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      turns[i] = turn(corner[(i + 1) % 3], corner[(i + 2) % 3]);
      if (turns[i] == 0) continue;
      if (orientation == -turns[i]) return std::nullopt;
      orientation = turns[i];
    }
    if (orientation == 0) return std::nullopt;  // edge on
    for (std::size_t i = 0; i < 3; ++i) {
      if (turns[i] != 0) continue;
      const Point2 &from = corner[(i + 1) % 3], &to = corner[(i + 2) % 3];
      if (!(orientation > 0 ? owns(from, to) : owns(to, from))) return std::nullopt;
    }
    TriangleHit hit;
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point2 &p = corner[(i + 1) % 3], &q = corner[(i + 2) % 3];
      // Accurate, so that slivers are hit in their plane as well as others.
      hit.weights[i] = std::abs(difference_of_products(p.x, q.y, p.y, q.x));
      sum += hit.weights[i];
    }
    for (std::size_t i = 0; i < 3; ++i) {
      hit.weights[i] = sum > 0 ? hit.weights[i] / sum : 1.0 / 3;  // slivers whose areas all round to 0
      hit.t += hit.weights[i] * from_origin[i][z_] * scale_z_;
    }
    // Seen along the ray, a front side runs clockwise.
    hit.side = -orientation;
    return hit;
  }

 private:
  Vec3d origin_;
  std::size_t x_, y_, z_;
  double shear_x_, shear_y_, scale_z_;
};

Pair<double> mixed(const std::vector<Pair<double>>& v, const std::array<std::uint32_t, 3>& t,
                   const std::array<double, 3>& w) {
  return {v[t[0]].x * w[0] + v[t[1]].x * w[1] + v[t[2]].x * w[2],
          v[t[0]].y * w[0] + v[t[1]].y * w[1] + v[t[2]].y * w[2]};
}

struct Crossing {
  double t;
  std::uint32_t triangle;
  int side;
};

}  // namespace

CompiledMesh::CompiledMesh(scene::SharedMesh shared)
    : mesh_(std::move(shared)), bounds_{Vec3d(infinity), Vec3d(-infinity)} {
  const scene::TriangleMesh& mesh = *mesh_;
  const auto box = [&](std::uint32_t index, std::uint32_t moment) {
    const std::vector<Vec3d>& points = moment == 0 ? mesh.points : mesh.later[moment - 1].points;
    Bounds out{Vec3d(infinity), Vec3d(-infinity)};
    for (const std::uint32_t corner : mesh.triangles[index])
      for (std::size_t axis = 0; axis < 3; ++axis) {
        out.lo[axis] = std::min(out.lo[axis], points[corner][axis]);
        out.hi[axis] = std::max(out.hi[axis], points[corner][axis]);
      }
    return out;
  };
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  const auto moments = static_cast<std::uint32_t>(mesh.later.size() + 1);
  for (std::uint32_t i = 0; i < count; ++i)
    for (std::uint32_t moment = 0; moment < moments; ++moment) {
      const Bounds own = box(i, moment);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        bounds_.lo[axis] = std::min(bounds_.lo[axis], own.lo[axis]);
        bounds_.hi[axis] = std::max(bounds_.hi[axis], own.hi[axis]);
      }
    }
  if (count > few_triangles) tree_ = std::make_shared<const BoundsTree>(count, moments, box);
}

Bounds CompiledMesh::bounds_within(const Intervald& time) const {
  Bounds out{Vec3d(infinity), Vec3d(-infinity)};
  const auto [first, last] = shapes::poses_within(time, mesh_->later.size());
  for (std::size_t pose = first; pose <= last; ++pose)
    for (const Vec3d& p : pose == 0 ? mesh_->points : mesh_->later[pose - 1].points)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        out.lo[axis] = std::min(out.lo[axis], p[axis]);
        out.hi[axis] = std::max(out.hi[axis], p[axis]);
      }
  return out;
}

template <class Test>
void CompiledMesh::visit(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max, double time,
                         Test&& test) const {
  if (tree_) return tree_->visit(origin, direction, t_min, t_max, test, time);
  for (std::uint32_t i = 0; i < mesh_->triangles.size(); ++i) test(i);
}

std::optional<ShapeHit> CompiledMesh::intersect(const Vec3d& origin, const Vec3d& direction, double t_max,
                                                const After& after, double time) const {
  const shapes::MeshAt now(*mesh_, time);
  const RaySpace space(origin, direction);
  std::optional<TriangleHit> best;
  std::uint32_t best_index = 0;
  visit(origin, direction, after.t, t_max, time, [&](std::uint32_t index) {
    const auto& triangle = mesh_->triangles[index];
    const auto hit = space.meet(now.point(triangle[0]), now.point(triangle[1]), now.point(triangle[2]));
    if (hit && after.before(hit->t, index) &&
        (hit->t < t_max || (best && hit->t == t_max && index < best_index))) {
      best = hit;
      best_index = index;
      t_max = hit->t;
    }
    // Equal ones must still be hit, so that the first triangle wins.
    return best ? std::nextafter(t_max, infinity) : t_max;
  });
  if (!best) return std::nullopt;
  const auto& triangle = mesh_->triangles[best_index];
  const auto& w = best->weights;
  const Vec3d a = now.point(triangle[0]), b = now.point(triangle[1]), c = now.point(triangle[2]);
  ShapeHit hit{
      best->t, a * w[0] + b * w[1] + c * w[2], cross(b - a, c - a), {w[1], w[2]}, triangle_reach(a, b, c)};
  hit.part = best_index;
  hit.weights = {w[1], w[2]};
  if (!(length_squared(hit.normal) > 0)) return std::nullopt;  // a sliver below a double's range
  if (!mesh_->uvs.empty()) hit.uv = mixed(mesh_->uvs, triangle, w);
  if (!mesh_->normals.empty())
    hit.shading_normal =
        now.normal(triangle[0]) * w[0] + now.normal(triangle[1]) * w[1] + now.normal(triangle[2]) * w[2];
  return hit;
}

void CompiledMesh::inside(const Vec3d& origin, const Vec3d& direction, double t_max,
                          std::vector<Intervald>& out, double time) const {
  const shapes::MeshAt now(*mesh_, time);
  // All crossings of the line, from before the mesh: the winding number where the ray starts is counted, not
  // guessed.
  const Vec3d center = (bounds_.lo + bounds_.hi) * 0.5;
  const double radius = length(bounds_.hi - bounds_.lo), d = length(direction);
  const double nearest = dot(center - origin, direction) / sqr(d), start = nearest - radius / d;
  const RaySpace space(origin, direction);
  std::vector<Crossing> crossings;
  visit(origin + direction * start, direction, 0, 2 * radius / d, time, [&](std::uint32_t index) {
    const auto& triangle = mesh_->triangles[index];
    const auto hit = space.meet(now.point(triangle[0]), now.point(triangle[1]), now.point(triangle[2]));
    if (hit) crossings.push_back({hit->t, index, hit->side});
    return 2 * radius / d;
  });
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return a.t != b.t ? a.t < b.t : a.triangle < b.triangle;
  });
  // Embree may tell of one box more than once.
  const auto same = [](const Crossing& a, const Crossing& b) { return a.triangle == b.triangle; };
  crossings.erase(std::unique(crossings.begin(), crossings.end(), same), crossings.end());
  int winding = 0;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    // What an open mesh leaves open at its last crossing is not inside.
    if (winding != 0) {
      const Intervald stay = Intervald{crossings[i - 1].t, crossings[i].t}.clipped_to({0, t_max});
      if (!stay.empty()) {
        if (!out.empty() && out.back().hi == stay.lo)
          out.back().hi = stay.hi;
        else
          out.push_back(stay);
      }
    }
    winding += crossings[i].side;
  }
}

}  // namespace tyndall::compile
