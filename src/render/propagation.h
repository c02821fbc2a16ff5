// How the rays of paths go through media, by the method of the render: between the path loop and marches or
// flights.
#pragma once

#include <memory>
#include <span>

#include "render/path.h"
#include "render/path_state.h"

namespace tyndall::render {

// Notes that the current ray of a path is to be marched or tracked.
void request_propagation(const compile::CompiledScene& world, const PathSettings& settings, PathSlot& path,
                         compile::RayKind kind, Worker& worker);

// All rays that were noted, those of `paths`, through their media.
void propagate(const compile::CompiledScene& world, const PathSettings& settings,
               std::span<const std::unique_ptr<PathSlot>> paths, Worker& worker);

// Where a path is scattered by the medium.
struct Scattering {
  double t = 0;
  std::uint32_t segment = 0;
  double pdf = 0;  // [1/m], times the probability of going on in the volume
  Rgb weight;      // sigma_s T / pdf
};
// For two numbers in [0, 1), which methods that fly do not ask for.
Scattering draw_scattering(const PathSettings& settings, PathSlot& path, float u_channel, float u,
                           double volume_probability);

}  // namespace tyndall::render
