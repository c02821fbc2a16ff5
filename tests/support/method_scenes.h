// Six scenes on which the renderer's methods are held against each other: small pictures, lights with extent.
#pragma once

#include <string>
#include <vector>

#include "support/scene_builder.h"

namespace tyndall::support {

struct MethodScene {
  std::string name;
  scene::Scene scene;
  // What the marching methods may be off by at the scene's step, of the mean, stated beforehand: half the
  // variance of an optical depth of a few segments, of range step times the variation of the density.
  double bias = 0;
};

inline std::vector<MethodScene> method_scenes() {
  const auto begin = [](int bounces) {
    SceneBuilder b;
    b.image(12, 8, 32).step(0.1).bounces(bounces).perspective({0, 0.3, 5}, {0, 0, 0}, 40);
    scene::AreaLight lamp{scene::Sphere{{1.2, 1.3, 0.4}, 0.25}, Rgb(60), {}};
    lamp.visible = false;  // to the camera: its own few pixels would drown what the fog does
    return b.light(lamp);
  };
  const Density lumps = [](const Point& p) {
    return max(cos(p.x * 5.f) * cos(p.y * 4.f) * cos(p.z * 6.f) + 0.3f, 0);
  };
  const scene::Box box{{-1, -1, -1}, {1, 1, 1}};
  std::vector<MethodScene> list;
  {
    SceneBuilder b = begin(3);
    b.volume(scene::Box{{-2, -1, -2}, {2, 2, 2}}, b.constant({Rgb(0.5f), Rgb(0.9f), {}, hg(0.4f)}));
    list.push_back({"clear fog", b.scene, 0});
  }
  {
    SceneBuilder b = begin(0);
    b.volume(box, b.shader({Rgb(4), Rgb(0.9f), {}, hg(0.3f)}, lumps));
    list.push_back({"lumps, scattered once", b.scene, 0.01});
  }
  {
    SceneBuilder b = begin(8);
    b.volume(box, b.shader({Rgb(6), Rgb(0.95f), {}, hg(0.3f)}, lumps)).environment(0.3f);
    list.push_back({"lumps under a sky", b.scene, 0.01});
  }
  {
    SceneBuilder b = begin(3);
    b.volume(box, b.shader({Rgb(5, 2, 0), Rgb(0.9f, 0.7f, 0.5f)}, lumps));
    list.push_back({"colours", b.scene, 0.01});
  }
  {
    SceneBuilder b = begin(3);
    MediumColors fire{Rgb(2), Rgb(0.4f), Rgb(1, 0.5f, 0.1f)};
    b.volume(box, b.shader(fire, lumps))
        .volume(scene::Sphere{{0.4, 0.2, 0}, 1}, b.constant({Rgb(0.7f), Rgb(0.8f), {}, hg(-0.3f)}));
    list.push_back({"fire within mist", b.scene, 0.01});
  }
  {
    SceneBuilder b = begin(4);
    b.volume(scene::Box{{-1.5, -1, -1}, {1.5, 1, 1}}, b.shader({Rgb(3), Rgb(0.9f)}, lumps))
        .surface(scene::Plane{{0, -0.9, 0}, {0, 1, 0}}, Rgb(0.6f))
        .surface(scene::Sphere{{-0.3, 0, 0}, 0.4}, Rgb(0.8f))
        .quad_light({0, 2, 0.5}, {0.5, 0, 0}, {0, 0, 0.5}, Rgb(40));
    list.push_back({"surfaces in smoke", b.scene, 0.01});
  }
  return list;
}

}  // namespace tyndall::support
