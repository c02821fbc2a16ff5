// `light sphere`, `light quad`, … and `light mesh`: surfaces that shine evenly. And shapes whose material
// glows alike everywhere, which shine from both sides.
#pragma once

#include "compile/lights/light_surface.h"

namespace tyndall::compile {

template <>
class Compiled<scene::AreaLight> {
  template <class F>
  auto visit(F&& f) const {
    return std::visit(std::forward<F>(f), surface_);
  }

 public:
  Compiled(const scene::AreaLight& light, const LightSetting& in);
  Compiled(LightSurface surface, const Rgb& radiance) : surface_(std::move(surface)), radiance_(radiance) {}
  Compiled moved(const scene::AreaLight& light, const LightSetting& in) const;
  // Surfaces that are sampled over the area of any shape are only hit, and never sampled, when they move.
  void begins_to_move() { sampled_ = !by_area(); }

  LightKind kind() const { return LightKind::area; }
  std::optional<optics::Pivot> sample_pivot(float u0, float u1) const {
    return visit([&](const auto& s) { return s.sample_pivot(u0, u1); });
  }
  bool pivot_on_surface() const {
    return visit([](const auto& s) { return s.pivot_on_surface; });
  }
  std::optional<optics::LightSample> sample(const Vec3d& x, const optics::Pivot& pivot, float u0,
                                            float u1) const {
    const auto drawn = visit([&](const auto& s) { return s.sample(x, pivot, u0, u1); });
    if (!drawn) return std::nullopt;
    return optics::LightSample{drawn->direction, drawn->distance,
                               radiance_ * static_cast<float>(drawn->weight), drawn->pdf_solid_angle};
  }
  double pdf(const Vec3d& x, const Vec3d& direction, const Vec3d& y, const Vec3d& normal) const {
    return visit([&](const auto& s) { return s.pdf(x, direction, y, normal); });
  }
  Rgb emitted(const Vec3d& direction, const Vec3d& normal) const {
    return dot(direction, normal) < 0 || both_sides() ? radiance_ : Rgb{};
  }
  Rgb radiance_from_infinity(const Vec3d&) const { return {}; }
  optics::ReachedParts reached_parts(const optics::Pivot& pivot, const Vec3d& origin, const Vec3d& direction,
                                     double t_max) const {
    return visit([&](const auto& s) { return s.reached_parts(pivot, origin, direction, t_max); });
  }
  double importance(const optics::RaySegment& segment) const;
  std::optional<optics::LightBounds> bounds() const;
  std::optional<double> shadow_margin() const {
    return visit([](const auto& s) { return s.shadow_margin(); });
  }
  std::optional<Vec3d> toward() const { return std::nullopt; }

  double area() const {
    return visit([](const auto& s) { return s.area(); });
  }

 private:
  bool by_area() const { return std::holds_alternative<AnySurface>(surface_); }
  bool both_sides() const {
    const auto* any = std::get_if<AnySurface>(&surface_);
    return any && any->both_sides();
  }

  LightSurface surface_;
  Rgb radiance_;
  bool sampled_ = true;  // false: never sampled, only hit
};

}  // namespace tyndall::compile
