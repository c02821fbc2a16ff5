// `exposure: auto`: what a picture's own light says of its exposure.
#pragma once

#include "image/image.h"

namespace tyndall::image {

inline constexpr double middle_grey = 0.18, least_bright = 0.5, most_bright = 2;

// The stops that bring the middle of a picture's light to middle grey: the mean of the logarithm of luminance
// over the pixels that are no more than ten stops below its bright parts. These, the luminance that a
// fiftieth of the lit pixels exceeds, end between least_bright and most_bright even so: white paper stays
// light, and a fire in the night keeps its form. So what is dark or black around the subject does not count,
// nor how bright a few pixels are. A picture twice as bright gets one stop less. 0 for one without light.
double metered_stops(const Image& image);

}  // namespace tyndall::image
