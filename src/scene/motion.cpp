#include "scene/motion.h"

#include <array>
#include <optional>
#include <type_traits>

#include "base/check.h"
#include "base/numerics.h"
#include "scene/scene.h"

namespace tyndall::scene {

namespace {

// No thing has more: a volume has a shape and two transforms.
constexpr std::size_t max_moving_numbers = 64;

// Calls visit(double or float) for every number of a thing that may move.
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
  void of(Transform& t) {
    for (Vec3d* column : {&t.x, &t.y, &t.z, &t.t}) of(*column);
  }
  template <class T>
  void of(std::optional<T>& v) {
    if (v) of(*v);
  }
  // What a picture all around is drawn by was made for it as it is when the shutter opens.
  void of(optics::EnvironmentLight& light) {
    if (!light.radiance.picture[0]) of(light.radiance.color);
  }
  void of(optics::MeshLight& light) {
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
  template <class T>
  void of(T& thing) requires requires {
    T::keyword;
  }
  {
    T::fields([&](auto member, const FieldInfo&) { of(thing.*member); });
  }

 private:
  F& visit_;
};

template <class T, class F>
void visit_numbers(T& thing, F&& visit) {
  Numbers<std::remove_reference_t<F>>(visit).of(thing);
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

template std::vector<double> moving_numbers(const ShapeInstance&);
template std::vector<double> moving_numbers(const Instance&);
template std::vector<double> moving_numbers(const Volume&);
template std::vector<double> moving_numbers(const LightInstance&);
template std::vector<double> moving_numbers(const Camera&);
template ShapeInstance between(const ShapeInstance&, const ShapeInstance&, double);
template Instance between(const Instance&, const Instance&, double);
template Volume between(const Volume&, const Volume&, double);
template LightInstance between(const LightInstance&, const LightInstance&, double);
template Camera between(const Camera&, const Camera&, double);

double shutter_seconds(const Animation& animation) {
  return animation.shutter.radians / (2 * pi * animation.fps);
}

}  // namespace tyndall::scene
