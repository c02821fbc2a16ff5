// Voxels: bricks made of values, and ranges over boxes of them.
#include "base/voxels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "base/check.h"

namespace tyndall {

namespace {

std::size_t place(const VoxelCoord& at, const VoxelCoord& size) {
  return (static_cast<std::size_t>(at[2]) * static_cast<std::size_t>(size[1]) +
          static_cast<std::size_t>(at[1])) *
             static_cast<std::size_t>(size[0]) +
         static_cast<std::size_t>(at[0]);
}
std::size_t volume(const VoxelCoord& size) { return place({0, 0, size[2]}, size); }

VoxelCoord shifted(const VoxelCoord& at, int bits) { return {at[0] >> bits, at[1] >> bits, at[2] >> bits}; }

// Calls visit(VoxelCoord) for all of [first, end), x fastest.
template <class Visit>
void for_each(const VoxelCoord& first, const VoxelCoord& end, Visit&& visit) {
  for (std::int32_t z = first[2]; z < end[2]; ++z)
    for (std::int32_t y = first[1]; y < end[1]; ++y)
      for (std::int32_t x = first[0]; x < end[0]; ++x) visit(VoxelCoord{x, y, z});
}

VoxelCoord blocks_of(const VoxelCoord& size) {
  VoxelCoord blocks;
  for (std::size_t i = 0; i < 3; ++i) blocks[i] = ((size[i] - 1) >> 6) + 1;
  return blocks;
}

constexpr VoxelRange nothing{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                             0};

}  // namespace

void VoxelRange::add(const VoxelRange& other) {
  lo = std::min(lo, other.lo);
  hi = std::max(hi, other.hi);
  size = std::max({size, other.size, std::fabs(other.lo), std::fabs(other.hi)});
}

std::uint32_t Voxels::brick_at(const VoxelCoord& brick) const {
  const std::uint32_t block = block_at[place(shifted(brick, 3), blocks)];
  return brick_in[block * bricks_a_block +
                  static_cast<std::uint32_t>((brick[2] & 7) << 6 | (brick[1] & 7) << 3 | (brick[0] & 7))];
}

float Voxels::at(const VoxelCoord& voxel) const {
  const std::uint32_t brick = brick_at(shifted(voxel, 3));
  if (brick >= stored) return lowest[brick];
  const VoxelCoord within{voxel[0] & 7, voxel[1] & 7, voxel[2] & 7};
  const std::uint16_t code =
      codes[std::size_t{brick} * codes_a_brick + place(within, {brick_voxels, brick_voxels, brick_voxels})];
  return lowest[brick] + step[brick] * static_cast<float>(code);
}

// By parts whose side is near an eighth of the box's or more, so that they are a few hundred at most.
VoxelRange Voxels::range(VoxelCoord first, VoxelCoord last) const {
  std::int32_t width = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    first[i] = std::clamp(first[i], 0, size[i] - 1);
    last[i] = std::clamp(last[i], first[i], size[i] - 1);
    width = std::max(width, last[i] - first[i] + 1);
  }
  VoxelRange found = nothing;
  const auto over = [&](int bits, auto&& add) {
    const VoxelCoord end = shifted(last, bits);
    for_each(shifted(first, bits), {end[0] + 1, end[1] + 1, end[2] + 1}, add);
  };
  if (width <= 8) {
    over(1, [&](const VoxelCoord& part) {
      const std::uint32_t brick = brick_at(shifted(part, 2));
      if (brick >= stored) return found.add(brick_range(brick));
      const auto corner = static_cast<std::uint32_t>((part[2] & 3) << 4 | (part[1] & 3) << 2 | (part[0] & 3));
      const std::uint32_t both = corner_codes[brick * corners_a_brick + corner];
      const float low = lowest[brick], a_step = step[brick];
      found.add({low + a_step * static_cast<float>(both & 0xffffu),
                 low + a_step * static_cast<float>(both >> 16), std::fabs(low)});
    });
  } else if (width <= 64) {
    over(3, [&](const VoxelCoord& brick) { found.add(brick_range(brick_at(brick))); });
  } else {
    std::size_t level = 0;
    while (level + 1 < levels.size() && width > 64 << (3 * (level + 1))) ++level;
    over(6 + 3 * static_cast<int>(level),
         [&](const VoxelCoord& at) { found.add(levels[level].ranges[place(at, levels[level].size)]); });
  }
  return found;
}

