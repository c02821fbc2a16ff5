#include "tools/scene_features.h"

#include "render/lights/emission_grid.h"

namespace tyndall::tools {

std::vector<std::pair<std::string_view, bool>> scene_features(const compile::CompiledScene& world) {
  const compile::Features& features = world.features;
  return {
      {"volumes", features.volumes},
      {"surfaces", features.surfaces},
      {"overlapping volumes", features.overlap},
      {"motion while the shutter is open", features.motion},
      {"media that vary in space", features.heterogeneous},
      {"extinction that differs in colour", features.chromatic},
      {"media that emit", features.medium_emission},
      {"media sampled as lights", features.medium_emission && render::EmissionGrids::of(world) != nullptr},
      {"lights without size", features.delta_lights},
      {"lights with size", features.area_lights},
      {"environment", features.environment},
  };
}

}  // namespace tyndall::tools
