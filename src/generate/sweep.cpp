#include "generate/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/numerics.h"
#include "generate/line.h"

namespace tyndall::generate {

namespace {

// A place on the path: the ball's centre and radius, which way it goes, how the radius grows on it, and two
// directions across, with `a` × `b` = `along`.
struct Station {
  Vec3d center;
  double radius = 0;
  Vec3d along;
  double growth = 0;  // of the radius by way: within (-1, 1), or one ball holds the next
  Vec3d a, b;
  double v = 0;  // 0 to 1 along the path
};

Vec3d place(const Knot& k) { return {k[0], k[1], k[2]}; }

bool is_ring(const Sweep& sweep) { return sweep.path.size() > 3 && sweep.path.front() == sweep.path.back(); }

// Carries a direction across from one place to the next without turning it about the path: two reflections
// (Wang et al., "Computation of rotation minimizing frames", 2008).
Vec3d carried(const Vec3d& a, const Station& from, const Station& to) {
  const auto mirrored = [](const Vec3d& v, const Vec3d& n) {
    const double square = dot(n, n);
    return square > 0 ? v - n * (2 * dot(n, v) / square) : v;
  };
  const Vec3d step = to.center - from.center;
  const Vec3d across = mirrored(mirrored(a, step), to.along - mirrored(from.along, step));
  return normalize(across - to.along * dot(across, to.along));
}

// Any direction across.
Vec3d across(const Vec3d& along) {
  const Vec3d axis = std::abs(along.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
  return normalize(cross(axis, along));
}

Vec3d turned(const Station& s, double angle) { return s.a * std::cos(angle) + s.b * std::sin(angle); }

// The places of a path, without those that coincide with the one before.
std::vector<Station> stations_of(const std::vector<Knot>& line, bool ring) {
  std::vector<Station> stations;
  double way = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    // To both sides, at an end to one.
    const Knot& before = i > 0 ? line[i - 1] : ring ? line[line.size() - 2] : line[i];
    const Knot& after = i + 1 < line.size() ? line[i + 1] : ring ? line[1] : line[i];
    const Vec3d step = place(after) - place(before);
    Station s{place(line[i]), std::max(0.0, line[i][3]), normalize(step), 0, {}, {}, 0};
    s.growth = (std::max(0.0, after[3]) - std::max(0.0, before[3])) / length(step);
    if (i > 0) way += length(s.center - place(line[i - 1]));
    s.v = way;
    s.a = i > 0 ? carried(stations.back().a, stations.back(), s) : across(s.along);
    stations.push_back(s);
  }
  // Around a ring the first direction comes back turned, which is spread over the way.
  const Vec3d& first = stations.front().a;
  const Vec3d& last = stations.back().a;
  const double twist =
      ring ? std::atan2(dot(cross(last, first), stations.front().along), dot(last, first)) : 0;
  for (Station& s : stations) {
    s.v /= way;
    s.b = cross(s.along, s.a);
    const Vec3d a = turned(s, twist * s.v);
    s.a = a;
    s.b = cross(s.along, a);
  }
  return stations;
}

// Rings of points around the path, from its start to its end.
class Rings {
 public:
  Rings(int segments) : segments_(static_cast<std::size_t>(segments)) {}

  std::size_t points() const { return segments_ + 1; }
  // On the ball at a place, where its normal is so far towards `along`: a sine, of which 1 is the pole.
  std::uint32_t ring(const Station& s, double sine) {
    const double cosine = safe_sqrt(1 - sine * sine);
    std::uint32_t first = 0;
    for (std::size_t i = 0; i <= segments_; ++i) {
      // The last is where the first is.
      const double angle = 2 * pi * static_cast<double>(i % segments_) / static_cast<double>(segments_);
      const Vec3d normal = turned(s, angle) * cosine + s.along * sine;
      const Vec3d position =
          std::abs(sine) == 1 ? s.center + s.along * (sine * s.radius) : s.center + normal * s.radius;
      const std::uint32_t point =
          maker.point(position, normal, {static_cast<double>(i) / static_cast<double>(segments_), s.v});
      if (i == 0) first = point;
    }
    return first;
  }
  MeshMaker maker;

