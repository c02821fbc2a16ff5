// Shapes as emitters.
#pragma once

#include <memory>

#include "optics/emitter.h"
#include "scene/scene.h"

namespace tyndall::compile {

// The shape where it stands; null for planes, which have no end.
std::shared_ptr<const optics::Emitter> emitter_of(const scene::Scene& scene, const scene::Shape& shape,
                                                  const Transform& render_from_shape);

}  // namespace tyndall::compile
