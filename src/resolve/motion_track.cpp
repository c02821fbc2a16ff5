#include "resolve/motion_track.h"

#include <algorithm>
#include <cmath>

namespace tyndall::resolve {

namespace {

// Beyond this a way is taken for a jump: what is in between lasts too short to be seen.
constexpr double least_time = 1.0 / 8192;

// Of what is near enough: a parabola has 94 % of its largest error where it is tested.
constexpr double tested_enough = 0.9;

// So near to a straight line is one.
constexpr double straight_enough = 0.01;  // of what is near enough

// The point that went straighter than any other between 0 and 1, by least squares over the moments in
// between: there M c + t is on the straight line from its first to its last.
Vec3d straightest_point(const std::map<double, Transform>& known) {
  const Transform &first = known.begin()->second, &last = known.rbegin()->second;
  Transform normal{{}, {}, {}, {}};
  Vec3d right;
  for (const auto& [moment, m] : known) {
    const auto off = [s = moment](const Vec3d& x, const Vec3d& a, const Vec3d& b) {
      return x - a * (1 - s) - b * s;
    };
    const std::array<Vec3d, 3> d{off(m.x, first.x, last.x), off(m.y, first.y, last.y),
                                 off(m.z, first.z, last.z)};
    const Vec3d t = off(m.t, first.t, last.t);
    const std::array<Vec3d*, 3> columns{&normal.x, &normal.y, &normal.z};
    for (std::size_t i = 0; i < 3; ++i) {
      right[i] -= dot(d[i], t);
      for (std::size_t k = 0; k < 3; ++k) (*columns[k])[i] += dot(d[i], d[k]);
    }
  }
  // Along the axis of a turn any point will do: the one nearest to zero.
  const double little = 1e-12 * (normal.x.x + normal.y.y + normal.z.z);
  Transform solvable = normal;
  for (auto [column, axis] : {std::pair{&solvable.x, 0}, {&solvable.y, 1}, {&solvable.z, 2}})
    (*column)[static_cast<std::size_t>(axis)] += little;
  const std::optional<Transform> inverse = solvable.inverse();
  if (!inverse) return {};
  const Vec3d point = inverse->vector(right);
  return point + inverse->vector(right - normal.vector(point));
}

}  // namespace

std::array<double, 2> tests_between(double a, double b) {
  return {a + 0.2915026221 * (b - a), a + 0.6180339887 * (b - a)};
}

template <class T>
Track<T>::Track(std::uint32_t index, std::map<double, T> known, const Balls& balls)
    : index_(index), known_(std::move(known)) {
  for (const auto& [moment, thing] : known_) range_.add(thing, balls);
  find_pivots(balls);
  open_.push_back({0, 1});
  const auto [a, b] = tests_between(0, 1);
  if (known_.count(a) == 0 || known_.count(b) == 0) {  // it was seen to move elsewhere
    for (const auto& [moment, thing] : known_) keys_.insert(moment);
    open_.clear();
    for (auto k = keys_.begin(); std::next(k) != keys_.end(); ++k) split(*k, *std::next(k));
    return;
  }
  straight_ = error_between(0, 1, true, balls) <= straight_enough;
  decide(balls);
}

template <class T>
void Track<T>::find_pivots(const Balls& balls) {
  const std::vector<Marks> own = marks(first(), balls);
  for (std::size_t i = 0; i < own.size(); ++i) {
    std::map<double, Transform> ways;
    for (const auto& [moment, thing] : known_) ways[moment] = scene::transforms_of(thing)[i];
    const Vec3d point = straightest_point(ways), middle = own[i][0];
    const Transform &a = ways.begin()->second, &b = ways.rbegin()->second;
    const auto off = [&](const Vec3d& p) {
      double most = 0;
      for (const auto& [moment, m] : ways)
        most = std::max(most, length(m.point(p) - a.point(p) * (1 - moment) - b.point(p) * moment));
      return most;
    };
    pivots_.push_back(off(point) < 1e-6 * off(middle) ? point : middle);
  }
}

template <class T>
void Track<T>::look(double moment, const T& thing, const Balls& balls) {
  if (wanted_.count(moment) == 0) return;
  known_.emplace(moment, thing);
  range_.add(thing, balls);
}

template <class T>
scene::Moving<T> Track<T>::way(const std::vector<double>& moments, bool straight) const {
  scene::Moving<T> moving{index_, {}, moments, {}};
  for (const double moment : moments) moving.keys.push_back(known_.at(moment));
  if (!straight) scene::set_turnings(moving, pivots_);
  return moving;
}

template <class T>
double Track<T>::error_between(double a, double b, bool straight, const Balls& balls) const {
  scene::Moving<T> guess = way({a, b}, straight);
  guess.times = {0, 1};
  double most = 0;
  for (const double moment : tests_between(a, b))
    most =
        std::max(most, range_.deviation(known_.at(moment), scene::at(guess, (moment - a) / (b - a)), balls));
  return most;
}

template <class T>
void Track<T>::split(double a, double b) {
  if (b - a < least_time) return void(jumping_ += b - a);
  open_.push_back({a, b});
  for (const double moment : tests_between(a, b)) wanted_.insert(moment);
}

template <class T>
void Track<T>::decide(const Balls& balls) {
  std::vector<Intervald> before;
  before.swap(open_);
  wanted_.clear();
  if (!before.empty()) error_ = 0;
  for (const auto& [a, b] : before) {
    const double error = error_between(a, b, straight_, balls);
    const auto [c, d] = tests_between(a, b);
    if (error <= tested_enough) {
      known_.erase(c);
      known_.erase(d);
      continue;
    }
    error_ = std::max(error_, error);
    keys_.insert({c, d});
    split(a, c);
    split(c, d);
    split(d, b);
  }
}

template <class T>
scene::Moving<T> Track<T>::result() const {
  return way({keys_.begin(), keys_.end()}, straight_);
}

template class Track<scene::ShapeInstance>;
template class Track<scene::Instance>;
template class Track<scene::Volume>;
template class Track<scene::LightInstance>;
template class Track<scene::Camera>;

}  // namespace tyndall::resolve
