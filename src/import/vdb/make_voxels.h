// Voxels made of a sparse grid, whatever library or file holds it.
//
// A Source is what a grid has: `int components()`, `Numbers background()`, `Transform from_index()`,
// `bool is_level_set()`, `std::int64_t active_voxels()`, `std::optional<VoxelBox> active_box()`, and
//   for_each_leaf(f)     calls f(VoxelBox) for all boxes whose voxels may be anything
//   for_each_tile(f)     f(VoxelBox, Numbers) for boxes of one value
//   for_each_active(f)   f(Numbers, count) for active values
//   reader()             gives what gives the Numbers at a VoxelCoord, one after another
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "import/vdb/vdb.h"
#include "import/vdb/watched_file.h"

namespace tyndall::import {

using Numbers = std::array<double, 3>;  // one, or three of a vec

// Voxels of the file's own index space, both ends included.
struct VoxelBox {
  VoxelCoord first{}, last{};
};

// Beyond this, values are taken for infinite: differences of any two are finite in float.
inline constexpr double largest_value = 1e30;
// Voxels farther from the origin of the file's index space than this, whose sums might overflow.
inline constexpr std::int32_t farthest = 1 << 30;

inline double length_of(const Numbers& v) { return std::hypot(v[0], v[1], v[2]); }

// Which speeds a grid of velocities has, for its limit and what is told of it.
class Speeds {
 public:
  void add(double speed, std::uint64_t count) {
    if (!(speed > 0) || !(speed <= largest_value)) return;
    const auto value = static_cast<float>(speed);
    counts_[bin_of(value)] += count;
    all_ += count;
    fastest_ = std::max(fastest_, value);
  }
  double fastest() const { return fastest_; }
  // All but a hundredth of them stay below it.
  double usual() const {
    std::uint64_t below = 0;
    std::size_t bin = 0;
    while (bin + 1 < bins && (below += counts_[bin]) * 100 < all_ * 99) ++bin;
    return std::bit_cast<float>(static_cast<std::uint32_t>(bin + 1) << bits_within);
  }

 private:
  // Of equal exponents and first three digits of the mantissa.
  static constexpr int bits_within = 20;
  static constexpr std::size_t bins = std::size_t{1} << (31 - bits_within);
  static std::size_t bin_of(float speed) { return std::bit_cast<std::uint32_t>(speed) >> bits_within; }
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(bins);
  std::uint64_t all_ = 0;
  float fastest_ = 0;
};

// Sets the limit of a grid of velocities, and counts those beyond it.
template <class Source>
void limit_speeds(const Source& source, const GridUse& use, GridResult& result) {
  Speeds speeds;
  source.for_each_active(
      [&](const Numbers& value, std::uint64_t count) { speeds.add(length_of(value), count); });
  result.fastest = speeds.fastest();
  result.speed_limit = use.max_speed > 0 ? use.max_speed : speed_limit_factor * speeds.usual();
  source.for_each_active([&](const Numbers& value, std::uint64_t count) {
    if (const double speed = length_of(value); speed > result.speed_limit && speed <= largest_value)
      result.slowed += static_cast<std::int64_t>(count);
  });
}

// A component of a value as the renderer sees it.
class Component {
 public:
  // `voxel`: the side of one, where the grid is a level set.
  Component(std::size_t index, double speed_limit, std::optional<double> voxel)
      : index_(index),
        speed_limit_(speed_limit),
        level_set_(voxel.has_value()),
        per_voxel_(1 / voxel.value_or(1)) {}

  float operator()(const Numbers& value, bool& finite) const {
    double number = value[index_];
    if (speed_limit_ < std::numeric_limits<double>::infinity())
      if (const double speed = length_of(value); speed > speed_limit_) number *= speed_limit_ / speed;
    finite = std::fabs(number) <= largest_value;
    if (!finite) number = 0;
    // A distance to the surface: the share of the voxel that is inside.
    if (level_set_) number = std::clamp(0.5 - number * per_voxel_, 0.0, 1.0);
    return static_cast<float>(number);
  }

 private:
  std::size_t index_;
  double speed_limit_;
  bool level_set_;
  double per_voxel_;
};

// The box of voxels that are kept: the active ones with a border, from a multiple of 8 on, as leaves are.
struct Kept {
  VoxelCoord first{}, size{};

  VoxelCoord within(const VoxelCoord& at) const {
    return {at[0] - first[0], at[1] - first[1], at[2] - first[2]};
  }
  bool in_border(const VoxelCoord& at) const {
    bool border = false;
    for (std::size_t i = 0; i < 3; ++i) border |= at[i] < Voxels::border || at[i] >= size[i] - Voxels::border;
    return border;
  }
  // Calls f with the part of a box that is not in the border, counted from `first`; clipped before sizes are
  // computed: tiles may lie anywhere.
  template <class F>
  void with_inner(const VoxelBox& box, F&& f) const {
    VoxelCoord low{}, high{};
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::max(box.first[i], first[i] + Voxels::border);
      high[i] = std::min(box.last[i], first[i] + size[i] - 1 - Voxels::border);
      if (low[i] > high[i]) return;
    }
    f(within(low), within(high));
  }
};
inline Kept kept_box(const VoxelBox& active, std::uint64_t most_bytes) {
  Kept kept;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t low = active.first[axis], high = active.last[axis];
    const std::int64_t first = (low - Voxels::border) & ~std::int64_t{7};
    const std::int64_t size = high + Voxels::border + 1 - first;
    if (size > Voxels::max_size)
      throw Refused(fmt::format("its active voxels lie {} apart, and at most {} are possible", high - low,
                                Voxels::max_size));
    if (low < -farthest || high > farthest)
      throw Refused(fmt::format("it has active voxels at {}, and at most {} are possible",
                                low < -farthest ? low : high, farthest));
    kept.first[axis] = static_cast<std::int32_t>(first);
    kept.size[axis] = static_cast<std::int32_t>(size);
  }
  if (VoxelsBuilder::table_bytes(kept.size) > most_bytes) refuse_memory(most_bytes);
  return kept;
}

