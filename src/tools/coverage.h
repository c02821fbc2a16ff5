// Which samples of which pixels the parts of a picture have.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/film/film.h"
#include "tools/render_arguments.h"

namespace tyndall::tools {

// These samples of each of these pixels; a box of three dimensions.
struct SampleBox {
  render::PixelWindow pixels;
  SampleRange samples;
};

// What both have.
std::optional<SampleBox> common(const SampleBox& a, const SampleBox& b);
// The least box that holds all; there is one.
SampleBox hull(const std::vector<SampleBox>& boxes);
// What none of the parts has of the whole, as boxes that do not overlap.
std::vector<SampleBox> missing(const SampleBox& whole, const std::vector<SampleBox>& parts);

// "samples 0..31 of all pixels", "samples 0..31 of the pixels from (0, 0) up to, but not including, (8, 6)".
std::string text_of(const SampleBox& box, const render::PixelWindow& picture);

}  // namespace tyndall::tools
