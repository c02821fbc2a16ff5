// How linear light is shown: what a scene's camera and the command line say of it. develop.h does it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/vec.h"

namespace tyndall::image {

// Light is multiplied by 2^stops; after the picture's own middle was brought to middle grey, when it is
// metered (metering.h).
struct Exposure {
  double stops = 0;
  bool metered = false;
  bool operator==(const Exposure&) const = default;
};

// "1.5"; "auto", "auto(-0.5)".
std::string describe(const Exposure& exposure);
// What describe() writes, and other spellings of such numbers; nothing for anything else.
std::optional<Exposure> read_exposure(std::string_view text);

// The curve from exposed light to the light of a display (tone_curve.h).
enum class Tonemap : std::uint8_t { film, agx, neutral, none };
struct TonemapInfo {
  std::string_view name;
  Tonemap tonemap;
};
inline constexpr std::array<TonemapInfo, 4> tonemaps{
    {{"film", Tonemap::film}, {"agx", Tonemap::agx}, {"neutral", Tonemap::neutral}, {"none", Tonemap::none}}};
std::string_view describe(Tonemap tonemap);
std::optional<Tonemap> read_tonemap(std::string_view text);

struct View {
  Exposure exposure{};
  Tonemap tonemap = Tonemap::film;
  std::optional<Rgb> white{};    // linear colour of the light that is to look white
  double bloom = 0;              // share of the light that is spread around where it fell, in [0, 1]
  int first_x = 0, first_y = 0;  // where the first pixel is in the picture that this one is cut from

  // The numbers themselves, clamped to what a display has.
  static View of_numbers() { return {.tonemap = Tonemap::none}; }
  bool operator==(const View&) const = default;
};

}  // namespace tyndall::image
