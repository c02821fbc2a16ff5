// What can be written beside the picture (arbitrary output variables): one table, from which the option's
// words, the channels of the file and the manual derive.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "base/vec.h"

namespace tyndall::render {

enum class Aov : std::uint8_t {
  depth,
  normal,
  albedo,
  volume_direct,
  volume_indirect,
  volume_emission,
  transmittance,
  optical_depth,
  samples,
  variance,
  cost,
  halves
};
inline constexpr int aov_count = 12;

struct AovInfo {
  Aov aov;
  std::string_view name;           // on the command line, and of its channels in the file
  int channels;                    // 1, or 3; of halves: those of the picture
  std::string_view documentation;  // with its unit
};
// In the order of the enumeration.
std::span<const AovInfo> aov_infos();
std::optional<Aov> aov_of_name(std::string_view name);

// Which of them are wanted.
class AovSet {
 public:
  void add(Aov aov) { bits_ |= bit(aov); }
  bool has(Aov aov) const { return (bits_ & bit(aov)) != 0; }
  bool empty() const { return bits_ == 0; }
  // As a number, one bit each in the order of the enumeration, and back; nothing where there is no such set.
  std::uint32_t bits() const { return bits_; }
  static std::optional<AovSet> of_bits(std::uint32_t bits) {
    if (bits >= 1u << aov_count) return std::nullopt;
    AovSet set;
    set.bits_ = bits;
    return set;
  }
  // True when any is made of what paths record, not of the film's own sums.
  bool recorded() const {
    return (bits_ & ~(bit(Aov::samples) | bit(Aov::variance) | bit(Aov::halves))) != 0;
  }
  // True when samples must be of groups (film.h).
  bool grouped() const { return has(Aov::variance) || has(Aov::halves); }

 private:
  static std::uint32_t bit(Aov aov) { return 1u << static_cast<unsigned>(aov); }
  std::uint32_t bits_ = 0;
};

// Which part of the picture some light belongs to: how often it was scattered (direct: once), and whether by
// a medium first. seen: what the camera ray meets, but for the emission of media.
enum class LightPart : std::uint8_t {
  seen,
  direct,
  indirect,
  volume_direct,
  volume_indirect,
  volume_emission
};

// Whose light some light is: a camera sample, by the caller's number, and the part of the picture;
// `higher_part` is that of what higher orders of scattering bring.
struct LightTarget {
  std::uint32_t sample = 0;
  LightPart part{}, higher_part = LightPart::volume_indirect;
  // Where it is scattered last, for the trace: after so many scatterings on which branch of the path.
  bool on_surface = false;
  std::uint8_t branch = 0;
  std::uint32_t depth = 0;
};

// What one camera sample recorded.
struct AovSample {
  bool hit_surface = false;
  double depth = 0;  // [m]; 0 unless a surface was hit
  Vec3f normal;      // turned to the camera; zero unless a surface was hit
  Rgb albedo, volume_direct, volume_indirect, volume_emission, transmittance;
  double optical_depth = 0;
  double cost = 0;  // rays and march segments

  void add(LightPart part, const Rgb& light) {
    if (part == LightPart::volume_direct) volume_direct += light;
    if (part == LightPart::volume_indirect) volume_indirect += light;
    if (part == LightPart::volume_emission) volume_emission += light;
  }
  // The value of an output that paths record, in its channels.
  Vec3d value(Aov aov) const;
};

}  // namespace tyndall::render
