// The way from one transform to another.
#include "base/transform_mix.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

namespace {

Transform transposed(const Transform& m) {
  return {{m.x.x, m.y.x, m.z.x}, {m.x.y, m.y.y, m.z.y}, {m.x.z, m.y.z, m.z.z}, {}};
}

Transform lerped(const Transform& a, const Transform& b, double t) {
  const auto between = [t](const Vec3d& from, const Vec3d& to) { return from * (1 - t) + to * t; };
  return {between(a.x, b.x), between(a.y, b.y), between(a.z, b.z), between(a.t, b.t)};
}

Transform scaled(const Transform& m, double by) { return {m.x * by, m.y * by, m.z * by, {}}; }

// The nearest rotation to a map that does not mirror, by Newton's iteration (Higham 1986); nothing when it
// flattens.
std::optional<Transform> nearest_rotation(const Transform& m) {
  Transform q = m;
  constexpr int rounds = 100;
  for (int i = 0; i < rounds; ++i) {
    const std::optional<Transform> inverse = q.inverse();
    if (!inverse) return std::nullopt;
    const Transform next = lerped(q, transposed(*inverse), 0.5);
    const double change = length(next.x - q.x) + length(next.y - q.y) + length(next.z - q.z);
    q = next;
    if (change < 1e-14) break;
  }
  return q;
}

double dot(const Quaternion& a, const Quaternion& b) { return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z; }

// Shepperd's method: divides by the largest of the four.
Quaternion quaternion(const Transform& r) {
  const double trace = r.x.x + r.y.y + r.z.z;
  if (trace > 0) {
    const double s = 2 * std::sqrt(trace + 1);
    return {s / 4, (r.y.z - r.z.y) / s, (r.z.x - r.x.z) / s, (r.x.y - r.y.x) / s};
  }
  if (r.x.x > r.y.y && r.x.x > r.z.z) {
    const double s = 2 * std::sqrt(1 + r.x.x - r.y.y - r.z.z);
    return {(r.y.z - r.z.y) / s, s / 4, (r.y.x + r.x.y) / s, (r.z.x + r.x.z) / s};
  }
  if (r.y.y > r.z.z) {
    const double s = 2 * std::sqrt(1 + r.y.y - r.x.x - r.z.z);
    return {(r.z.x - r.x.z) / s, (r.y.x + r.x.y) / s, s / 4, (r.z.y + r.y.z) / s};
  }
  const double s = 2 * std::sqrt(1 + r.z.z - r.x.x - r.y.y);
  return {(r.x.y - r.y.x) / s, (r.z.x + r.x.z) / s, (r.z.y + r.y.z) / s, s / 4};
}

Transform rotation(const Quaternion& q) {
  return {{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.w * q.z), 2 * (q.x * q.z - q.w * q.y)},
          {2 * (q.x * q.y - q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.w * q.x)},
          {2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)},
          {}};
}

}  // namespace

std::optional<Pose> pose_of(const Transform& m) {
  const Transform linear{m.x, m.y, m.z, {}};
  const double side = m.determinant() < 0 ? -1 : 1;
  const std::optional<Transform> turned = nearest_rotation(scaled(linear, side));
  if (!turned) return std::nullopt;
  return Pose{quaternion(*turned), transposed(*turned) * linear};
}

double angle_between(const Quaternion& a, const Quaternion& b) {
  const double side = dot(a, b) < 0 ? -1 : 1;
  const Quaternion d{a.w - side * b.w, a.x - side * b.x, a.y - side * b.y, a.z - side * b.z};
  return 4 * std::asin(std::min(std::sqrt(dot(d, d)) / 2, 1.0));
}

std::optional<PoseMix> PoseMix::between(const Pose& a, const Pose& b) {
  if ((a.interval.determinant() < 0) != (b.interval.determinant() < 0)) return std::nullopt;
  PoseMix mix;
  mix.a_ = a;
  mix.b_ = b;
  double cosine = dot(a.rotation, b.rotation);
  if (cosine < 0) {  // the other quaternion of the same rotation is nearer
    const Quaternion& q = b.rotation;
    mix.b_.rotation = {-q.w, -q.x, -q.y, -q.z};
    cosine = -cosine;
  }
  if (cosine < 1 - 1e-12) {
    mix.angle_ = std::acos(cosine);
    mix.sine_ = std::sin(mix.angle_);
  }
  return mix;
}

Transform PoseMix::at(double t) const {
  double weight_a = 1 - t, weight_b = t;
  if (angle_ > 0) {
    weight_a = std::sin((1 - t) * angle_) / sine_;
    weight_b = std::sin(t * angle_) / sine_;
  }
  const Quaternion &a = a_.rotation, &b = b_.rotation;
  const Quaternion q{weight_a * a.w + weight_b * b.w, weight_a * a.x + weight_b * b.x,
                     weight_a * a.y + weight_b * b.y, weight_a * a.z + weight_b * b.z};
  const double norm = std::sqrt(dot(q, q));
  return rotation({q.w / norm, q.x / norm, q.y / norm, q.z / norm}) * lerped(a_.interval, b_.interval, t);
}

Transform mix(const Transform& a, const Transform& b, double t) {
  const Transform straight = lerped(a, b, t);
  const std::optional<Pose> pa = pose_of(a), pb = pose_of(b);
  const std::optional<PoseMix> turned = pa && pb ? PoseMix::between(*pa, *pb) : std::nullopt;
  if (!turned) return straight;
  Transform mixed = turned->at(t);
  mixed.t = straight.t;
  return mixed;
}

}  // namespace tyndall
