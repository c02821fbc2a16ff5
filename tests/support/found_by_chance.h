// Shapes that glow without being sampled as lights.
#pragma once

#include "support/scene_builder.h"

namespace tyndall::support {

// Makes the scene's last material one of this base colour and emission as a value of the point, which is not
// known to be the same everywhere: paths have to hit it.
inline void glow_unsampled(SceneBuilder& b, float base_color, const Rgb& emission) {
  scene::Material& material = b.scene.materials.back();
  vm::Builder builder(false);
  const vm::NodeId zero = builder.emit(vm::Op::mul, {builder.input(vm::Input::p_x), builder.constant(0)}, {});
  std::vector<vm::NodeId> outputs = {builder.constant(base_color)};
  for (const float e : {emission.x, emission.y, emission.z})
    outputs.push_back(builder.emit(vm::Op::add, {zero, builder.constant(e)}, {}));
  material.program = *builder.finish(outputs);
  material.base_color = {0, 0, 0};
  material.emission = scene::RgbOutputs{1, 2, 3};
  material.given.resize(4);
}

}  // namespace tyndall::support
