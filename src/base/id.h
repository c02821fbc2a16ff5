// Typed indices: a MediumId cannot be passed where a MaterialId is wanted.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace tyndall {

// An index into a vector of the things named by Tag. A default-made id names nothing.
template <class Tag>
struct Id {
  static constexpr std::uint32_t none = 0xffffffffu;

  std::uint32_t index = none;

  constexpr Id() = default;
  constexpr explicit Id(std::size_t i) : index(static_cast<std::uint32_t>(i)) {}
  constexpr bool valid() const { return index != none; }
  constexpr auto operator<=>(const Id&) const = default;
};

}  // namespace tyndall

template <class Tag>
struct std::hash<tyndall::Id<Tag>> {
  std::size_t operator()(tyndall::Id<Tag> id) const noexcept { return id.index; }
};
