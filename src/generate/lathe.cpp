#include "generate/lathe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/numerics.h"
#include "generate/line.h"

namespace tyndall::generate {

namespace {

// The profile as straight pieces: what is smooth of it is cut into them, from corner to corner.
std::vector<Pair<double>> drawn(const Lathe& lathe) {
  if (!lathe.smooth) return lathe.profile;
  const std::vector<Pair<double>>& given = lathe.profile;
  const bool ring = given.front() == given.back();
  std::vector<Pair<double>> line;
  std::vector<Knot> part{{given[0].x, given[0].y, 0, 0}};
  const auto end_part = [&](bool closed) {
    for (const Knot& k : smooth_line(part, closed)) {
      const Pair<double> p{std::max(0.0, k[0]), k[1]};  // a curve may swing a little beyond the axis
      if (line.empty() || !(line.back() == p)) line.push_back(p);
    }
  };
  bool cornered = false;
  for (std::size_t i = 1; i < given.size(); ++i) {
    if (given[i] == given[i - 1]) {
      end_part(false);
      part.clear();
      cornered = true;
    }
    part.push_back({given[i].x, given[i].y, 0, 0});
  }
  end_part(ring && !cornered);
  return line;
}

// Twice the volume, over pi, that the profile encloses with the axis; positive where the outside is to the
// right of it.
double enclosed(const std::vector<Pair<double>>& line) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Pair<double>&a = line[i], &b = line[i + 1];
    sum += (a.x * a.x + a.x * b.x + b.x * b.x) * (b.y - a.y);
  }
  return sum;
}

bool is_body(const std::vector<Pair<double>>& profile) {
  return (profile.front().x == 0 && profile.back().x == 0) || profile.front() == profile.back();
}

// Rings of points about the axis.
class Turned {
 public:
  explicit Turned(std::size_t segments) {
    for (std::size_t i = 0; i < segments; ++i) {
      const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(segments);
      around_.push_back({std::cos(angle), -std::sin(angle)});
    }
    around_.push_back(around_[0]);  // the same place, of another uv
  }
  std::size_t points() const { return around_.size(); }

  // The number of its first point.
  std::uint32_t ring(const Pair<double>& place, const Pair<double>& normal, double along) {
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < around_.size(); ++i) {
      const auto& [x, z] = around_[i];
      const double u = static_cast<double>(i) / static_cast<double>(around_.size() - 1);
      const std::uint32_t point = maker.point({place.x * x, place.y, place.x * z},
                                              {normal.x * x, normal.y, normal.x * z}, {u, along});
      if (i == 0) first = point;
    }
    return first;
  }
  MeshMaker maker;

 private:
  std::vector<Pair<double>> around_;
};

}  // namespace

Problems Lathe::validate() const {
  Problems problems;
  want_segments(problems, "segments", segments, 3);
  if (profile.size() < 2) {
    problems.push_back({"profile",
                        fmt::format("a profile takes two points at least, found {}", profile.size()),
                        "write [(radius, y), …], from one end to the other"});
    return problems;
  }
  if (profile.size() > most_outline_points) {
    problems.push_back({"profile", fmt::format("more than {} points of a profile", most_outline_points)});
    return problems;
  }
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (profile[i].x >= 0) continue;
    problems.push_back(
        {"profile", fmt::format("the profile crosses the axis: point {} has the radius {}", i, profile[i].x),
         "the other half comes by itself; begin and end at radius 0"});
    return problems;
  }
  const auto on_axis = [](const Pair<double>& p) { return p.x == 0; };
  if (std::all_of(profile.begin(), profile.end(), on_axis))
    problems.push_back({"profile", "all of the profile lies on the axis", "give it a radius somewhere"});
  else if (std::all_of(profile.begin(), profile.end(),
                       [&](const Pair<double>& p) { return p == profile.front(); }))
    problems.push_back({"profile", "all points of the profile are the same", "give it two that differ"});
  want_few_facets(problems, "segments", facets());
  return problems;
}

double Lathe::facets() const {
  return static_cast<double>((profile.size() - 1) * (smooth ? pieces_of_curve : 1)) * segments;
}

Made Lathe::make() const {
  std::vector<Pair<double>> line = drawn(*this);
  const bool body = is_body(profile);
  if (body) {
    // The piece from the last point to the first, if there is one, lies on the axis and crosses nothing.
    if (const auto found = crossings({line}, 1); !found.empty())
      return {{},
              {{"profile",
                fmt::format("the profile crosses itself near ({:.4g}, {:.4g})", found[0].at.x, found[0].at.y),
                "what encloses a body goes around it once"}}};
  }
  const bool reversed = enclosed(line) < 0;
  if (reversed) std::reverse(line.begin(), line.end());
  const bool ring = line.front() == line.back();
  if (ring) line.pop_back();
  const std::vector<Piece> pieces = pieces_of(line, ring);
  Turned turned(static_cast<std::size_t>(segments));
  const auto along = [&](double from_first) { return reversed ? 1 - from_first : from_first; };
  std::uint32_t below = 0, above = 0;
  for (const Piece& piece : pieces) {
    below = piece.begins_anew ? turned.ring(piece.from, piece.normal_from, along(piece.along_from)) : above;
    above = turned.ring(piece.to, piece.normal_to, along(piece.along_to));
    turned.maker.strip(below, above, turned.points());
  }
  return {turned.maker.take(), {}};
}

}  // namespace tyndall::generate
