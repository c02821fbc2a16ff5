#include "compile/lights/compiled_light.h"

namespace tyndall::compile {

void CompiledLight::moves(const scene::Moving<scene::LightInstance>* motion) {
  motion_ = motion;
  if (auto* area = std::get_if<Compiled<scene::AreaLight>>(&light_)) area->begins_to_move();
  if (auto* sky = std::get_if<Compiled<scene::EnvironmentLight>>(&light_); sky && motion)
    sky->begins_to_move(*motion);
}

CompiledLight CompiledLight::at(double time, const LightSetting& in) const {
  CompiledLight now = *this;
  const scene::Light light = scene::at(*motion_, time).light;
  std::visit(
      [&]<class Light>(const Light& moved) {
        auto& own = std::get<Compiled<Light>>(now.light_);
        own = own.moved(moved, in);
      },
      light);
  return now;
}

}  // namespace tyndall::compile
