// Pictures that are denoised before they are written.
#pragma once

#include <string>

#include "image/image.h"
#include "render/film/film.h"
#include "tools/render_arguments.h"

namespace tyndall::tools {

// The outputs that a film records for these arguments: those that are asked for, and what denoising wants.
render::AovSet recorded_outputs(const RenderArguments& arguments);

// The film's picture as it is written to `path`. Denoised: R, G and B are, the undenoised ones are noisy.R,
// noisy.G and noisy.B, and what it was denoised from stays. Only an .exr has more channels than R, G and B.
image::Image picture_to_write(const render::Film& film, bool denoise, const std::string& path, int threads);

// Of samples, in each pixel: two groups in each half.
inline constexpr int least_samples_to_denoise = render::error_groups;

}  // namespace tyndall::tools
