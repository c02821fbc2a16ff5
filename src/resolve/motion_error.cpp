#include "resolve/motion_error.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/numerics.h"
#include "base/overloaded.h"

namespace tyndall::resolve {

namespace {

constexpr double share_of_way = 1.0 / 4000, share_of_size = 1.0 / 50, share_of_pixel = 0.1;
constexpr double least_share_of_way = share_of_way / 10;  // what is around the camera is near beyond measure
constexpr double rounding = 1e-11;  // of the largest of the numbers that are computed with

void widen(Intervald& range, double x) { range = {std::min(range.lo, x), std::max(range.hi, x)}; }

Ball around(const std::vector<Vec3d>& points, double more = 0) {
  if (points.empty()) return {{}, 1};
  std::array<Intervald, 3> box;
  box.fill({infinity, -infinity});
  for (const Vec3d& p : points)
    for (std::size_t axis = 0; axis < 3; ++axis) widen(box[axis], p[axis]);
  Ball ball;
  Vec3d half;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ball.center[axis] = (box[axis].lo + box[axis].hi) / 2;
    half[axis] = (box[axis].hi - box[axis].lo) / 2;
  }
  ball.radius = length(half) + more;
  return ball;
}

Marks marks_of(const Ball& ball) {
  const double r = ball.radius;
  return {ball.center, ball.center + Vec3d{r, 0, 0}, ball.center + Vec3d{0, r, 0},
          ball.center + Vec3d{0, 0, r}};
}

Marks placed(const Marks& marks, const Transform& to) {
  Marks out;
  for (std::size_t i = 0; i < marks.size(); ++i) out[i] = to.point(marks[i]);
  return out;
}

// The six ends of the ball's radii where a transform puts them.
void add_ends(std::vector<Vec3d>& points, const Ball& ball, const Transform& to) {
  const Marks m = placed(marks_of(ball), to);
  for (std::size_t i = 1; i < m.size(); ++i) points.insert(points.end(), {m[i], m[0] * 2.0 - m[i]});
}

double largest(const Vec3d& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

std::vector<Marks> all_marks(const scene::ShapeInstance& s, const Balls& balls) {
  return {marks_of(balls.of(s.shape))};
}
std::vector<Marks> all_marks(const scene::Instance& i, const Balls& balls) {
  return {marks_of(balls.of(i.prototype))};
}
std::vector<Marks> all_marks(const scene::Volume& v, const Balls& balls) {
  const Marks own = marks_of(balls.of(v.shape));
  const auto medium_from_world = v.world_from_medium.inverse();
  return {own, medium_from_world ? placed(own, *medium_from_world * v.world_from_shape) : own};
}
std::vector<Marks> all_marks(const scene::LightInstance& l, const Balls& balls) {
  // A picture all around is seen at any distance.
  if (const auto* sky = std::get_if<scene::EnvironmentLight>(&l.light))
    return sky->radiance.picture[0] ? std::vector<Marks>{marks_of({{}, 1})} : std::vector<Marks>{};
  const auto* area = std::get_if<scene::AreaLight>(&l.light);
  if (!area || !area->world_from_shape) return {};
  return {marks_of(balls.of(area->shape))};
}
std::vector<Marks> all_marks(const scene::Camera&, const Balls&) { return {}; }

// Where a thing's surface is in the world, if it has one.
template <class T>
std::optional<Marks> surface_marks(const T& thing, const Balls& balls) {
  const std::vector<Marks> own = all_marks(thing, balls);
  return own.empty() ? std::nullopt : std::optional(placed(own[0], scene::transforms_of(thing)[0]));
}
template <>
std::optional<Marks> surface_marks(const scene::LightInstance& l, const Balls& balls) {
  const auto* area = std::get_if<scene::AreaLight>(&l.light);
  if (!area) return std::nullopt;
  return placed(marks_of(balls.of(area->shape)), area->world_from_shape.value_or(Transform{}));
}

// What holds a tenth of a pixel within these sides, of a way of so many metres; none: at any distance.
double enough_of_way(const Eye& eye, const std::array<Intervald, 3>& box, double way) {
  if (box[0].lo > box[0].hi) return share_of_way * way;
  return std::clamp(share_of_pixel * eye.pixel(eye.distance(box)), least_share_of_way * way,
                    share_of_way * way);
}

double own_error(const auto&, const auto&, const Eye&) { return 0; }
double own_error(const scene::Camera& truth, const scene::Camera& guess, const Eye& eye) {
  const auto ends = [](const scene::Camera& camera) {
    return std::visit([](const auto& c) { return std::pair(c.from, c.to); }, camera);
  };
  const auto [from, to] = ends(truth);
  const auto [guessed_from, guessed_to] = ends(guess);
  const double off = std::max(length(from - guessed_from), length(to - guessed_to));
  const double distance = length(to - from);
  const double enough = std::min(share_of_way * distance, share_of_pixel * eye.pixel(distance)) +
                        rounding * std::max(largest(from), largest(to));
  return off > 0 ? off / enough : 0;
}

}  // namespace

Eye::Eye(const scene::Scene& scene) {
  const double height = scene.settings.resolution.height;
  std::visit([&](const auto& camera) { at_ = camera.from; }, scene.camera);
  std::visit(Overloaded{[&](const scene::PerspectiveCamera& c) {
                          angle_ = 2 * std::tan(c.fov.radians / 2) / height;
                        },
                        [&](const scene::OrthographicCamera& c) { width_ = c.height / height; },
                        [&](const scene::SphericalCamera&) { angle_ = pi / height; }},
             scene.camera);
}

double Eye::distance(const std::array<Intervald, 3>& box) const {
  Vec3d off;
  for (std::size_t axis = 0; axis < 3; ++axis)
    off[axis] = std::max({box[axis].lo - at_[axis], at_[axis] - box[axis].hi, 0.0});
  return length(off);
}

Balls::Balls(const scene::Scene& scene) : eye_(scene) {
  for (const scene::SharedMesh& mesh : scene.meshes) meshes_.push_back(around(mesh->points));
  for (const scene::StrandSet& set : scene.strand_sets)
    strand_sets_.push_back(
        around(set.points, set.radii.empty() ? 0 : *std::max_element(set.radii.begin(), set.radii.end())));
  for (const scene::Prototype& p : scene.prototypes) {
    std::vector<Vec3d> points;
    for (const scene::ShapeInstance& s : p.shapes) add_ends(points, of(s.shape), s.world_from_object);
    for (const scene::Volume& v : p.volumes) add_ends(points, of(v.shape), v.world_from_shape);
    for (const scene::Instance& i : p.instances) add_ends(points, of(i.prototype), i.world_from_object);
    prototypes_.push_back(around(points));
  }
}

Ball Balls::of(const scene::Shape& shape) const {
  return std::visit(Overloaded{[](const shapes::Analytic auto& s) { return s.ball(); },
                               [&](const scene::Mesh& m) { return meshes_[m.mesh.index]; },
                               [&](const scene::Curves& c) { return strand_sets_[c.strands.index]; }},
                    shape);
}

template <class T>
std::vector<Marks> marks(const T& thing, const Balls& balls) {
  return all_marks(thing, balls);
}

template <class T>
void Range<T>::add(const T& thing, const Balls& balls) {
  const std::vector<scene::MovingNumber> numbers = scene::plain_numbers(thing);
  const std::vector<Transform> transforms = scene::transforms_of(thing);
  const std::vector<Marks> own = marks(thing, balls);
  CHECK_EQ(own.size(), transforms.size());
  if (numbers_.empty()) {
    numbers_.assign(numbers.size(), {infinity, -infinity});
    seen_.fill({infinity, -infinity});
  }
  // The balls around a thing reach as far to one side as to the other.
  if (const auto surface = surface_marks(thing, balls))
    for (std::size_t i = 1; i < surface->size(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        widen(seen_[axis], (*surface)[i][axis]);
        widen(seen_[axis], 2 * (*surface)[0][axis] - (*surface)[i][axis]);
      }
  if (boxes_.empty()) {
    std::array<Intervald, 3> nowhere;
    nowhere.fill({infinity, -infinity});
    boxes_.assign(own.size(), nowhere);
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) widen(numbers_[i], numbers[i].value);
  for (std::size_t i = 0; i < own.size(); ++i)
    for (const Vec3d& p : placed(own[i], transforms[i]))
      for (std::size_t axis = 0; axis < 3; ++axis) widen(boxes_[i][axis], p[axis]);
}

template <class T>
double Range<T>::deviation(const T& truth, const T& guess, const Balls& balls) const {
  double worst = own_error(truth, guess, balls.eye());
  const auto judge = [&](double off, double enough) {
    if (off > 0) worst = std::max(worst, off / enough);  // none is enough: infinitely far off
  };
  const std::vector<scene::MovingNumber> numbers = scene::plain_numbers(truth),
                                         guessed = scene::plain_numbers(guess);
  double size = 0;
  for (const Intervald& n : numbers_) size = std::max({size, std::abs(n.lo), std::abs(n.hi)});
  const bool is_seen = seen_[0].lo <= seen_[0].hi;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double way = numbers_[i].hi - numbers_[i].lo;
    const double enough =
        numbers[i].in_metres && is_seen ? enough_of_way(balls.eye(), seen_, way) : share_of_way * way;
    judge(std::abs(numbers[i].value - guessed[i].value), enough + numbers[i].rounding + rounding * size);
  }

  const std::vector<Transform> to = scene::transforms_of(truth), guessed_to = scene::transforms_of(guess);
  const std::vector<Marks> own = marks(truth, balls), guessed_own = marks(guess, balls);
  for (std::size_t i = 0; i < own.size(); ++i) {
    // A medium's marks are those of the shape that it is seen in.
    const Marks now = placed(own[i], to[i]),
                guessed_now = placed(i == 0 ? guessed_own[i] : own[i], guessed_to[i]);
    double way = 0, radius = 0, coordinate = 0;
    for (const Intervald& side : boxes_[i]) {
      way = std::max(way, side.hi - side.lo);
      coordinate = std::max({coordinate, std::abs(side.lo), std::abs(side.hi)});
    }
    for (const Vec3d& p : now) radius = std::max(radius, length(p - now[0]));
    double enough = enough_of_way(balls.eye(), seen_, way);
    if (radius > 0) enough = std::min(enough, share_of_size * 2 * radius);
    for (std::size_t k = 0; k < now.size(); ++k)
      judge(length(now[k] - guessed_now[k]), enough + rounding * (coordinate + largest(to[i].t)));
  }
  return worst;
}

template class Range<scene::ShapeInstance>;
template class Range<scene::Instance>;
template class Range<scene::Volume>;
template class Range<scene::LightInstance>;
template class Range<scene::Camera>;
template std::vector<Marks> marks(const scene::ShapeInstance&, const Balls&);
template std::vector<Marks> marks(const scene::Instance&, const Balls&);
template std::vector<Marks> marks(const scene::Volume&, const Balls&);
template std::vector<Marks> marks(const scene::LightInstance&, const Balls&);
template std::vector<Marks> marks(const scene::Camera&, const Balls&);

}  // namespace tyndall::resolve
