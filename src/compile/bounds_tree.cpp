#include "compile/bounds_tree.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/check.h"
#include "base/numerics.h"
#include "base/parallel.h"

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

float rounded_down(double t) {
  return std::nextafter(static_cast<float>(t), -std::numeric_limits<float>::infinity());
}
float rounded_up(double t) {
  return std::nextafter(static_cast<float>(t), std::numeric_limits<float>::infinity());
}

void intersect_box(const RTCIntersectFunctionNArguments* arguments) {
  CHECK_EQ(arguments->N, 1u);
  if (!arguments->valid[0]) return;
  auto* query = reinterpret_cast<Query*>(arguments->context);
  auto* ray = reinterpret_cast<RTCRayHit*>(arguments->rayhit);
  const double t_max = query->callback(query->visitor, arguments->primID);
  if (t_max < 0)
    ray->ray.tfar = -std::numeric_limits<float>::infinity();
  else
    ray->ray.tfar = std::min(ray->ray.tfar, rounded_up((t_max - query->t_offset) * query->scale));
}

}  // namespace

struct BoundsTree::Impl {
  RTCScene scene = nullptr;
  std::span<const Bounds> boxes;  // while the tree is built
  double radius = 0;              // of a sphere about render space's origin that holds all boxes

  ~Impl() {
    if (scene) rtcReleaseScene(scene);
  }
};

BoundsTree::BoundsTree(std::span<const Bounds> boxes) : impl_(std::make_unique<Impl>()) {
  impl_->boxes = boxes;
  for (const Bounds& b : boxes)
    for (int axis = 0; axis < 3; ++axis)
      impl_->radius = std::max({impl_->radius, std::abs(b.lo[axis]), std::abs(b.hi[axis])});
  impl_->radius *= std::sqrt(3.0);
  if (boxes.empty()) return;

  impl_->scene = rtcNewScene(device());
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes.size()));
  rtcSetGeometryUserData(geometry, impl_.get());
  rtcSetGeometryBoundsFunction(
      geometry,
      [](const RTCBoundsFunctionArguments* arguments) {
        const Impl& self = *static_cast<const Impl*>(arguments->geometryUserPtr);
        const Bounds& b = self.boxes[arguments->primID];
        const double margin = self.radius * float_ray_margin;
        RTCBounds& out = *arguments->bounds_o;
        out.lower_x = static_cast<float>(b.lo.x - margin);
        out.lower_y = static_cast<float>(b.lo.y - margin);
        out.lower_z = static_cast<float>(b.lo.z - margin);
        out.upper_x = static_cast<float>(b.hi.x + margin);
        out.upper_y = static_cast<float>(b.hi.y + margin);
        out.upper_z = static_cast<float>(b.hi.z + margin);
      },
      nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect_box);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(impl_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(impl_->scene);
  impl_->boxes = {};
  CHECK_EQ(static_cast<int>(rtcGetDeviceError(device())), static_cast<int>(RTC_ERROR_NONE));
}

BoundsTree::~BoundsTree() = default;
BoundsTree::BoundsTree(BoundsTree&&) noexcept = default;

void BoundsTree::visit_boxes(const Vec3d& origin, const Vec3d& direction, double t_min, double t_max,
                             Callback callback, void* visitor) const {
  if (!impl_->scene) return;
  Query query{};
  rtcInitIntersectContext(&query.context);
  query.callback = callback;
  query.visitor = visitor;
  query.scale = length(direction);

  // A ray that starts far outside begins, for the tree, where it enters the sphere around all boxes.
  Vec3d start = origin;
  if (length_squared(origin) > sqr(2 * impl_->radius)) {
    const scene::Shape sphere = scene::Sphere{{0, 0, 0}, 1.5 * impl_->radius};
    const Intervald stay = inside(sphere, origin, direction, t_max);
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
  // What is met at t_min is within the margin of its box: rounding of t is a part of it.
  ray.ray.tnear = std::max(rounded_down((t_min - query.t_offset) * query.scale), 0.0f);
  ray.ray.tfar = rounded_up((t_max - query.t_offset) * query.scale);
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &query.context, &ray);
}

}  // namespace tyndall::compile
