// Places where paths will sample lights, found before rendering begins: of paths from the camera, in media
// and on surfaces.
#pragma once

#include <vector>

#include "compile/compiled_scene.h"

namespace tyndall::render {

struct LightPlace {
  Vec3d position;
  // On a surface: its unit normal on the side of the path, and where rays to the other side start. 0 in
  // media.
  Vec3d normal{}, behind{};
  bool transmits = false;
  double time = 0;

  bool on_surface() const { return !(normal == Vec3d{}); }
};

// They hang on the scene alone: whatever part of the picture is rendered, and by whom.
std::vector<LightPlace> light_places(const compile::CompiledScene& world, int threads);

}  // namespace tyndall::render
