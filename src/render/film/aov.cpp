#include "render/film/aov.h"

#include <algorithm>

namespace tyndall::render {

std::span<const AovInfo> aov_infos() {
  static constexpr AovInfo infos[] = {
      {Aov::depth, "depth", 1,
       "distance from the camera to the surface behind the pixel [m], over the samples that meet one; "
       "infinite "
       "where none does"},
      {Aov::normal, "normal", 3,
       "normal of that surface in the world, turned to the camera; 0 where none is"},
      {Aov::albedo, "albedo", 3,
       "part of the light that the first medium or surface on the camera ray scatters, 0 to 1"},
      {Aov::volume_direct, "volume_direct", 3, "light that was scattered once, in a medium [W/m²/sr]"},
      {Aov::volume_indirect, "volume_indirect", 3,
       "light that was scattered more than once, at last in a medium [W/m²/sr]"},
      {Aov::volume_emission, "volume_emission", 3, "light that media on the camera ray emit [W/m²/sr]"},
      {Aov::transmittance, "transmittance", 3, "part of the light that media let through on the camera ray"},
      {Aov::optical_depth, "optical_depth", 1,
       "optical depth of the media on the camera ray, mean of R, G, B"},
      {Aov::samples, "samples", 1, "samples taken in the pixel"},
      {Aov::variance, "variance", 3, "estimated variance of the pixel's value [(W/m²/sr)²]"},
      {Aov::cost, "cost", 1, "rays and march segments, per sample"},
      {Aov::halves, "half", 3,
       "the picture of one half of the samples, independent of the other; and so `half.depth`, "
       "`half.albedo.R` … "
       "of the other outputs, all but `samples` and `variance`"},
  };
  static_assert(std::size(infos) == aov_count);
  return infos;
}

std::optional<Aov> aov_of_name(std::string_view name) {
  const auto infos = aov_infos();
  const auto found =
      std::find_if(infos.begin(), infos.end(), [name](const AovInfo& info) { return info.name == name; });
  if (found == infos.end()) return std::nullopt;
  return found->aov;
}

Vec3d AovSample::value(Aov aov) const {
  switch (aov) {
    case Aov::depth:
      return Vec3d{depth, 0, 0};
    case Aov::normal:
      return Vec3d(normal);
    case Aov::albedo:
      return Vec3d(albedo);
    case Aov::volume_direct:
      return Vec3d(volume_direct);
    case Aov::volume_indirect:
      return Vec3d(volume_indirect);
    case Aov::volume_emission:
      return Vec3d(volume_emission);
    case Aov::transmittance:
      return Vec3d(transmittance);
    case Aov::optical_depth:
      return Vec3d{optical_depth, 0, 0};
    case Aov::cost:
      return Vec3d{cost, 0, 0};
    case Aov::samples:
    case Aov::variance:
    case Aov::halves:
      break;  // of the film's own sums
  }
  return {};
}

}  // namespace tyndall::render
