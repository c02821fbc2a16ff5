// Pictures of a report: what was rendered, and where it errs.
#pragma once

#include <string>
#include <vector>

#include "image/image.h"

namespace tyndall::tools {

// A picture as a PNG in a data URI, as wide as fits a page; empty, with a problem, where it cannot be made.
struct Thumbnail {
  std::string uri{}, problem{};
};

image::Image picture_of(std::vector<float> pixels, int width, int height);

Thumbnail shown_picture(const image::Image& picture, const image::View& view);
// Of each pixel the relative error, √(mean of |x - r|² / (r² + ε)), in false colours from 0 to `most`.
Thumbnail error_map(const image::Image& picture, const image::Image& reference, double most);

}  // namespace tyndall::tools
