// Values of shaders that are out of range, counted while rays are traced.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "base/bytes.h"
#include "compile/compiled_scene.h"
#include "render/context/statistics.h"

namespace tyndall::render {

// Shaders give no more than this; larger values count as infinite.
inline constexpr float largest_value = scene::largest_coefficient;

// Counts of bad values by (shader, output, kind).
class BadValueCounts {
 public:
  // `which`: the number of what the medium is given (scene::GivenNumber), then of its program's outputs.
  // `branch`: which of the statements that set it.
  void add_medium(std::uint32_t medium, std::size_t which, BadValue::Kind kind, std::uint64_t count,
                  std::size_t branch = 0) {
    counts_[{false, medium, which, branch, kind}] += count;
  }
  void add_material(std::uint32_t material, std::size_t output, BadValue::Kind kind, std::size_t branch = 0) {
    ++counts_[{true, material, output, branch, kind}];
  }
  void add_all(const BadValueCounts& other) {
    for (const auto& [key, count] : other.counts_) counts_[key] += count;
  }
  std::vector<BadValue> list(const compile::CompiledScene& world) const;
  // As bytes, and back: false when they are not of this scene.
  void save(ByteWriter& out) const;
  bool restore(ByteReader& in, const compile::CompiledScene& world);

 private:
  struct Key {
    bool of_material;
    std::uint32_t shader;
    std::size_t output, branch;
    BadValue::Kind kind;
    auto operator<=>(const Key&) const = default;
  };
  std::map<Key, std::uint64_t> counts_;
};

}  // namespace tyndall::render
