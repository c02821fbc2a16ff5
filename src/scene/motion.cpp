#include "scene/motion.h"

#include <array>
#include <cmath>
#include <type_traits>

#include "base/check.h"
#include "base/numerics.h"
#include "scene/scene.h"

namespace tyndall::scene {

namespace {

// No thing has more: a volume has a shape and two transforms.
constexpr std::size_t max_moving_numbers = 64;

// Calls visit(double or float) for every number of a thing that may move; visit.transform(transform), if
// there is that, for whole transforms instead.
template <class F>
class Numbers {
 public:
  explicit Numbers(F& visit) : visit_(visit) {}

  void of(double& x) { visit_(x); }
  void of(float& x) { visit_(x); }
  void of(Angle& a) { visit_(a.radians); }
  template <class T>
  void of(Vec3<T>& v) {
    for (std::size_t k = 0; k < 3; ++k) visit_(v[k]);
  }
  void of(Transform& t) requires requires(F& f) { f.transform(t); }
  { visit_.transform(t); }
  void of(Transform& t) {
    for (Vec3d* column : {&t.x, &t.y, &t.z, &t.t}) of(*column);
  }
  template <class T>
  void of(std::optional<T>& v) {
    if (v) of(*v);
  }
  // One colour looks the same however it is turned.
  void of(EnvironmentLight& light) {
    of(light.radiance.color);
    if (!light.radiance.picture[0]) return;
    of(light.rotation);
    of(light.world_from_sky);
  }
  void of(AreaLight& light) {
    of(light.shape);
    of(light.power);
    of(light.radiance);
    of(light.world_from_shape);
  }
  void of(ShapeInstance& s) {
    of(s.shape);
    of(s.world_from_object);
  }
  void of(Instance& i) { of(i.world_from_object); }
  void of(Volume& v) {
    of(v.shape);
    of(v.world_from_shape);
    of(v.world_from_medium);
  }
  void of(LightInstance& l) { of(l.light); }
  template <class... T>
  void of(std::variant<T...>& v) {
    std::visit([&](auto& alternative) { of(alternative); }, v);
  }
  void of(Mesh&) {}
  void of(Curves&) {}
  void of(bool&) {}
  void of(image::Exposure&) {}
  void of(image::Tonemap&) {}
  template <class T>
  void of(T& thing) requires requires {
    T::keyword;
  }
  {
    T::fields([&](auto member, const FieldInfo& info) {
      if constexpr (requires { visit_.in_metres; })
        visit_.in_metres = info.quantity == Quantity::position || info.quantity == Quantity::length;
      of(thing.*member);
    });
  }

