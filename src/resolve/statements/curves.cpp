// Curves given inline: hair, grass, threads.
#include <fmt/format.h>

#include "resolve/resolve_context.h"

namespace tyndall::resolve {

std::optional<scene::Shape> read_curves(Run& run, Reader& reader, const ShapeSite&) {
  const auto given = reader.read<CurvesParameters>();
  scene::Curves shape;
  if (!reader.ok()) return shape;
  const std::vector<double>& radii = given.radius.values;
  if (radii.empty()) {
    reader.error(reader.place("radius"), "'radius' holds none", "write `radius: 1mm`, or `radius: [2mm, 0]`");
    return shape;
  }
  scene::StrandSet set;
  set.begin.push_back(0);
  for (std::size_t s = 0; s < given.points.strands.size(); ++s) {
    const std::vector<Vec3d>& strand = given.points.strands[s];
    if (strand.size() < 2) {
      reader.error(reader.place("points"),
                   fmt::format("a strand takes two points at least, strand {} has {}", s, strand.size()));
      return shape;
    }
    if (radii.size() > 2 && radii.size() != strand.size()) {
      reader.error(
          reader.place("radius"),
          fmt::format("'radius' holds {}, and strand {} has {} points", radii.size(), s, strand.size()),
          "give one, two for root and tip, or one for each point");
      return shape;
    }
    for (std::size_t i = 0; i < strand.size(); ++i) {
      set.points.push_back(strand[i]);
      set.radii.push_back(given.radius.at(i, strand.size()));
    }
    set.begin.push_back(static_cast<std::uint32_t>(set.points.size()));
  }
  reader.report(scene::validate(set));
  if (!reader.ok()) return shape;
  shape.strands = scene::StrandSetId(run.scene.strand_sets.size());
  run.scene.strand_sets.push_back(std::move(set));
  run.written.strands.push_back({shape.strands, reader.place("points")});
  return shape;
}

}  // namespace tyndall::resolve
