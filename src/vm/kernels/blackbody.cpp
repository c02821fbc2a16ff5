// Planck's law seen by the CIE 1931 observer.
#include "vm/kernels/blackbody.h"

#include <algorithm>
#include <cmath>

#include "base/observer.h"

namespace tyndall::vm {

namespace {

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
  const Vec3d signed_rgb = rec709_of_xyz(xyz);
  const Vec3d rgb{std::max(0.0, signed_rgb.x), std::max(0.0, signed_rgb.y), std::max(0.0, signed_rgb.z)};
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
