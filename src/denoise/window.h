// Windows of pixels in which light follows features: weights by what patches look like, and a regression.
//
// The weights are those of NL-means with the noise's variance (Rousselle, Knaus and Zwicker 2012, "Adaptive
// rendering with non-local means filtering"), the model is linear in the features (Bitterli et al. 2016,
// "Nonlinearly weighted first-order regression for denoising Monte Carlo renderings"), and every window
// speaks for all of its pixels. Windows overlap: one in each square of pixels is enough (after Boughida and
// Boubekeur 2017, "Bayesian collaborative denoising for Monte Carlo rendering").
#pragma once

#include <array>
#include <span>
#include <vector>

#include "denoise/planes.h"

namespace tyndall::denoise {

inline constexpr int window_radius = 7, window_side = 2 * window_radius + 1;
inline constexpr int patch_radius = 1;
inline constexpr int row_lanes = 16;  // a row of a window with a lane of weight 0: whole vectors
inline constexpr int most_features = 8;

// What windows read and write, by the planes of one half of the samples and of the other.
struct WindowPlanes {
  std::array<const Plane*, 3> guide;   // the other half, which patches are compared in
  std::array<const Plane*, 3> color;   // this half
  const Plane* variance = nullptr;     // of a half, sum over the channels
  const Plane* reliability = nullptr;  // of a pixel in the regression, (0, 1]
  std::vector<const Plane*> features, feature_variances;
  std::array<Plane*, 3> sum;  // of weighted predictions
  Plane* weight = nullptr;    // of the weights
};

// Adds the predictions of the window around pixel (x, y).
void add_window(const WindowPlanes& planes, int x, int y);

}  // namespace tyndall::denoise
