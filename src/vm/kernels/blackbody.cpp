// Planck's law seen by the CIE 1931 observer.
#include "vm/kernels/blackbody.h"

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace tyndall::vm {

namespace {

// A Gaussian with different widths on its two sides.
double lobe(double x, double height, double center, double inverse_left, double inverse_right) {
  const double t = (x - center) * (x < center ? inverse_left : inverse_right);
  return height * std::exp(-0.5 * t * t);
}

// Colour matching functions. Wyman, Sloan, Shirley, "Simple Analytic Approximations to the CIE XYZ Color
// Matching Functions", JCGT 2013, the multi-lobe fits.
Vec3d observer(double nanometres) {
  return {
      lobe(nanometres, 1.056, 599.8, 1 / 37.9, 1 / 31.0) +
          lobe(nanometres, 0.362, 442.0, 1 / 16.0, 1 / 26.7) +
          lobe(nanometres, -0.065, 501.1, 1 / 20.4, 1 / 26.2),
      lobe(nanometres, 0.821, 568.8, 1 / 46.9, 1 / 40.5) + lobe(nanometres, 0.286, 530.9, 1 / 16.3, 1 / 31.1),
      lobe(nanometres, 1.217, 437.0, 1 / 11.8, 1 / 36.0) +
          lobe(nanometres, 0.681, 459.0, 1 / 26.0, 1 / 13.8)};
}

constexpr int shortest_nm = 360, longest_nm = 830;

// The observer over l^5 (Planck's law has it), for every whole nanometre.
using ObserverTable = std::array<Vec3d, longest_nm - shortest_nm + 1>;

ObserverTable weighted_observer() {
  ObserverTable table;
  for (int nm = shortest_nm; nm <= longest_nm; ++nm)
    table[static_cast<std::size_t>(nm - shortest_nm)] = observer(nm) / std::pow(double(nm), 5);
  return table;
}

// Colour for 1/T [1/K], T at least blackbody_coolest; components not below zero, luminance 1.
Vec3d color(double inverse_kelvin, const ObserverTable& weighted) {
  constexpr double second_radiation_constant = 1.438776877e7;  // h c / k [nm K]
  // Planck's law up to a factor that does not depend on the wavelength; the exponent at 600 nm keeps it in
  // range (below 50 at the coolest). As T grows it tends to T / l^4.
  const double reference = second_radiation_constant * inverse_kelvin / 600;
  const double scale = reference * std::exp(reference);
  Vec3d xyz;
  for (int nm = shortest_nm; nm <= longest_nm; ++nm) {
    const double exponent = second_radiation_constant * inverse_kelvin / nm;
    const double planck = exponent < 1e-9 ? nm / 600.0 : scale / std::expm1(exponent);
    xyz += weighted[static_cast<std::size_t>(nm - shortest_nm)] * planck;
  }
  // Rec. 709 primaries, white D65 (IEC 61966-2-1).
  const Vec3d rgb = {std::max(0.0, 3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z),
                     std::max(0.0, -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z),
                     std::max(0.0, 0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z)};
  return rgb / dot(rgb, Vec3d(0.2126, 0.7152, 0.0722));
}

BlackbodyTable make_table() {
  BlackbodyTable table{};
  const ObserverTable weighted = weighted_observer();
  for (std::size_t i = 0; i < blackbody_entries; ++i) {
    const double steps = static_cast<double>(blackbody_entries - 1);
    const Vec3f rgb(color(static_cast<double>(i) / steps / static_cast<double>(blackbody_coolest), weighted));
    table.red[i] = rgb.x;
    table.green[i] = rgb.y;
    table.blue[i] = rgb.z;
  }
  const auto range = [](const std::array<float, blackbody_entries>& entries) {
    const auto [least, most] = std::minmax_element(entries.begin(), entries.end());
    return Interval<float>{*least, *most};
  };
  table.red_range = range(table.red);
  table.green_range = range(table.green);
  table.blue_range = range(table.blue);
  return table;
}

}  // namespace

const BlackbodyTable& blackbody_table() {
  static const BlackbodyTable table = make_table();
  return table;
}

}  // namespace tyndall::vm
