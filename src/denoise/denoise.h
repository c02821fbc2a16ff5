// Denoising of pictures from the renderer's own statistics: no network, nothing learned elsewhere.
#pragma once

#include <string>

#include "denoise/inputs.h"
#include "image/image.h"

namespace tyndall::denoise {

struct Result {
  image::Image picture{};  // R, G, B
  std::string error{};     // fit for the user as the rest of "cannot denoise 'a.exr': "; empty when denoised
};
// The picture of an image with the channels that inputs_of() reads. Each layer is denoised by itself, and
// goes back to what it was as its noise goes to 0: where the halves say that the filter errs by more than the
// noise does, there is less of the filter. Where the halves are equal, the undenoised values come back
// exactly. threads: 0 for all; they do not change the picture.
Result denoise(const image::Image& image, int threads = 0);

}  // namespace tyndall::denoise
