#include "image/white_balance.h"

namespace tyndall::image {

namespace {

// IEC 61966-2-1, and the responses of cones to XYZ.
constexpr Matrix xyz_of_rgb{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
constexpr Matrix cones_of_xyz{
    {0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}};
constexpr Matrix cones_of_rgb = cones_of_xyz * xyz_of_rgb, rgb_of_cones = inverse(cones_of_rgb);

}  // namespace

bool WhiteBalance::can_balance(const Rgb& light) {
  const Vec3d response = cones_of_rgb * Vec3d(light);
  return all_finite(response) && min_component(response) > 0;
}

WhiteBalance::WhiteBalance(const Rgb& light) {
  if (!can_balance(light)) return;
  const Vec3d gain = cones_of_rgb * Vec3d(double{luminance(light)}) / (cones_of_rgb * Vec3d(light));
  adaptation_ =
      rgb_of_cones * Matrix{cones_of_rgb.r * gain.x, cones_of_rgb.g * gain.y, cones_of_rgb.b * gain.z};
}

}  // namespace tyndall::image
