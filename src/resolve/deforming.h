// Meshes and curves that the text gives point by point, and that change while the shutter is open.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "base/source.h"
#include "import/deformation.h"
#include "scene/scene.h"

namespace tyndall::resolve {

struct Run;

// Those of a run, in the order in which it met them.
struct Written {
  struct MeshAt {
    scene::MeshId mesh;
    Span points, triangles, uvs;  // of one that is made from parameters no place of uvs: they stay
  };
  struct StrandsAt {
    scene::StrandSetId strands;
    Span points;
  };
  struct CombinationAt {
    std::shared_ptr<const shapes::CombinedParts> parts;
    Span header;
  };
  std::vector<CombinationAt> combinations;
  std::vector<MeshAt> meshes;
  std::vector<StrandsAt> strands;
};

// A scene at a moment while the shutter is open.
struct SceneThen {
  scene::Scene scene;
  Written written;
};

// The same scene at a moment, as a fraction of the time that the shutter is open; nothing after reporting an
// error that it has then.
using SceneAt = std::optional<SceneThen> (*)(Run& first, double fraction);

// Whether the scene has the same meshes and curves then, with as many points and, of what does not move, the
// same: otherwise false, and an error where one of them has other triangles or uvs.
bool deforms_only(Run& run, const SceneThen& then);

// Gives what the text writes point by point the later poses that its blur needs. `seen`: the scene at 1 and
// at first_tests (import/deformation.h). An error where the poses that there may be are too few.
void add_deformation(Run& run, SceneAt scene_at, const std::map<double, SceneThen>& seen);

}  // namespace tyndall::resolve