 private:
  F& visit_;
};

template <class T, class F>
void visit_numbers(T& thing, F&& visit) {
  Numbers<std::remove_reference_t<F>>(visit).of(thing);
}

struct PlainNumbers {
  std::vector<MovingNumber> list{};
  bool in_metres = false;
  void operator()(double& x) { list.push_back({x, 0, in_metres}); }
  void operator()(float& x) { list.push_back({x, std::abs(double{x}) * 0x1p-22}); }
  void transform(const Transform&) {}
};

template <class Visit>
struct Transforms {
  Visit visit;
  void operator()(const double&) {}
  void transform(Transform& t) { visit(t); }
};

template <class T, class Visit>
void visit_transforms(T& thing, Visit visit) {
  visit_numbers(thing, Transforms<Visit>{visit});
}

// Part way from a to b, 0 to 1, every number straight. Both must be things of one kind with the same parts.
template <class T>
T between(const T& a, const T& b, double part) {
  if (part <= 0) return a;
  if (part >= 1) return b;
  T result = a, end = b;
  std::array<double, max_moving_numbers> to{};
  std::size_t count = 0, next = 0;
  visit_numbers(end, [&](auto& x) { to[count++] = x; });
  visit_numbers(result, [&](auto& x) {
    x = static_cast<std::remove_reference_t<decltype(x)>>(x + part * (to[next++] - x));
  });
  return result;
}

// Gives a transform whose numbers went straight from key k to the next the linear part that it has on its
// turn, about the pivot that went straight.
void turn(Transform& straight, const Turning& turning, std::size_t k, double part) {
  if (!turning.ways[k]) return;
  const Transform turned = turning.ways[k]->at(part);
  const Vec3d pivot = straight.point(turning.pivot);
  straight = turned;
  straight.t = pivot - turned.vector(turning.pivot);
}

// Where a moment is: after this key, so much of the way to the next.
struct Way {
  std::size_t key;
  double part;
};
Way way_at(const std::vector<double>& times, double fraction) {
  const auto after = std::upper_bound(times.begin() + 1, times.end() - 1, fraction);
  const auto k = static_cast<std::size_t>(after - times.begin()) - 1;
  return {k, (fraction - times[k]) / (times[k + 1] - times[k])};
}

double size_of(const Transform& linear) {
  return std::sqrt(length_squared(linear.x) + length_squared(linear.y) + length_squared(linear.z));
}

// How far a turn from key k to the next, in so many equal pieces, takes a point at distance 1 from the pivot
// off the straight line between the ends of a piece: an eighth of the largest second derivative.
double bend_of(const Turning& turning, std::size_t k, int pieces) {
  const auto &a = turning.poses[k], &b = turning.poses[k + 1];
  if (!a || !b) return 0;
  const double angle = angle_between(a->rotation, b->rotation) / pieces;
  const Transform change{
      b->interval.x - a->interval.x, b->interval.y - a->interval.y, b->interval.z - a->interval.z, {}};
  const double size = std::max(size_of(a->interval), size_of(b->interval));
  return (angle * angle * size + 2 * angle * size_of(change) / pieces) / 8;
}

// So that no piece turns further.
int pieces_of(const std::vector<Turning>& turnings, std::size_t k) {
  constexpr double most = pi / 12;
  double angle = 0;
  for (const Turning& t : turnings)
    if (t.poses[k] && t.poses[k + 1])
      angle = std::max(angle, angle_between(t.poses[k]->rotation, t.poses[k + 1]->rotation));
  return std::max(1, static_cast<int>(std::ceil(angle / most)));
}

}  // namespace

template <class T>
std::vector<double> moving_numbers(const T& thing) {
  std::vector<double> numbers;
  T copy = thing;
  visit_numbers(copy, [&](auto& x) { numbers.push_back(x); });
  return numbers;
}

template <class T>
std::vector<MovingNumber> plain_numbers(const T& thing) {
  PlainNumbers numbers;
  T copy = thing;
  visit_numbers(copy, numbers);
  return numbers.list;
}

template <class T>
std::vector<Transform> transforms_of(const T& thing) {
  std::vector<Transform> transforms;
  T copy = thing;
  visit_transforms(copy, [&](const Transform& t) { transforms.push_back(t); });
  return transforms;
}

template <class T>
void set_turnings(Moving<T>& moving, const std::vector<Vec3d>& pivots) {
  std::vector<Turning> turnings(pivots.size());
  bool any = false;
  for (std::size_t i = 0; i < pivots.size(); ++i) turnings[i].pivot = pivots[i];
  for (const T& key : moving.keys) {
    const std::vector<Transform> now = transforms_of(key), first = transforms_of(moving.keys.front());
    for (std::size_t i = 0; i < pivots.size(); ++i) {
      turnings[i].poses.push_back(pose_of(now[i]));
      any |= now[i].x != first[i].x || now[i].y != first[i].y || now[i].z != first[i].z;
    }
  }
  for (Turning& t : turnings)
    for (std::size_t k = 0; k + 1 < t.poses.size(); ++k)
      t.ways.push_back(t.poses[k] && t.poses[k + 1] ? PoseMix::between(*t.poses[k], *t.poses[k + 1])
                                                    : std::nullopt);
  if (any) moving.turnings = std::move(turnings);
}

template <class T>
T at(const Moving<T>& moving, double fraction) {
  const auto [key, part] = way_at(moving.times, fraction);
  T now = between(moving.keys[key], moving.keys[key + 1], part);
  if (moving.turnings.empty() || part <= 0 || part >= 1) return now;
  auto turning = moving.turnings.begin();
  visit_transforms(now, [&, k = key, along = part](Transform& t) { turn(t, *turning++, k, along); });
  return now;
}

template <class T>
MovingTransform::MovingTransform(const Moving<T>& moving, std::size_t which) : times_(moving.times) {
  for (const T& key : moving.keys) keys_.push_back(transforms_of(key)[which]);
  if (!moving.turnings.empty()) turning_ = moving.turnings[which];
}

Transform MovingTransform::at(double fraction) const {
  const auto [key, part] = way_at(times_, fraction);
  const Transform &a = keys_[key], &b = keys_[key + 1];
  if (part <= 0) return a;
  if (part >= 1) return b;
  Transform now{a.x + part * (b.x - a.x), a.y + part * (b.y - a.y), a.z + part * (b.z - a.z),
                a.t + part * (b.t - a.t)};
  if (turning_) turn(now, *turning_, key, part);
  return now;
}

template <class T>
bool moves_within(const Moving<T>& moving) {
  const auto numbers = [](const T& key) {
    std::vector<double> list;
    for (const MovingNumber& n : plain_numbers(key)) list.push_back(n.value);
    return list;
  };
  return std::any_of(moving.keys.begin(), moving.keys.end(),
                     [&](const T& key) { return numbers(key) != numbers(moving.keys.front()); });
}

template <class T>
std::vector<double> moments(const Moving<T>& moving, double lo, double hi) {
  std::vector<double> out{lo};
  for (std::size_t k = 0; k + 1 < moving.times.size(); ++k) {
    const int pieces = pieces_of(moving.turnings, k);
    const double from = moving.times[k], step = (moving.times[k + 1] - from) / pieces;
    for (int i = 0; i < pieces; ++i) {
      const double moment = from + i * step;
      if (lo < moment && moment < hi) out.push_back(moment);
    }
  }
  out.push_back(hi);
  return out;
}

template <class T>
double bend(const Moving<T>& moving, std::size_t transform) {
  if (moving.turnings.empty()) return 0;
  double most = 0;
  for (std::size_t k = 0; k + 1 < moving.times.size(); ++k)
    most = std::max(most, bend_of(moving.turnings[transform], k, pieces_of(moving.turnings, k)));
  return most;
}

// For each kind of thing that moves.
#define TYNDALL_MOVES(T)                                                    \
  template std::vector<double> moving_numbers(const T&);                    \
  template std::vector<MovingNumber> plain_numbers(const T&);               \
  template std::vector<Transform> transforms_of(const T&);                  \
  template void set_turnings(Moving<T>&, const std::vector<Vec3d>&);        \
  template T at(const Moving<T>&, double);                                  \
  template MovingTransform::MovingTransform(const Moving<T>&, std::size_t); \
  template bool moves_within(const Moving<T>&);                             \
  template std::vector<double> moments(const Moving<T>&, double, double);   \
  template double bend(const Moving<T>&, std::size_t);
TYNDALL_MOVES(ShapeInstance)
TYNDALL_MOVES(Instance)
TYNDALL_MOVES(Volume)
TYNDALL_MOVES(LightInstance)
TYNDALL_MOVES(Camera)
#undef TYNDALL_MOVES

double shutter_seconds(const Animation& animation) {
  const auto& [opens, closes] = animation.shutter;
  return (closes.radians - opens.radians) / (2 * pi * animation.fps);
}

double opening_seconds(const Animation& animation) {
  return animation.shutter.opens.radians / (2 * pi * animation.fps);
}
double opening_time(const Animation& animation, int frame) {
  return frame / animation.fps + opening_seconds(animation);
}

}  // namespace tyndall::scene
