// Two pictures compared by all that `tyndall compare` tells.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/compare.h"
#include "image/image.h"
#include "image/layers.h"
#include "image/z_test.h"

namespace tyndall::tools {

// Two pictures of one size, with the layers that both have, colours first; there is one at least.
struct PicturePair {
  image::Image picture, reference;
  std::vector<image::Layer> layers;
  bool are_light = false;   // rather than what a display shows: both files are .exr
  std::string no_z_test{};  // why a z-test would say nothing, whatever their variances; empty: it would

  // What is compared above all: the colours; of pictures that do not share any, all that they share.
  std::vector<std::string> main_channels() const;
};

// Reads them; nothing after an error, which is told.
std::optional<PicturePair> read_pair(const std::string& picture, const std::string& reference);

struct ComparisonResult {
  image::Comparison main;
  double psnr = 0;  // [dB]; infinite for equal pictures
  std::optional<double> flip;
  std::string flip_kind;
  double outliers = 0, reference_outliers = 0;                    // shares of pixels
  std::optional<image::ZTest> z_test;                             // where there are variances
  std::vector<std::pair<std::string, image::Comparison>> layers;  // the others, by name
};

// "flip" is "hdr-flip" of light and "ldr-flip" of what a display shows.
std::string_view flip_kind(std::string_view name, const PicturePair& pair);
// Its errors, or those of "relative", of the pair's main channels; a picture of one channel.
image::Image errors_of(std::string_view kind, const PicturePair& pair, double pixels_per_degree);

// Compares them, without FLIP, which errors_of() tells.
ComparisonResult compare_pair(const PicturePair& pair);

nlohmann::json to_json(const ComparisonResult& result);
nlohmann::json to_json(const image::ZTest& test);
// A line for each number.
std::string to_text(const ComparisonResult& result, const PicturePair& pair);
// "the means differ: R in the whole picture is 1.2 % above …", or that they agree.
std::string describe(const image::ZTest& test, const image::Image& image);

}  // namespace tyndall::tools
