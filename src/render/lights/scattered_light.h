// The light of a camera sample by how often it was scattered: once, more often, or never.
#pragma once

#include "base/vec.h"
#include "render/film/aov.h"

namespace tyndall::render {

struct ScatteredLight {
  Rgb direct, indirect, seen;

  void add(LightPart part, const Rgb& light) {
    switch (part) {
      case LightPart::direct:
      case LightPart::volume_direct:
        direct += light;
        return;
      case LightPart::indirect:
      case LightPart::volume_indirect:
        indirect += light;
        return;
      case LightPart::seen:
      case LightPart::volume_emission:
        seen += light;
        return;
    }
  }
};

}  // namespace tyndall::render
