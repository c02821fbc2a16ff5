// What a picture is denoised from, found among the channels of an image by their names: the picture in
// layers, each as the mean of all samples and that of one half of them, and features.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "denoise/planes.h"
#include "image/image.h"

namespace tyndall::denoise {

using Colors = std::array<Plane, 3>;

// A part of the picture's light as two independent halves of the samples see it.
struct Layer {
  Colors first, second;
};

// A quantity of the scene that light may follow, scaled to about [0, 1], and the variance of its mean.
struct Feature {
  Plane value, variance;
};

struct Inputs {
  int width = 0, height = 0;
  std::vector<Layer> layers;  // those that differ between the halves; other light has no noise
  std::vector<Feature> features;
};

struct InputsResult {
  std::optional<Inputs> inputs{};
  std::string error{};  // fit for the user; empty when there are inputs
};
// The renderer's outputs that are of use: what `--aov` calls them.
inline constexpr std::array<std::string_view, 8> outputs{
    "depth",           "normal",          "albedo",        "volume_direct",
    "volume_indirect", "volume_emission", "transmittance", "half"};

// Reads half.R, half.G and half.B, and what there is of volume_direct, volume_indirect, volume_emission,
// albedo, normal, depth and transmittance with their halves. Values that are not finite count as 0.
InputsResult inputs_of(const image::Image& image, int threads = 0);

// The channels R, G, B, or those of the undenoised picture where these are denoised already: noisy.R, ….
std::optional<std::array<std::size_t, 3>> undenoised_channels(const image::Image& image);

}  // namespace tyndall::denoise
