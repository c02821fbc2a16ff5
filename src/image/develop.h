// From radiance to what a display shows. Every picture that is to be looked at goes this way, whoever writes
// it:
//
//   exposure ▸ white balance ▸ bloom ▸ tone curve ▸ sRGB ▸ whole numbers
//
// The first three are linear in the light, and stay so in an .exr; the rest is for displays.
#pragma once

#include "image/image.h"
#include "image/view.h"

namespace tyndall::image {

// The stops that a view gives this picture.
double stops_of(const View& view, const Image& image);

// The whole picture that the image is (a part of), as linear light after exposure, white balance and bloom.
Image expose(const Image& image, const View& view);

// As numbers of sRGB from 0 to 1 (IEC 61966-2-1): grey for each channel of a picture without colours, and
// channels beside colours each by itself. What is negative or NaN is 0.
Image develop(const Image& image, const View& view);

// The same in whole 255ths. Under a film curve a value between two of them becomes either, so that pixels
// side by side have it in the mean: slow gradients of fog show no bands. `tonemap: none` gives the nearest
// number.
Image develop_in_8_bits(const Image& image, const View& view);

}  // namespace tyndall::image