template <class Source>
VoxelsPointer voxels_of(const Source& source, const Component& value_of, const Kept& kept,
                        const std::string& name, std::uint64_t most_bytes, std::int64_t& not_finite) {
  bool finite = true;
  const float background = value_of(source.background(), finite);
  VoxelsBuilder builder(kept.size, background);
  const auto check_memory = [&] {
    if (builder.too_large() || builder.bytes() > most_bytes) refuse_memory(most_bytes);
  };
  std::uint64_t leaves = 0;
  source.for_each_leaf([&](const VoxelBox& box) {
    kept.with_inner(box, [&](const VoxelCoord& low, const VoxelCoord& high) { builder.mark(low, high); });
    if (++leaves % 4096 == 0) check_memory();
  });
  source.for_each_tile([&](const VoxelBox& box, const Numbers& numbers) {
    const float value = value_of(numbers, finite);
    if (value == background) return;
    kept.with_inner(box,
                    [&](const VoxelCoord& low, const VoxelCoord& high) { builder.fill(low, high, value); });
    check_memory();
  });
  check_memory();
  auto reader = source.reader();
  return builder.finish(name, [&](const VoxelCoord& first, float* values) {
    constexpr std::int32_t side = Voxels::brick_voxels;
    for (std::int32_t z = 0; z < side; ++z)
      for (std::int32_t y = 0; y < side; ++y)
        for (std::int32_t x = 0; x < side; ++x) {
          const VoxelCoord at{first[0] + x, first[1] + y, first[2] + z};
          float value = background;
          if (!kept.in_border(at)) {
            value = value_of(reader({kept.first[0] + at[0], kept.first[1] + at[1], kept.first[2] + at[2]}),
                             finite);
            if (!finite && std::max({x, y, z}) < side - 1) ++not_finite;
          }
          *values++ = value;
        }
  });
}

inline bool is_along_axes(const Transform& t) {
  return t.x.y == 0 && t.x.z == 0 && t.y.x == 0 && t.y.z == 0 && t.z.x == 0 && t.z.y == 0;
}

// Throws Refused.
template <class Source>
GridResult result_of(const Source& source, const std::string& name, std::uint64_t most_bytes,
                     const GridUse& use) {
  GridResult result;
  const Transform from_index = source.from_index();
  result.active_voxels = source.active_voxels();
  result.is_level_set = source.is_level_set();
  result.is_rotated = !is_along_axes(from_index);
  const VoxelBox active = source.active_box().value_or(VoxelBox{});
  const Kept kept = kept_box(active, most_bytes);
  VoxelGrid made;
  const auto vec = [](const VoxelCoord& c) {
    return Vec3d{static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
  };
  made.local_from_voxels = from_index * Transform::translate(vec(kept.first));
  const std::optional<Transform> inverse = made.local_from_voxels.inverse();
  if (!inverse) throw Refused("its transform flattens space, or is not finite");
  made.voxels_from_local = *inverse;
  result.voxel = {length(from_index.x), length(from_index.y), length(from_index.z)};
  made.first_active = vec(kept.within(active.first));
  made.last_active = vec(kept.within(active.last));
  const int components = source.components();
  double limit = std::numeric_limits<double>::infinity();
  if (components == 3 && use.is_velocity) {
    limit_speeds(source, use, result);
    limit = result.speed_limit;
  }
  const std::optional<double> level_set_voxel =
      result.is_level_set ? std::optional(result.voxel[0]) : std::nullopt;
  for (int c = 0; c < components; ++c) {
    const Component component(static_cast<std::size_t>(c), limit, level_set_voxel);
    made.components.push_back(voxels_of(source, component, kept,
                                        components == 1 ? name : name + "." + "xyz"[c], most_bytes,
                                        result.not_finite));
    most_bytes -= std::min(most_bytes, made.components.back()->bytes());
  }
  result.grid = std::make_shared<const VoxelGrid>(std::move(made));
  return result;
}

// What `read` gives, or the error of what it throws.
template <class Read>
GridResult result_or_error(Read&& read) {
  const auto failed = [](std::string why) {
    GridResult result;
    result.error = std::move(why);
    return result;
  };
  try {
    return read();
  } catch (const Refused& refused) {
    return failed(refused.what());
  } catch (const std::bad_alloc&) {
    return failed("there is not enough memory for it, or its sizes are wrong");
  } catch (const std::ios::failure&) {
    return failed("the file ends too early, or places in it are wrong");
  } catch (const std::exception& problem) {
    return failed(fmt::format("OpenVDB says: {}", problem.what()));
  } catch (...) {
    return failed("OpenVDB gives an error of no kind");
  }
}

}  // namespace tyndall::import
