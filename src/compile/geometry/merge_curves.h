// Curves next to each other become one: a loop that makes hairs one by one costs what one list of them does.
#pragma once

#include <vector>

#include "compile/geometry/curves.h"
#include "scene/scene.h"

namespace tyndall::compile {

// For each of the scene's strand sets the curves that stand for it. Of curves that follow each other in a
// list of shapes, with one transform and material, none moving, deforming or glowing (`glows` as Geometry has
// it), the first has all strands and the others none.
std::vector<CompiledCurves> group_strands(const scene::Scene& scene, std::span<const std::uint32_t> glows);

}  // namespace tyndall::compile