std::uint64_t Voxels::bytes() const {
  std::uint64_t bytes = 4 * (block_at.size() + brick_in.size() + corner_codes.size()) + 2 * codes.size() +
                        12 * lowest.size() + sizeof(VoxelRange) * block_ranges.size();
  for (const Level& level : levels) bytes += sizeof(VoxelRange) * level.ranges.size();
  return bytes;
}

// ------------------------------------------------------------------------------------------------ the
// builder

namespace {

std::size_t place_in_block(const VoxelCoord& brick) {
  return static_cast<std::size_t>((brick[2] & 7) << 6 | (brick[1] & 7) << 3 | (brick[0] & 7));
}

// The lowest and the highest code of each part of a brick: its own 2 cells' 3 voxels along each axis.
std::uint32_t corner_of(const std::uint16_t* codes, const VoxelCoord& part) {
  std::uint32_t low = 0xffff, high = 0;
  for (std::int32_t z = 0; z < 3; ++z)
    for (std::int32_t y = 0; y < 3; ++y)
      for (std::int32_t x = 0; x < 3; ++x) {
        const VoxelCoord voxel{2 * part[0] + x, 2 * part[1] + y, 2 * part[2] + z};
        const std::uint32_t code =
            codes[place(voxel, {Voxels::brick_voxels, Voxels::brick_voxels, Voxels::brick_voxels})];
        low = std::min(low, code);
        high = std::max(high, code);
      }
  return low | high << 16;
}

}  // namespace

VoxelsBuilder::VoxelsBuilder(const VoxelCoord& size, float background) {
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK_GE(size[i], 1);
    CHECK_LE(size[i], Voxels::max_size);
  }
  voxels_.size = size;
  voxels_.blocks = blocks_of(size);
  voxels_.block_at.assign(volume(voxels_.blocks), 0);
  voxels_.lowest = voxels_.highest = {background};
  voxels_.step = {0};
  voxels_.codes.assign(Voxels::codes_a_brick, 0);
  voxels_.corner_codes.assign(Voxels::corners_a_brick, 0);
  voxels_.stored = 1;
  shared_block(background);
}

std::uint64_t VoxelsBuilder::table_bytes(const VoxelCoord& size) {
  std::uint64_t places = 1;  // below 2^42
  for (const std::int32_t n : blocks_of(size)) places *= static_cast<std::uint64_t>(n);
  return places * (sizeof(std::uint32_t) + 2 * sizeof(VoxelRange));
}

std::uint64_t VoxelsBuilder::bytes() const {
  constexpr std::uint64_t a_brick = 2 * Voxels::codes_a_brick + 4 * Voxels::corners_a_brick + 12;
  return table_bytes(voxels_.size) + 4 * voxels_.brick_in.size() + marked_ * a_brick;
}

// The block of bricks of one value, for as many places as want it.
std::uint32_t VoxelsBuilder::shared_block(float value) {
  if (const auto known = block_of_value_.find(value); known != block_of_value_.end()) return known->second;
  const std::uint32_t block = add_block(constant_of(value));
  is_shared_[block] = true;
  return block_of_value_[value] = block;
}

std::uint32_t VoxelsBuilder::add_block(std::uint32_t brick) {
  voxels_.brick_in.insert(voxels_.brick_in.end(), Voxels::bricks_a_block, brick);
  is_shared_.push_back(false);
  return static_cast<std::uint32_t>(is_shared_.size() - 1);
}

