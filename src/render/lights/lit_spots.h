// Surfaces near lamps, which light the fog and other surfaces around them as lamps do but are met by chance
// alone: found before rendering by rays from the lamps, gathered into spheres.
//
// What is not found, or only roughly, costs noise and never light: rays towards spots share what they find
// with the paths (lamp_guiding.h).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "compile/compiled_scene.h"

namespace tyndall::render {

// Lit surfaces within a sphere.
struct LitSpot {
  Vec3d center;
  double radius = 0;  // [m]
  double power = 0;   // of lamps' light that they scatter, as a mean over the channels [W]
};

class LitSpots {
 public:
  static constexpr std::size_t most_spots = 64;

  // Follows rays from the brightest lamps, at the middle of the shutter; null when they meet nothing.
  static std::unique_ptr<const LitSpots> of(const compile::CompiledScene& world);
  explicit LitSpots(std::vector<LitSpot> spots) : spots_(std::move(spots)) {}

  std::span<const LitSpot> spots() const { return spots_; }

 private:
  std::vector<LitSpot> spots_;
};

// A point of a surface that a lamp lights; it stands for what is within `radius`.
struct LitPoint {
  Vec3d position;
  double radius = 0, power = 0;
};
// Spheres around all points, at most `most` of them, of about equal power. Reorders the points.
std::vector<LitSpot> gathered(std::span<LitPoint> points, std::size_t most);

}  // namespace tyndall::render
