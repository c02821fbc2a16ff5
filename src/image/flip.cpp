#include "image/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "base/check.h"
#include "image/colors.h"
#include "image/matrix.h"
#include "image/separable.h"

namespace tyndall::image {
namespace {

// Linear colours, or those of a space of opponents, each component a plane.
using ColorPlanes = std::array<FloatPlane, 3>;

constexpr Matrix xyz_from_rgb{{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                              {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                              {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};
// XYZ in units of those of white, which is (1, 1, 1) in linear RGB: the rows' sums.
constexpr Vec3d share_of_white(const Vec3d& row) { return row / (row.x + row.y + row.z); }
constexpr Matrix relative_xyz_from_rgb{share_of_white(xyz_from_rgb.r), share_of_white(xyz_from_rgb.g),
                                       share_of_white(xyz_from_rgb.b)};
constexpr Matrix rgb_from_relative_xyz = inverse(relative_xyz_from_rgb);

// Lightness and two opponents of three numbers that are equal in greys: of the cube roots of XYZ these are
// L*a*b*, of XYZ itself YyCxCz.
Vec3d opponents_of(const Vec3d& v) { return {116 * v.y - 16, 500 * (v.x - v.y), 200 * (v.y - v.z)}; }

Vec3d ycc_from_rgb(const Vec3d& rgb) { return opponents_of(relative_xyz_from_rgb * rgb); }
Vec3d rgb_from_ycc(const Vec3d& ycc) {
  const double y = (ycc.x + 16) / 116;
  return rgb_from_relative_xyz * Vec3d{y + ycc.y / 500, y, y - ycc.z / 200};
}

double cube_root_of_lab(double t) {
  constexpr double delta = 6.0 / 29;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}
// L*a*b* in which dark colours have less colour: Hunt's effect.
Vec3d hunt_lab_from_rgb(const Vec3d& rgb) {
  const Vec3d xyz = relative_xyz_from_rgb * rgb;
  const Vec3d lab = opponents_of({cube_root_of_lab(xyz.x), cube_root_of_lab(xyz.y), cube_root_of_lab(xyz.z)});
  return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

double hyab_distance(const Vec3d& a, const Vec3d& b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

// The distance of two colours of hunt_lab_from_rgb() as an error from 0 to 1: what is far apart already
// hardly looks worse when it is farther (section 4.1.3 of the paper).
double color_error(const Vec3d& a, const Vec3d& b) {
  constexpr double exponent = 0.7, knee = 0.4, error_at_knee = 0.95;
  static const double largest =
      std::pow(hyab_distance(hunt_lab_from_rgb({0, 1, 0}), hunt_lab_from_rgb({0, 0, 1})), exponent);
  const double distance = std::pow(hyab_distance(a, b), exponent) / largest;
  if (distance < knee) return distance * error_at_knee / knee;
  return error_at_knee + (distance - knee) / (1 - knee) * (1 - error_at_knee);
}

template <class Weight>
Taps make_taps(int radius, const Weight& weight) {
  Taps taps;
  for (int i = -radius; i <= radius; ++i) taps.push_back(static_cast<float>(weight(static_cast<double>(i))));
  return taps;
}
// The sums of what is positive and of what is negative become 1 and -1.
Taps normalised(Taps taps) {
  double positive = 0, negative = 0;
  for (const float tap : taps) (tap > 0 ? positive : negative) += static_cast<double>(tap);
  for (float& tap : taps)
    tap = static_cast<float>(static_cast<double>(tap) / (tap > 0 ? positive : -negative));
  return taps;
}

// Contrast sensitivity: how the eye blurs each component, as one or two Gaussians
// a √(π/b) exp(-π²x²/b) of an angle x in degrees.
struct Sensitivity {
  struct Gaussian {
    double a, b;
    double share = 1;  // of the whole filter
    Taps taps{};
  };
  std::vector<Gaussian> gaussians;

  Sensitivity(std::vector<Gaussian> of, double pixels_per_degree) : gaussians(std::move(of)) {
    constexpr double widest = 0.04;  // b of blue and yellow: all are cut off at three of its deviations
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * sqr(pi))) * pixels_per_degree));
    double whole = 0;
    for (Gaussian& g : gaussians) {
      const auto weight = [&](double i) { return std::exp(-sqr(pi * i / pixels_per_degree) / g.b); };
      double sum = 0;
      for (int i = -radius; i <= radius; ++i) sum += weight(i);
      g.share = g.a * std::sqrt(pi / g.b) * sqr(sum);
      whole += g.share;
      g.taps = normalised(make_taps(radius, weight));
    }
    for (Gaussian& g : gaussians) g.share /= whole;
  }

  FloatPlane blurred(const FloatPlane& in) const {
    FloatPlane sum = filter(in, gaussians[0].taps, gaussians[0].taps);
    if (gaussians.size() == 1) return sum;
    const FloatPlane other = filter(in, gaussians[1].taps, gaussians[1].taps);
    for (std::size_t i = 0; i < sum.values.size(); ++i)
      sum.values[i] = static_cast<float>(gaussians[0].share) * sum.values[i] +
                      static_cast<float>(gaussians[1].share) * other.values[i];
    return sum;
  }
};

// What the eye finds in the lightness: edges and points, by derivatives of a Gaussian.
struct FeatureFilters {
  Taps gaussian, edge, point;

  explicit FeatureFilters(double pixels_per_degree) {
    constexpr double width_of_edge_detector = 0.082;  // from peak to trough [degrees]
    const double deviation = 0.5 * width_of_edge_detector * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    const auto bell = [&](double i) { return std::exp(-sqr(i / deviation) / 2); };
    gaussian = normalised(make_taps(radius, bell));
    edge = normalised(make_taps(radius, [&](double i) { return -i * bell(i); }));
    point = normalised(make_taps(radius, [&](double i) { return (sqr(i / deviation) - 1) * bell(i); }));
  }

  // The length of the derivative along both axes.
  FloatPlane strength(const FloatPlane& lightness, const Taps& derivative) const {
    FloatPlane strength = filter(lightness, derivative, gaussian);
    const FloatPlane down = filter(lightness, gaussian, derivative);
    for (std::size_t i = 0; i < strength.values.size(); ++i)
      strength.values[i] = std::hypot(strength.values[i], down.values[i]);
    return strength;
  }
};

struct Filters {
  Sensitivity lightness, red_green, blue_yellow;
  FeatureFilters features;

  explicit Filters(double pixels_per_degree)
      : lightness({{1, 0.0047}}, pixels_per_degree),
        red_green({{1, 0.0053}}, pixels_per_degree),
        blue_yellow({{34.1, 0.04}, {13.5, 0.025}}, pixels_per_degree),
        features(pixels_per_degree) {}
};

Vec3d color_at(const ColorPlanes& planes, std::size_t i) {
  return {double{planes[0].values[i]}, double{planes[1].values[i]}, double{planes[2].values[i]}};
}
void set_color_at(ColorPlanes& planes, std::size_t i, const Vec3d& color) {
  planes[0].values[i] = static_cast<float>(color.x);
  planes[1].values[i] = static_cast<float>(color.y);
  planes[2].values[i] = static_cast<float>(color.z);
}

// A picture as it is seen.
struct Seen {
  ColorPlanes colors;  // of hunt_lab_from_rgb()
  FloatPlane edges, points;
};

// `rgb` is linear, from 0 to 1.
Seen look_at(ColorPlanes rgb, const Filters& filters) {
  FloatPlane light(rgb[0].width, rgb[0].height);
  for (std::size_t i = 0; i < light.values.size(); ++i) {
    const Vec3d ycc = ycc_from_rgb(color_at(rgb, i));
    set_color_at(rgb, i, ycc);
    light.values[i] = static_cast<float>((ycc.x + 16) / 116);
  }
  Seen seen;
  seen.colors = {filters.lightness.blurred(rgb[0]), filters.red_green.blurred(rgb[1]),
                 filters.blue_yellow.blurred(rgb[2])};
  for (std::size_t i = 0; i < light.values.size(); ++i) {
    const Vec3d blurred = rgb_from_ycc(color_at(seen.colors, i));
    const auto in_gamut = [](double v) { return std::clamp(v, 0.0, 1.0); };
    set_color_at(seen.colors, i,
                 hunt_lab_from_rgb({in_gamut(blurred.x), in_gamut(blurred.y), in_gamut(blurred.z)}));
  }
  seen.edges = filters.features.strength(light, filters.features.edge);
  seen.points = filters.features.strength(light, filters.features.point);
  return seen;
}

double error_at(const Seen& a, const Seen& b, std::size_t i) {
  const double feature = std::max(std::abs(double{a.edges.values[i]} - double{b.edges.values[i]}),
                                  std::abs(double{a.points.values[i]} - double{b.points.values[i]}));
  return std::pow(color_error(color_at(a.colors, i), color_at(b.colors, i)),
                  1 - std::sqrt(feature / std::numbers::sqrt2));
}

// What a display shows of the picture's light: `shown` gives it of each component.
template <class Shown>
ColorPlanes planes_of(const Image& image, const Shown& shown) {
  ColorPlanes planes;
  planes.fill(FloatPlane(image.width, image.height));
  const ColorChannels colors = color_channels(image.channels);
  for (std::size_t i = 0; i < planes[0].values.size(); ++i) {
    const Rgb color = colors.color(image.pixels.data() + i * image.channels.size());
    for (std::size_t k = 0; k < 3; ++k) planes[k].values[i] = shown(color[k]);
  }
  return planes;
}

// Raises the errors to those of this pair, where these are larger.
void raise(Image& errors, const ColorPlanes& x, const ColorPlanes& reference, const Filters& filters) {
  const Seen a = look_at(x, filters), b = look_at(reference, filters);
  for (std::size_t i = 0; i < errors.pixels.size(); ++i)
    errors.pixels[i] = std::max(errors.pixels[i], static_cast<float>(error_at(a, b, i)));
}

Image no_errors(const Image& x, const Image& reference) {
  CHECK_EQ(x.width, reference.width);
  CHECK_EQ(x.height, reference.height);
  Image errors{x.width, x.height, {"Y"}, {}, x.place};
  errors.pixels.assign(errors.index(0, x.height, 0), 0);
  return errors;
}

// The curve of displays (Narkowicz's fit of ACES) that the paper takes: (k0 x² + k1 x) / (k2 x² + k3 x + k4).
constexpr std::array curve{0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14};

float tone_mapped(float light, double scale) {
  constexpr double much = 1e6;  // shown as white
  const double x = std::min(std::max(0.0, double{light}) * scale, much);
  const double shown = (curve[0] * x + curve[1]) * x / ((curve[2] * x + curve[3]) * x + curve[4]);
  return static_cast<float>(std::clamp(shown, 0.0, 1.0));
}

// The light that the curve shows as 0.85: white enough.
double light_at_white() {
  constexpr double white = 0.85, a = curve[0] - white * curve[2], b = curve[1] - white * curve[3],
                   c = -white * curve[4];
  return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

double mean_of_errors(const Image& errors) {
  if (errors.pixels.empty()) return 0;
  return std::accumulate(errors.pixels.begin(), errors.pixels.end(), 0.0) /
         static_cast<double>(errors.pixels.size());
}

}  // namespace

ExposureRange flip_exposures(const Image& reference) {
  const ColorChannels colors = color_channels(reference.channels);
  std::vector<double> lit;
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < reference.pixels.size(); i += reference.channels.size(), ++pixels) {
    const Rgb color = colors.color(reference.pixels.data() + i);
    const double y = 0.2126 * double{color.x} + 0.7152 * double{color.y} + 0.0722 * double{color.z};
    if (std::isfinite(y) && y > 0) lit.push_back(y);
  }
  if (lit.empty()) return {};
  // The paper has no exposure for a median of 0; there the median is that of the pixels that are lit.
  const std::size_t dark = pixels - lit.size();
  const std::size_t middle = pixels / 2 >= dark ? pixels / 2 - dark : lit.size() / 2;
  std::nth_element(lit.begin(), lit.begin() + static_cast<std::ptrdiff_t>(middle), lit.end());
  const double median = lit[middle], brightest = *std::max_element(lit.begin(), lit.end());
  const double white = light_at_white();
  ExposureRange range{std::log2(white / brightest), std::log2(white / median), 1};
  range.count = std::max(2, static_cast<int>(std::ceil(range.last - range.first)));
  return range;
}

Image flip_ldr(const Image& x, const Image& reference, double pixels_per_degree) {
  Image errors = no_errors(x, reference);
  const auto shown = [](float v) { return std::min(std::max(0.0f, v), 1.0f); };
  raise(errors, planes_of(x, shown), planes_of(reference, shown), Filters(pixels_per_degree));
  return errors;
}

Image flip_hdr(const Image& x, const Image& reference, double pixels_per_degree) {
  Image errors = no_errors(x, reference);
  const Filters filters(pixels_per_degree);
  const ExposureRange exposures = flip_exposures(reference);
  for (int i = 0; i < exposures.count; ++i) {
    const double scale = std::exp2(exposures.stops(i));
    const auto shown = [scale](float v) { return tone_mapped(v, scale); };
    raise(errors, planes_of(x, shown), planes_of(reference, shown), filters);
  }
  return errors;
}

double flip_ldr_mean(const Image& x, const Image& reference, double pixels_per_degree) {
  return mean_of_errors(flip_ldr(x, reference, pixels_per_degree));
}
double flip_hdr_mean(const Image& x, const Image& reference, double pixels_per_degree) {
  return mean_of_errors(flip_hdr(x, reference, pixels_per_degree));
}

}  // namespace tyndall::image
