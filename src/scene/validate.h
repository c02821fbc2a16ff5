// What must hold of every thing in a scene, whoever made it: ranges, and shapes that are not flat.
//
// The fields' own documentation states the ranges; here they are checked. `resolve` shows each problem at the
// parameter's place; tests call the same functions on scenes made by hand.
#pragma once

#include <concepts>

#include "base/problem.h"
#include "scene/scene.h"

namespace tyndall::scene {

using tyndall::Problem;
using tyndall::Problems;

// The problems of one thing; empty when it is sound. No memory is taken for a sound one.
Problems validate(const RenderSettings& settings);
Problems validate(const ApproximateScattering& approximation);
Problems validate(const TrapezoidCurve& curve);
Problems validate(const Animation& animation);
Problems validate(const PerspectiveCamera& camera);
Problems validate(const OrthographicCamera& camera);
Problems validate(const SphericalCamera& camera);
Problems validate(const TriangleMesh& mesh);
Problems validate(const StrandSet& strands);
// Shapes and lights have theirs.
template <class T>
Problems validate(const T& thing) requires requires {
  { thing.validate() } -> std::same_as<Problems>;
}
{ return thing.validate(); }

}  // namespace tyndall::scene
