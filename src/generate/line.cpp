#include "generate/line.h"

#include <algorithm>
#include <cmath>

#include "base/numerics.h"

namespace tyndall::generate {

namespace {

Knot mixed(const Knot& a, const Knot& b, double weight_a, double weight_b) {
  Knot out{};
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = weight_a * a[k] + weight_b * b[k];
  return out;
}

// The square root of the distance in space.
double knot_step(const Knot& a, const Knot& b) {
  return std::sqrt(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
}

// The curve's derivative at `here`, for its knots' parameter.
Knot slope(const Knot& before, const Knot& here, const Knot& after) {
  const double h0 = knot_step(before, here), h1 = knot_step(here, after);
  const Knot d0 = mixed(here, before, 1 / h0, -1 / h0), d1 = mixed(after, here, 1 / h1, -1 / h1);
  return mixed(d0, d1, h1 / (h0 + h1), h0 / (h0 + h1));
}

// At an end: of the parabola through the end with the slope of the other.
Knot slope_at_end(const Knot& end, const Knot& next, const Knot& slope_next, double step) {
  return mixed(mixed(next, end, 2 / step, -2 / step), slope_next, 1, -1);
}

Pair<double> right_of(const Pair<double>& from, const Pair<double>& to) {
  const double x = to.x - from.x, y = to.y - from.y, size = std::hypot(x, y);
  return {y / size, -x / size};
}

double side_of(const Pair<double>& a, const Pair<double>& b, const Pair<double>& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

}  // namespace

std::vector<Knot> smooth_line(const std::vector<Knot>& points, bool closed) {
  const std::size_t n = points.size();
  if (n < 3) return points;
  std::vector<Knot> slopes(n);
  for (std::size_t i = 1; i + 1 < n; ++i) slopes[i] = slope(points[i - 1], points[i], points[i + 1]);
  if (closed) {
    slopes[0] = slopes[n - 1] = slope(points[n - 2], points[0], points[1]);
  } else {
    slopes[0] = slope_at_end(points[0], points[1], slopes[1], knot_step(points[0], points[1]));
    slopes[n - 1] = mixed(slope_at_end(points[n - 1], points[n - 2], mixed(slopes[n - 2], {}, -1, 0),
                                       knot_step(points[n - 1], points[n - 2])),
                          {}, -1, 0);
  }
  std::vector<Knot> line{points[0]};
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double step = knot_step(points[i], points[i + 1]);
    for (std::size_t k = 1; k < pieces_of_curve; ++k) {
      const double t = static_cast<double>(k) / pieces_of_curve, s = 1 - t;
      const Knot ends = mixed(points[i], points[i + 1], s * s * (1 + 2 * t), t * t * (3 - 2 * t));
      const Knot ways = mixed(slopes[i], slopes[i + 1], step * t * s * s, -step * t * t * s);
      line.push_back(mixed(ends, ways, 1, 1));
    }
    line.push_back(points[i + 1]);
  }
  return line;
}

std::vector<Piece> pieces_of(const std::vector<Pair<double>>& line, bool closed) {
  std::vector<Piece> pieces;
  double length = 0;
  const auto add = [&](const Pair<double>& from, const Pair<double>& to) {
    if (from == to) return;
    const Pair<double> normal = right_of(from, to);
    const double begin = length;
    length += std::hypot(to.x - from.x, to.y - from.y);
    pieces.push_back({from, to, normal, normal, true, begin, length});
  };
  for (std::size_t i = 0; i + 1 < line.size(); ++i) add(line[i], line[i + 1]);
  if (closed && !line.empty()) add(line.back(), line.front());
  for (Piece& piece : pieces) {
    piece.along_from /= length;
    piece.along_to /= length;
  }
  const double least_cosine = std::cos(crease_degrees * pi / 180);
  const std::size_t n = pieces.size();
  std::vector<Pair<double>> flat(n);
  for (std::size_t i = 0; i < n; ++i) flat[i] = pieces[i].normal_from;
  for (std::size_t i = closed ? 0 : 1; i < n; ++i) {
    const std::size_t before = i == 0 ? n - 1 : i - 1;
    const Pair<double>&a = flat[before], &b = flat[i];
    if (a.x * b.x + a.y * b.y < least_cosine) continue;
    const double size = std::hypot(a.x + b.x, a.y + b.y);
    pieces[before].normal_to = pieces[i].normal_from = {(a.x + b.x) / size, (a.y + b.y) / size};
    pieces[i].begins_anew = i == 0;
  }
  return pieces;
}

std::vector<Crossing> crossings(const std::vector<std::vector<Pair<double>>>& outlines, std::size_t most) {
  struct Side {
    Pair<double> a, b;
    std::size_t outline;
    double lowest() const { return std::min(a.x, b.x); }
    double highest() const { return std::max(a.x, b.x); }
  };
  std::vector<Side> sides;
  for (std::size_t o = 0; o < outlines.size(); ++o)
    for (std::size_t i = 0; i < outlines[o].size(); ++i)
      sides.push_back({outlines[o][i], outlines[o][(i + 1) % outlines[o].size()], o});
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.lowest() < b.lowest(); });
  std::vector<Crossing> found;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side& s = sides[i];
    for (std::size_t k = i + 1; k < sides.size() && sides[k].lowest() <= s.highest(); ++k) {
      const Side& o = sides[k];
      if (std::max(s.a.y, s.b.y) < std::min(o.a.y, o.b.y) || std::max(o.a.y, o.b.y) < std::min(s.a.y, s.b.y))
        continue;
      const double from = side_of(s.a, s.b, o.a), to = side_of(s.a, s.b, o.b);
      if (from * to >= 0 || side_of(o.a, o.b, s.a) * side_of(o.a, o.b, s.b) >= 0) continue;
      const double t = from / (from - to);
      found.push_back({s.outline, o.outline, {o.a.x + (o.b.x - o.a.x) * t, o.a.y + (o.b.y - o.a.y) * t}});
      if (found.size() == most) return found;
    }
  }
  return found;
}

}  // namespace tyndall::generate