 private:
  static double safe_sqrt(double x) { return std::sqrt(std::max(0.0, x)); }
  std::size_t segments_;
};

// Whether the rings around two places cross on the inner side of a bend.
bool folds(const Station& s, const Station& next, int segments) {
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * pi * i / segments;
    const auto at = [&](const Station& p) {
      const double cosine = std::sqrt(1 - p.growth * p.growth);
      return p.center + (turned(p, angle) * cosine - p.along * p.growth) * p.radius;
    };
    if (dot(at(next) - at(s), s.along + next.along) <= 0 && s.radius > 0 && next.radius > 0) return true;
  }
  return false;
}

}  // namespace

Problems Sweep::validate() const {
  Problems problems;
  want_segments(problems, "segments", segments, 3);
  const std::size_t n = path.size();
  if (n < 2) {
    problems.push_back({"path", fmt::format("a path takes two points at least, found {}", n),
                        "a ball that stays where it is is a `sphere`"});
    return problems;
  }
  for (std::size_t i = 0; i + 1 < n; ++i)
    if (path[i] == path[i + 1]) {
      problems.push_back(
          {"path", fmt::format("points {} and {} of the path are the same", i, i + 1), "leave one out"});
      return problems;
    }
  if (n == 3 && path[0] == path[2])
    problems.push_back(
        {"path", "the path goes back to where it began", "a ring takes three places at least"});
  const std::size_t given = radius.values.size();
  if (given != 1 && given != 2 && given != n)
    problems.push_back({"radius", fmt::format("'radius' holds {}, and the path has {} points", given, n),
                        "give one, two for both ends, or one for each point"});
  double largest = 0;
  for (const double r : radius.values) {
    if (!(r >= 0) && problems.empty()) want_not_negative(problems, "radius", r);
    largest = std::max(largest, r);
  }
  if (problems.empty()) want_positive(problems, "radius", largest);
  if (problems.empty() && is_ring(*this) && radius.at(0, n) != radius.at(n - 1, n))
    problems.push_back({"radius", "the path ends where it began, with another radius",
                        "give both ends the same, or end it elsewhere"});
  want_few_facets(problems, "segments", facets());
  return problems;
}

double Sweep::facets() const {
  return (static_cast<double>(path.size() - 1) * pieces_of_curve + segments / 2) * segments;
}

Made Sweep::make() const {
  const bool ring = is_ring(*this);
  std::vector<Knot> knots;
  for (std::size_t i = 0; i < path.size(); ++i)
    knots.push_back({path[i].x, path[i].y, path[i].z, radius.at(i, path.size())});
  const std::vector<Station> stations = stations_of(smooth_line(knots, ring), ring);
  const auto near = [](const Station& s) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", s.center.x, s.center.y, s.center.z);
  };
  for (const Station& s : stations)
    if (!(std::abs(s.growth) < 0.999))
      return {{},
              {{"radius", fmt::format("near {} the radius changes as fast as the ball moves", near(s)),
                "one ball holds the next: set points farther apart, or radii that differ less"}}};
  for (std::size_t i = 0; i + 1 < stations.size(); ++i)
    if (folds(stations[i], stations[i + 1], segments))
      return {{},
              {{"path",
                fmt::format("near {} the path bends more tightly than the radius {:.4g} allows",
                            near(stations[i]), stations[i].radius),
                "make it thinner or the bend wider; `curves` show any bend, but have no inside"}}};
  Rings rings(segments);
  const int rows = std::max(2, segments / 4);  // of each round end
  const auto cap = [&](const Station& s, double from, double to, std::uint32_t before, bool first_is_new) {
    for (int k = first_is_new ? 0 : 1; k <= rows; ++k) {
      const double sine = k == 0 ? from
                          : k == rows
                              ? to
                              : std::sin(std::asin(from) + (std::asin(to) - std::asin(from)) * k / rows);
      const std::uint32_t after = rings.ring(s, sine);
      if (k > 0) rings.maker.strip(before, after, rings.points());
      before = after;
    }
    return before;
  };
  std::uint32_t before = ring ? rings.ring(stations.front(), -stations.front().growth)
                              : cap(stations.front(), -1, -stations.front().growth, 0, true);
  for (std::size_t i = 1; i < stations.size(); ++i) {
    const std::uint32_t after = rings.ring(stations[i], -stations[i].growth);
    rings.maker.strip(before, after, rings.points());
    before = after;
  }
  if (!ring) cap(stations.back(), -stations.back().growth, 1, before, false);
  return {rings.maker.take(), {}};
}

}  // namespace tyndall::generate
