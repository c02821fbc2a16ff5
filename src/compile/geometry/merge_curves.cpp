#include "compile/geometry/merge_curves.h"

#include "compile/compiled_scene.h"

namespace tyndall::compile {

namespace {

using Members = std::vector<std::vector<const scene::StrandSet*>>;

// Gives the strands of each run of curves to the first of the run.
void join_runs(std::span<const scene::ShapeInstance> shapes,
               std::span<const scene::Moving<scene::ShapeInstance>> moving,
               std::span<const std::uint32_t> glows, Members& members) {
  // They are their own members until others join them.
  const auto deforms = [&](const scene::Curves& curves) {
    const auto& own = members[curves.strands.index];
    return !own.empty() && !own.front()->later.empty();
  };
  const scene::ShapeInstance* head = nullptr;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const scene::ShapeInstance& shape = shapes[i];
    const auto* curves = std::get_if<scene::Curves>(&shape.shape);
    const bool moves = !moving.empty() && moving.front().index == i;
    if (moves) moving = moving.subspan(1);
    if (!curves || moves || deforms(*curves) || (!glows.empty() && glows[i] != no_index)) {
      head = nullptr;
      continue;
    }
    const bool joins = head && head->world_from_object == shape.world_from_object &&
                       head->material == shape.material && head->visible == shape.visible;
    if (!joins) {
      head = &shape;
      continue;
    }
    auto& own = members[curves->strands.index];
    auto& all = members[std::get<scene::Curves>(head->shape).strands.index];
    all.insert(all.end(), own.begin(), own.end());
    own.clear();
  }
}

}  // namespace

std::vector<CompiledCurves> group_strands(const scene::Scene& scene, std::span<const std::uint32_t> glows) {
  Members members;
  for (const scene::StrandSet& set : scene.strand_sets) members.push_back({&set});
  for (const scene::Prototype& p : scene.prototypes) join_runs(p.shapes, p.moving_shapes, {}, members);
  join_runs(scene.shapes, scene.motion.shapes, glows, members);
  std::vector<CompiledCurves> curves;
  curves.reserve(members.size());
  for (const auto& sets : members) curves.emplace_back(sets);
  return curves;
}

}  // namespace tyndall::compile