std::uint32_t& VoxelsBuilder::entry(const VoxelCoord& brick) {
  std::uint32_t& block = voxels_.block_at[place(shifted(brick, 3), voxels_.blocks)];
  if (is_shared_[block]) block = add_block(voxels_.brick_in[std::size_t{block} * Voxels::bricks_a_block]);
  return voxels_.brick_in[std::size_t{block} * Voxels::bricks_a_block + place_in_block(brick)];
}

std::uint32_t VoxelsBuilder::constant_of(float value) {
  if (value == voxels_.lowest[0]) return 0;
  const auto [known, is_new] =
      constant_of_value_.try_emplace(value, static_cast<std::uint32_t>(constants_.size()));
  if (is_new) constants_.push_back(value);
  return constant | known->second;
}

void VoxelsBuilder::mark(const VoxelCoord& first, const VoxelCoord& last) { add(first, last, std::nullopt); }
void VoxelsBuilder::fill(const VoxelCoord& first, const VoxelCoord& last, float value) {
  add(first, last, value);
}

// Bricks that have these voxels only are of the value, if there is one; others that have any are asked for.
void VoxelsBuilder::add(const VoxelCoord& first, const VoxelCoord& last, std::optional<float> value) {
  Bricks touched, inside;
  VoxelCoord block_end{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int32_t low = std::max(first[i], 0), high = std::min(last[i], voxels_.size[i] - 1);
    if (low > high) return;
    touched.first[i] = std::max(low - 1, 0) >> 3;  // the voxels of a brick's far side are the next one's, too
    touched.end[i] = (high >> 3) + 1;
    inside.first[i] = (low + 7) >> 3;
    inside.end[i] = value ? high >> 3 : 0;
    block_end[i] = ((touched.end[i] - 1) >> 3) + 1;
  }
  for_each(shifted(touched.first, 3), block_end,
           [&](const VoxelCoord& block) { add_to_block(block, touched, inside, value); });
}

void VoxelsBuilder::add_to_block(const VoxelCoord& block, const Bricks& touched, const Bricks& inside,
                                 std::optional<float> value) {
  const auto holds = [&](const VoxelCoord& first, const VoxelCoord& end) {
    bool all = true;
    for (std::size_t i = 0; i < 3; ++i) all &= inside.first[i] <= first[i] && end[i] <= inside.end[i];
    return all;
  };
  VoxelCoord low{}, end{};
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = block[i] * Voxels::block_side;
    end[i] = low[i] + Voxels::block_side;
  }
  if (holds(low, end)) {
    voxels_.block_at[place(block, voxels_.blocks)] = shared_block(*value);
    return;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = std::max(low[i], touched.first[i]);
    end[i] = std::min(end[i], touched.end[i]);
  }
  for_each(low, end, [&](const VoxelCoord& brick) {
    std::uint32_t& e = entry(brick);
    if (holds(brick, {brick[0] + 1, brick[1] + 1, brick[2] + 1})) {
      e = constant_of(*value);
    } else if (e != pending) {
      e = pending;
      ++marked_;
    }
  });
}

VoxelsPointer VoxelsBuilder::finish(std::string name, const Fill& fill) {
  voxels_.name = std::move(name);
  std::vector<float> values(Voxels::values_a_brick);
  for_each({}, voxels_.blocks, [&](const VoxelCoord& block) {
    const std::uint32_t b = voxels_.block_at[place(block, voxels_.blocks)];
    if (is_shared_[b]) return;
    const VoxelCoord first{8 * block[0], 8 * block[1], 8 * block[2]};
    for_each(first, {first[0] + 8, first[1] + 8, first[2] + 8}, [&](const VoxelCoord& brick) {
      std::uint32_t& e = voxels_.brick_in[std::size_t{b} * Voxels::bricks_a_block + place_in_block(brick)];
      if (e != pending) return;
      fill({8 * brick[0], 8 * brick[1], 8 * brick[2]}, values.data());
      e = stored_brick(values);
    });
  });
  // Bricks of one value stand after those with codes.
  for (std::uint32_t& e : voxels_.brick_in)
    if (e & constant) e = voxels_.stored + (e & ~constant);
  for (const float value : constants_) {
    voxels_.lowest.push_back(value);
    voxels_.highest.push_back(value);
    voxels_.step.push_back(0);
  }
  find_ranges();
  find_hash();
  return std::make_shared<const Voxels>(std::move(voxels_));
}

