// A mesh as it is at a moment: between two poses every number goes evenly. A mesh that does not deform costs
// a comparison.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/interval.h"
#include "shapes/mesh.h"

namespace tyndall::shapes {

// Of a thing with so many later poses: the first and the last between which it is within fractions of the
// time that the shutter is open, 0 its pose when the shutter opens.
struct PosesWithin {
  std::size_t first = 0, last = 0;
};
inline PosesWithin poses_within(const Intervald& time, std::size_t later) {
  const auto count = static_cast<double>(later);
  const double first = std::floor(time.lo * count), last = std::ceil(time.hi * count);
  return {static_cast<std::size_t>(std::clamp(first, 0.0, count)),
          static_cast<std::size_t>(std::clamp(last, 0.0, count))};
}

class MeshAt {
 public:
  // `time`: a fraction of the time that the shutter is open. The mesh must stay.
  MeshAt(const TriangleMesh& mesh, double time) : mesh_(mesh) {
    if (mesh.later.empty()) return;
    // In float, as Embree finds the boxes for a time.
    const float scaled = static_cast<float>(time) * static_cast<float>(mesh.later.size());
    const auto last = static_cast<std::int64_t>(mesh.later.size()) - 1;
    const std::int64_t before = std::clamp(static_cast<std::int64_t>(scaled), std::int64_t{0}, last);
    part_ = std::clamp(static_cast<double>(scaled - static_cast<float>(before)), 0.0, 1.0);
    before_ = before == 0 ? nullptr : &mesh.later[static_cast<std::size_t>(before) - 1];
    after_ = &mesh.later[static_cast<std::size_t>(before)];
  }

  Vec3d point(std::uint32_t i) const {
    return mixed(
        mesh_.points[i], i, [](const MeshPose& p) -> auto& { return p.points; });
  }
  Vec3d normal(std::uint32_t i) const {
    return mixed(
        mesh_.normals[i], i, [](const MeshPose& p) -> auto& { return p.normals; });
  }
  std::array<float, 4> tangent(std::uint32_t i) const {
    if (!after_) return mesh_.tangents[i];
    const std::array<float, 4>&a = before_ ? before_->tangents[i] : mesh_.tangents[i],
                            &b = after_->tangents[i];
    const auto part = static_cast<float>(part_);
    std::array<float, 4> out{0, 0, 0, a[3]};
    for (std::size_t k = 0; k < 3; ++k) out[k] = a[k] + (b[k] - a[k]) * part;
    return out;
  }

 private:
  template <class List>
  Vec3d mixed(const Vec3d& first, std::uint32_t i, List&& list) const {
    if (!after_) return first;
    const Vec3d& a = before_ ? list(*before_)[i] : first;
    return a * (1 - part_) + list(*after_)[i] * part_;
  }

  const TriangleMesh& mesh_;
  const MeshPose *before_ = nullptr, *after_ = nullptr;  // null: the mesh itself; it does not deform
  double part_ = 0;
};

}  // namespace tyndall::shapes
