// Half-open intervals [lo, hi).
#pragma once

namespace tyndall {

template <class T>
struct Interval {
  T lo{}, hi{};

  constexpr bool operator==(const Interval&) const = default;

  // Counts an interval with a NaN end as empty.
  constexpr bool empty() const { return !(lo < hi); }
  constexpr T length() const { return empty() ? T(0) : hi - lo; }
  constexpr bool contains(T t) const { return lo <= t && t < hi; }
  constexpr Interval clipped_to(const Interval& other) const {
    return {lo > other.lo ? lo : other.lo, hi < other.hi ? hi : other.hi};
  }
};

using Intervald = Interval<double>;

}  // namespace tyndall