std::uint32_t VoxelsBuilder::stored_brick(const std::vector<float>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  if (*least == *most) return constant_of(*least);
  double low = *least, a_step = (static_cast<double>(*most) - low) / 65535;
  // One of the steps is 0, where values lie on both sides of it.
  if (*least < 0 && *most > 0) {
    a_step = (static_cast<double>(*most) - low) / 65534;
    low = std::floor(low / a_step) * a_step;
  }
  const auto step = static_cast<float>(a_step);
  if (!(step > 0)) return constant_of(*least);
  const auto lowest = *least < 0 && *most > 0 ? -(step * static_cast<float>(std::round(-low / a_step)))
                                              : static_cast<float>(low);
  const std::size_t begin = voxels_.codes.size();
  std::uint16_t highest_code = 0;
  for (const float value : values) {
    const double code =
        std::round((static_cast<double>(value) - static_cast<double>(lowest)) / static_cast<double>(step));
    voxels_.codes.push_back(static_cast<std::uint16_t>(std::clamp(code, 0.0, 65535.0)));
    highest_code = std::max(highest_code, voxels_.codes.back());
  }
  voxels_.codes.push_back(0);
  for_each({}, {4, 4, 4}, [&](const VoxelCoord& part) {
    voxels_.corner_codes.push_back(corner_of(voxels_.codes.data() + begin, part));
  });
  voxels_.lowest.push_back(lowest);
  voxels_.highest.push_back(lowest + step * static_cast<float>(highest_code));
  voxels_.step.push_back(step);
  return voxels_.stored++;
}

void VoxelsBuilder::find_ranges() {
  const std::size_t blocks = voxels_.brick_in.size() / Voxels::bricks_a_block;
  voxels_.block_ranges.assign(blocks, nothing);
  for (std::size_t i = 0; i < voxels_.brick_in.size(); ++i)
    voxels_.block_ranges[i / Voxels::bricks_a_block].add(voxels_.brick_range(voxels_.brick_in[i]));
  Voxels::Level level{voxels_.blocks, {}};
  for (const std::uint32_t block : voxels_.block_at) level.ranges.push_back(voxels_.block_ranges[block]);
  while (level.ranges.size() > 1) {
    Voxels::Level next{blocks_of({8 * level.size[0], 8 * level.size[1], 8 * level.size[2]}), {}};
    next.ranges.assign(volume(next.size), nothing);
    for_each({}, level.size, [&](const VoxelCoord& at) {
      next.ranges[place(shifted(at, 3), next.size)].add(level.ranges[place(at, level.size)]);
    });
    voxels_.levels.push_back(std::exchange(level, std::move(next)));
  }
  voxels_.levels.push_back(std::move(level));
}

void VoxelsBuilder::find_hash() {
  std::uint64_t hash = 0x9e3779b97f4a7c15u;
  const auto mix = [&](std::uint64_t value) {
    hash = (hash ^ value) * 0xd6e8feb86659fd93u;
    hash ^= hash >> 32;
  };
  for (const std::int32_t n : voxels_.size) mix(static_cast<std::uint64_t>(n));
  mix(voxels_.stored);
  for (const std::uint32_t block : voxels_.block_at) mix(block);
  for (const std::uint32_t brick : voxels_.brick_in) mix(brick);
  for (std::size_t i = 0; i < voxels_.lowest.size(); ++i)
    mix(std::uint64_t{std::bit_cast<std::uint32_t>(voxels_.lowest[i])} << 32 |
        std::bit_cast<std::uint32_t>(voxels_.step[i]));
  for (std::size_t i = 0; i + 1 < voxels_.codes.size(); i += 2)  // an even number a brick
    mix(std::uint64_t{voxels_.codes[i]} << 16 | voxels_.codes[i + 1]);
  voxels_.hash = hash;
}

}  // namespace tyndall
