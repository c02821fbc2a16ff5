#include "compile/geometry/bounds_tree.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/check.h"
#include "base/numerics.h"
#include "base/parallel.h"
#include "base/rounding.h"
#include "shapes/sphere.h"

namespace tyndall::compile {

namespace {

// Embree walks the tree in float. A ray whose origin is within twice the radius R of all boxes about the
// origin of render space is off by at most 2R·2^-24 at its start and 4R·√3·2^-24 at its end, so boxes grown
// by R·2^-20 lose none.
constexpr double float_ray_margin = 0x1p-20;

// One for all trees: a device has threads and memory of its own. Its pool ends the program when it cannot
// have its threads, so that it is asked before whether it can.
RTCDevice device() {
  struct Device {
    RTCDevice handle = rtcNewDevice(can_have_threads(hardware_threads()) ? nullptr : "threads=1");
    ~Device() { rtcReleaseDevice(handle); }
  };
  static const Device one;
  CHECK(one.handle != nullptr);
  return one.handle;
}

struct Query {
  RTCIntersectContext context;  // first: Embree hands it back
  double (*callback)(void*, std::uint32_t);
  void* visitor;
  double t_offset;  // of the float ray's start along the caller's ray
  double scale;     // length of the caller's direction: the float ray's is unit
};

void intersect_box(const RTCIntersectFunctionNArguments* arguments) {
  CHECK_EQ(arguments->N, 1u);
  if (!arguments->valid[0]) return;
  auto* query = reinterpret_cast<Query*>(arguments->context);
  auto* ray = reinterpret_cast<RTCRayHit*>(arguments->rayhit);
  const double t_max = query->callback(query->visitor, arguments->primID);
  if (t_max < 0)
    ray->ray.tfar = -std::numeric_limits<float>::infinity();
  else
    ray->ray.tfar = std::min(ray->ray.tfar, float_above((t_max - query->t_offset) * query->scale));
}

}  // namespace

struct BoundsTree::Impl {
  RTCScene scene = nullptr;
  const BoxAt* box = nullptr;  // while the tree is built
  double radius = 0;           // of a sphere about render space's origin that holds all boxes
  double margin = 0;

  ~Impl() {
    if (scene) rtcReleaseScene(scene);
  }
  void measure(std::uint32_t count, std::uint32_t moments);
  static void bounds_of(const RTCBoundsFunctionArguments* arguments);
};

void BoundsTree::Impl::measure(std::uint32_t count, std::uint32_t moments) {
  double fastest = 0;  // from moment to moment
  for (std::uint32_t i = 0; i < count; ++i) {
    Bounds before = (*box)(i, 0);
    for (std::uint32_t moment = 0; moment < moments; ++moment) {
      const Bounds b = moment == 0 ? before : (*box)(i, moment);
      for (int axis = 0; axis < 3; ++axis) {
        radius = std::max({radius, std::abs(b.lo[axis]), std::abs(b.hi[axis])});
        fastest = std::max(
            {fastest, std::abs(b.lo[axis] - before.lo[axis]), std::abs(b.hi[axis] - before.hi[axis])});
      }
      before = b;
    }
  }
  radius *= std::sqrt(3.0);
  // Nodes of moving boxes are the ends, at 0 and 1, of the straight way on which a box is for a while.
  margin = (radius + fastest * moments) * float_ray_margin;
}

void BoundsTree::Impl::bounds_of(const RTCBoundsFunctionArguments* arguments) {
  const Impl& self = *static_cast<const Impl*>(arguments->geometryUserPtr);
  const Bounds b = (*self.box)(arguments->primID, arguments->timeStep);
  RTCBounds& out = *arguments->bounds_o;
  out.lower_x = static_cast<float>(b.lo.x - self.margin);
  out.lower_y = static_cast<float>(b.lo.y - self.margin);
  out.lower_z = static_cast<float>(b.lo.z - self.margin);
  out.upper_x = static_cast<float>(b.hi.x + self.margin);
  out.upper_y = static_cast<float>(b.hi.y + self.margin);
  out.upper_z = static_cast<float>(b.hi.z + self.margin);
}

BoundsTree::BoundsTree(std::span<const Bounds> boxes)
    : BoundsTree(static_cast<std::uint32_t>(boxes.size()), 1,
                 [&](std::uint32_t i, std::uint32_t) { return boxes[i]; }) {}

BoundsTree::BoundsTree(std::uint32_t count, std::uint32_t moments, const BoxAt& box)
    : impl_(std::make_unique<Impl>()) {
  CHECK(moments >= 1 && moments <= most_moments);
  if (count == 0) return;
  impl_->box = &box;
  impl_->measure(count, moments);
  impl_->scene = rtcNewScene(device());
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, count);
  rtcSetGeometryTimeStepCount(geometry, moments);
  rtcSetGeometryUserData(geometry, impl_.get());
  rtcSetGeometryBoundsFunction(geometry, Impl::bounds_of, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_box);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(impl_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(impl_->scene);
  impl_->box = nullptr;
  CHECK_EQ(static_cast<int>(rtcGetDeviceError(device())), static_cast<int>(RTC_ERROR_NONE));
}

BoundsTree::~BoundsTree() = default;
BoundsTree::BoundsTree(BoundsTree&&) noexcept = default;

void BoundsTree::visit_boxes(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max,
                             double time, Callback callback, void* visitor) const {
  if (!impl_->scene) return;
  Query query{};
  rtcInitIntersectContext(&query.context);
  query.callback = callback;
  query.visitor = visitor;
  query.scale = length(direction);

  // A ray that starts far outside begins, for the tree, where it enters the sphere around all boxes.
  Vec3d start = origin;
  if (length_squared(origin) > sqr(2 * impl_->radius)) {
    const Intervald stay =
        shapes::Sphere{{0, 0, 0}, 1.5 * impl_->radius}.inside(origin, direction).clipped_to({0, t_max});
    if (stay.empty()) return;
    query.t_offset = stay.lo;
    start = origin + direction * stay.lo;
  }

  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(start.x);
  ray.ray.org_y = static_cast<float>(start.y);
  ray.ray.org_z = static_cast<float>(start.z);
  ray.ray.dir_x = static_cast<float>(direction.x / query.scale);
  ray.ray.dir_y = static_cast<float>(direction.y / query.scale);
  ray.ray.dir_z = static_cast<float>(direction.z / query.scale);
  // What is hit at t_min is within the margin of its box: rounding of t is a part of it.
  ray.ray.tnear = std::max(float_below((t_min - query.t_offset) * query.scale), 0.0f);
  ray.ray.tfar = float_above((t_max - query.t_offset) * query.scale);
  ray.ray.time = std::clamp(static_cast<float>(time), 0.0f, 1.0f);
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &query.context, &ray);
}

}  // namespace tyndall::compile
