// What must hold of every thing in a scene, whoever made it: ranges, and shapes that are not flat.
//
// The fields' own documentation states the ranges; here they are checked. `resolve` shows each problem at the
// parameter's place; tests call the same functions on scenes made by hand.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace tyndall::scene {

// Light samples of one march or surface: their sum stays exact in floats, and their random numbers apart.
inline constexpr int max_light_samples = 1 << 16;

// One thing wrong: the parameter it is about, what was wanted and found, and the way out (may be empty).
struct Problem {
  std::string_view field;
  std::string message;
  std::string help = {};
};
using Problems = std::vector<Problem>;

// The problems of one thing; empty when it is sound. No memory is taken for a sound one.
Problems validate(const RenderSettings& settings);
Problems validate(const ApproximateScattering& approximation);
Problems validate(const Animation& animation);
Problems validate(const PerspectiveCamera& camera);
Problems validate(const OrthographicCamera& camera);
Problems validate(const SphericalCamera& camera);
Problems validate(const Sphere& sphere);
Problems validate(const Box& box);
Problems validate(const Plane& plane);
Problems validate(const Quad& quad);
Problems validate(const Disk& disk);
Problems validate(const Cylinder& cylinder);
Problems validate(const TriangleMesh& mesh);
Problems validate(const StrandSet& strands);
Problems validate(const optics::PointLight& light);
Problems validate(const optics::SpotLight& light);
Problems validate(const optics::SphereLight& light);
Problems validate(const optics::QuadLight& light);
Problems validate(const optics::DiskLight& light);
Problems validate(const optics::MeshLight& light);
Problems validate(const optics::DistantLight& light);
Problems validate(const optics::EnvironmentLight& light);

}  // namespace tyndall::scene
