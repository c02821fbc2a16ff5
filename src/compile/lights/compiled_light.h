// A light as rays meet and sample it: the scene's, compiled (light_roles.h says what each can be asked).
#pragma once

#include <variant>

#include "compile/lights/area_light.h"
#include "compile/lights/distant_light.h"
#include "compile/lights/environment_light.h"
#include "compile/lights/light_roles.h"
#include "compile/lights/point_light.h"
#include "compile/lights/spot_light.h"

namespace tyndall::compile {

template <class Variant>
struct CompiledAlternatives;
template <class... Light>
struct CompiledAlternatives<std::variant<Light...>> {
  using Type = std::variant<Compiled<Light>...>;
};

class CompiledLight {
  template <class F>
  auto visit(F&& f) const {
    return std::visit(std::forward<F>(f), light_);
  }

 public:
  CompiledLight(const scene::Light& light, const LightSetting& in)
      : light_(std::visit([&](const auto& l) { return compiled(l, in); }, light)) {}
  explicit CompiledLight(Compiled<scene::AreaLight> light) : light_(std::move(light)) {}

  // As it moves while the shutter is open; null: it stands still.
  const scene::Moving<scene::LightInstance>* motion() const { return motion_; }
  void moves(const scene::Moving<scene::LightInstance>* motion);
  CompiledLight at(double time, const LightSetting& in) const;

  LightKind kind() const {
    return visit([](const auto& l) { return l.kind(); });
  }
  bool is_delta() const { return kind() == LightKind::delta; }
  std::optional<optics::Pivot> sample_pivot(float u0, float u1) const {
    return visit([&](const auto& l) { return l.sample_pivot(u0, u1); });
  }
  bool pivot_on_surface() const {
    return visit([](const auto& l) { return l.pivot_on_surface(); });
  }
  std::optional<optics::LightSample> sample(const Vec3d& x, const optics::Pivot& pivot, float u0,
                                            float u1) const {
    return visit([&](const auto& l) { return l.sample(x, pivot, u0, u1); });
  }
  double pdf(const Vec3d& x, const Vec3d& direction, const Vec3d& y, const Vec3d& normal) const {
    return visit([&](const auto& l) { return l.pdf(x, direction, y, normal); });
  }
  Rgb emitted(const Vec3d& direction, const Vec3d& normal) const {
    return visit([&](const auto& l) { return l.emitted(direction, normal); });
  }
  Rgb radiance_from_infinity(const Vec3d& direction) const {
    return visit([&](const auto& l) { return l.radiance_from_infinity(direction); });
  }
  optics::ReachedParts reached_parts(const optics::Pivot& pivot, const Vec3d& origin, const Vec3d& direction,
                                     double t_max) const {
    return visit([&](const auto& l) { return l.reached_parts(pivot, origin, direction, t_max); });
  }
  double importance(const optics::RaySegment& segment) const {
    return visit([&](const auto& l) { return l.importance(segment); });
  }
  // Nothing for lights at infinity and black ones.
  std::optional<optics::LightBounds> bounds() const {
    const auto b = visit([](const auto& l) { return l.bounds(); });
    return b && b->intensity > 0 ? b : std::nullopt;
  }
  std::optional<double> shadow_margin() const {
    return visit([](const auto& l) { return l.shadow_margin(); });
  }
  std::optional<Vec3d> toward() const {
    return visit([](const auto& l) { return l.toward(); });
  }

 private:
  using Any = CompiledAlternatives<scene::Light>::Type;
  template <class Light>
  static Any compiled(const Light& light, const LightSetting& in) {
    return Compiled<Light>(light, in);
  }

  Any light_;
  const scene::Moving<scene::LightInstance>* motion_ = nullptr;
};

}  // namespace tyndall::compile
