// Lines through a scene's volumes, of which a pilot learns how they are to be marched: as the camera sees
// them, and from where that light is scattered towards lights and at random.
#pragma once

#include <cstdint>
#include <vector>

#include "compile/compiled_scene.h"

namespace tyndall::compile {

// A stay of a ray inside of a volume.
struct PilotLine {
  Ray ray;
  double t0 = 0, t1 = 0;
  std::uint32_t volume = 0;
};

// What the camera sees of each volume: of `rays` in all, evenly over the picture.
struct SeenLines {
  std::vector<std::vector<PilotLine>> of_volume;
  std::size_t rays = 0;
};
SeenLines seen_lines(const CompiledScene& world);

// The stay of a ray from a point in a volume: towards a light at infinity, or at random. `number` names it;
// of no length where there is none.
PilotLine line_from(const CompiledScene& world, const Vec3d& point, double time, std::uint32_t volume,
                    std::uint64_t number);
// The stay of a random ray; of no length where it misses the volume.
PilotLine line_through(const CompiledScene& world, std::uint32_t volume, std::uint64_t number);

// In [0, 1).
double pilot_random(std::uint64_t number, std::uint64_t dimension);

}  // namespace tyndall::compile
