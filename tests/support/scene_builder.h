// Scenes for tests, a few lines each, without the language.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "base/numerics.h"
#include "scene/scene.h"
#include "support/shader_expression.h"

namespace tyndall::support {

inline scene::PhaseLobe hg(float g) {
  scene::PhaseLobe lobe;
  lobe.kind = optics::phase_kind<optics::HenyeyGreenstein>;
  lobe.parameters[0].value = g;
  return lobe;
}
inline scene::PhaseLobe isotropic() { return {}; }

// What a medium is per unit of density. Coefficients [1/m].
struct MediumColors {
  Rgb sigma_t{1, 1, 1};
  Rgb albedo{1, 1, 1};
  Rgb emission{};
  scene::PhaseLobe phase = isotropic();
};

using Density = std::function<Expression(const Point& p)>;

class SceneBuilder {
 public:
  scene::Scene scene;

  SceneBuilder() {
    image(1, 1, 16);
    scene.settings.bounces = 1024;
    scene.settings.step = 0.1;
  }

  SceneBuilder& image(int width, int height, int samples) {
    scene.settings.resolution.width = width;
    scene.settings.resolution.height = height;
    scene.settings.samples = samples;
    return *this;
  }
  SceneBuilder& bounces(int count) {
    scene.settings.bounces = count;
    return *this;
  }
  SceneBuilder& step(double metres) {
    scene.settings.step = metres;
    return *this;
  }
  SceneBuilder& orthographic(const Vec3d& from, const Vec3d& to, double height, const Vec3d& up = {0, 1, 0}) {
    scene.camera = scene::OrthographicCamera{{}, from, to, up, height};
    return *this;
  }
  SceneBuilder& perspective(const Vec3d& from, const Vec3d& to, double fov_degrees,
                            const Vec3d& up = {0, 1, 0}) {
    scene::PerspectiveCamera camera;
    camera.from = from;
    camera.to = to;
    camera.up = up;
    camera.fov.radians = fov_degrees * pi / 180;
    scene.camera = camera;
    return *this;
  }

  // One value everywhere: the renderer's closed forms.
  scene::MediumId constant(const MediumColors& colors) {
    scene::ConstantMedium medium;
    medium.sigma_t = colors.sigma_t;
    medium.sigma_s = colors.sigma_t * colors.albedo;
    medium.emission = colors.emission;
    medium.phase = {colors.phase};
    return add_constant_medium(scene, medium);
  }

  // Bytecode that multiplies the colours by a density; nothing is folded, so the medium is marched.
  scene::MediumId shader(const MediumColors& colors, const Density& density) {
    vm::Builder builder(false);
    const Expression d = density(point_input(builder));
    scene::Medium medium;
    medium.name = "shader";
    std::vector<vm::NodeId> outputs;
    const auto add = [&](const Rgb& color) {
      scene::RgbOutputs which{};
      for (std::size_t c = 0; c < 3; ++c) {
        which[c] = static_cast<std::uint8_t>(outputs.size());
        outputs.push_back((d * color[c]).node);
      }
      return which;
    };
    medium.extinction_sigma_t = add(colors.sigma_t);
    medium.extinction = builder.finish(outputs).value();
    medium.sigma_t = medium.extinction_sigma_t;
    medium.sigma_s = add(colors.sigma_t * colors.albedo);
    if (!is_black(colors.emission)) medium.emission = add(colors.emission);
    medium.full = builder.finish(outputs).value();
    medium.output_spans.resize(outputs.size());
    if (!is_black(colors.sigma_t * colors.albedo)) medium.phase = {colors.phase};
    scene.media.push_back(std::move(medium));
    return scene::MediumId(scene.media.size() - 1);
  }

  SceneBuilder& volume(const scene::Shape& shape, scene::MediumId medium, const Transform& placed = {}) {
    scene::Volume volume;
    volume.shape = shape;
    volume.world_from_shape = volume.world_from_medium = placed;
    volume.medium = medium;
    scene.volumes.push_back(volume);
    return *this;
  }
  SceneBuilder& surface(const scene::Shape& shape, const Rgb& reflectance, const Rgb& emission = {}) {
    scene::ShapeInstance instance;
    instance.shape = shape;
    instance.material = add_diffuse(scene, reflectance, emission);
    scene.shapes.push_back(instance);
    return *this;
  }
  SceneBuilder& surface(const scene::Shape& shape, const scene::ConstantSurface& material,
                        double priority = 0) {
    scene::ShapeInstance instance;
    instance.shape = shape;
    instance.material = add_surface(scene, material);
    instance.priority = priority;
    scene.shapes.push_back(instance);
    return *this;
  }
  // Gives the last volume a boundary.
  SceneBuilder& bounded_by(const scene::ConstantSurface& material, double priority = 0) {
    scene::Volume& volume = scene.volumes.back();
    volume.priority = priority;
    volume.boundary = static_cast<std::uint32_t>(scene.shapes.size());
    surface(volume.shape, material, priority);
    scene.shapes.back().world_from_object = volume.world_from_shape;
    return *this;
  }
  SceneBuilder& light(const scene::Light& light) {
    scene.lights.push_back({light, {}});
    return *this;
  }
  SceneBuilder& point_light(const Vec3d& position, const Rgb& intensity) {
    scene::PointLight one;
    one.position = position;
    one.intensity = intensity;
    return light(one);
  }
  SceneBuilder& sphere_light(const Vec3d& center, double radius, const Rgb& power) {
    return light(scene::AreaLight{scene::Sphere{center, radius}, power, {}});
  }
  SceneBuilder& quad_light(const Vec3d& center, const Vec3d& u, const Vec3d& v, const Rgb& power) {
    return light(scene::AreaLight{scene::Quad{center, u, v}, power, {}});
  }
  SceneBuilder& distant_light(const Vec3d& direction, const Rgb& irradiance, double angle_degrees = 0) {
    scene::DistantLight one;
    one.direction = direction;
    one.irradiance = irradiance;
    one.angle.radians = angle_degrees * pi / 180;
    return light(one);
  }
  SceneBuilder& environment(float radiance) {
    scene::EnvironmentLight one;
    one.radiance.color = Rgb(radiance);
    return light(one);
  }
};

}  // namespace tyndall::support
