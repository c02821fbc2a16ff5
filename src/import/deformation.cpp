#include "import/deformation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/numerics.h"
#include "base/vec.h"

namespace tyndall {

namespace {

using shapes::MeshPose;
using shapes::StrandPose;

// As the motion of whole things is judged (resolve/motion_error.h).
constexpr double share_of_way = 1.0 / 4000, share_of_length = 1.0 / 50;
constexpr double rounding = 1e-12;  // of the largest coordinate
// Where guesses between two poses are tested: at places that have no simple part in common.
constexpr std::array<double, 2> tests = first_tests;

bool same(const MeshPose& a, const MeshPose& b) {
  return a.points == b.points && a.normals == b.normals && a.tangents == b.tangents;
}
bool same(const StrandPose& a, const StrandPose& b) { return a.points == b.points && a.radii == b.radii; }

MeshPose pose_of(const shapes::TriangleMesh& mesh) { return {mesh.points, mesh.normals, mesh.tangents}; }
StrandPose pose_of(const shapes::StrandSet& strands) { return {strands.points, strands.radii}; }

class Judge {
 public:
  void see(const MeshPose& pose) { see_points(pose.points); }
  void see(const StrandPose& pose) {
    see_points(pose.points);
    for (const double radius : pose.radii) largest_radius_ = std::max(largest_radius_, radius);
  }
  // How far the truth is off from a guess between two poses, in what is near enough.
  double error(const MeshPose& truth, const MeshPose& a, const MeshPose& b, double part) const {
    double turned = 0;
    for (std::size_t i = 0; i < truth.normals.size(); ++i) {
      const Vec3d &n = truth.normals[i], g = a.normals[i] * (1 - part) + b.normals[i] * part;
      const double n2 = length_squared(n), g2 = length_squared(g);
      if (!(n2 > 0)) continue;
      turned = std::max(turned, g2 > 0 ? length_squared(n / std::sqrt(n2) - g / std::sqrt(g2)) : 4.0);
    }
    return std::max(error_of_points(truth.points, a.points, b.points, part),
                    std::sqrt(turned) / share_of_length);
  }
  double error(const StrandPose& truth, const StrandPose& a, const StrandPose& b, double part) const {
    double off = 0;
    for (std::size_t i = 0; i < truth.radii.size(); ++i)
      off = std::max(off, std::abs(truth.radii[i] - (a.radii[i] * (1 - part) + b.radii[i] * part)));
    return std::max(error_of_points(truth.points, a.points, b.points, part),
                    off > 0 ? off / (share_of_length * largest_radius_) : 0.0);
  }

 private:
  void see_points(const std::vector<Vec3d>& points) {
    for (const Vec3d& p : points)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        lo_[axis] = std::min(lo_[axis], p[axis]);
        hi_[axis] = std::max(hi_[axis], p[axis]);
      }
  }
  double error_of_points(const std::vector<Vec3d>& truth, const std::vector<Vec3d>& a,
                         const std::vector<Vec3d>& b, double part) const {
    double side = 0, coordinate = 0, off = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      side = std::max(side, hi_[axis] - lo_[axis]);
      coordinate = std::max({coordinate, std::abs(lo_[axis]), std::abs(hi_[axis])});
    }
    for (std::size_t i = 0; i < truth.size(); ++i)
      off = std::max(off, length_squared(truth[i] - (a[i] * (1 - part) + b[i] * part)));
    return off > 0 ? std::sqrt(off) / (share_of_way * side + rounding * coordinate) : 0.0;
  }

  Vec3d lo_{infinity, infinity, infinity}, hi_{-infinity, -infinity, -infinity};
  double largest_radius_ = 0;
};

template <class Thing, class Pose>
PoseError add_poses(Thing& thing, const std::function<Pose(double fraction)>& pose_at, std::size_t points) {
  const Pose first = pose_of(thing);
  std::vector<Pose> later{pose_at(1)};
  std::array<Pose, 2> between{pose_at(tests[0]), pose_at(tests[1])};
  if (same(first, later[0]) && same(first, between[0]) && same(first, between[1])) return {};
  Judge judge;
  for (const Pose* pose : std::initializer_list<const Pose*>{&first, &later[0], &between[0], &between[1]})
    judge.see(*pose);
  const std::size_t most = std::clamp<std::size_t>(
      most_posed_points / std::max<std::size_t>(std::max(points, thing.points.size()), 1), 1,
      most_later_poses);
  PoseError error;
  while (true) {
    const std::size_t count = later.size();
    error = {};
    for (std::size_t k = 0; k < count; ++k) {
      double worst = 0;
      for (std::size_t t = 0; t < tests.size(); ++t) {
        const double fraction = (static_cast<double>(k) + tests[t]) / static_cast<double>(count);
        const Pose truth = count == 1 ? std::move(between[t]) : pose_at(fraction);
        worst = std::max(worst, judge.error(truth, k == 0 ? first : later[k - 1], later[k], tests[t]));
      }
      error.largest = std::max(error.largest, worst);
      if (worst > 1) error.off_share += 1 / static_cast<double>(count);
      if (error.off_share > 0 && 2 * count <= most) break;  // there will be more anyway
    }
    if (error.off_share == 0 || 2 * count > most) break;
    std::vector<Pose> finer(2 * count);
    for (std::size_t k = 0; k < count; ++k) {
      finer[2 * k] = pose_at((2 * static_cast<double>(k) + 1) / (2 * static_cast<double>(count)));
      finer[2 * k + 1] = std::move(later[k]);
      judge.see(finer[2 * k]);
    }
    later = std::move(finer);
  }
  thing.later = std::move(later);
  return error;
}

}  // namespace

PoseError add_later_poses(shapes::TriangleMesh& mesh, const std::function<MeshPose(double fraction)>& pose_at,
                          std::size_t points) {
  return add_poses(mesh, pose_at, points);
}

PoseError add_later_poses(shapes::StrandSet& strands,
                          const std::function<StrandPose(double fraction)>& pose_at, std::size_t points) {
  return add_poses(strands, pose_at, points);
}

std::optional<std::string> uneven_motion(std::string_view what, const shapes::TriangleMesh& mesh,
                                         const PoseError& error) {
  // A jump is in one of so many parts, and too short to be seen.
  if (error.off_share <= 1.5 / static_cast<double>(most_later_poses)) return std::nullopt;
  return fmt::format(
      "{} that moves too unevenly while the shutter is open: of {} poses the blur is off by up to {:.2g} "
      "times what would be seen",
      what, mesh.later.size() + 1, error.largest);
}

}  // namespace tyndall
