#include "resolve/deforming.h"

#include <fmt/format.h>

#include <algorithm>

#include "resolve/resolve_context.h"

namespace tyndall::resolve {

namespace {

using scene::MeshPose;
using scene::StrandPose;

// What of a scene deforms, by its number among what is written.
struct Deforming {
  std::vector<std::size_t> meshes, strands;
};

// Of that, in the same order.
struct Poses {
  std::vector<MeshPose> meshes;
  std::vector<StrandPose> strands;
};

MeshPose pose(const scene::TriangleMesh& mesh) { return {mesh.points, mesh.normals, {}}; }
StrandPose pose(const scene::StrandSet& strands) { return {strands.points, strands.radii}; }

const scene::TriangleMesh& mesh_of(const scene::Scene& scene, const Written& written, std::size_t i) {
  return *scene.meshes[written.meshes[i].mesh.index];
}
const scene::StrandSet& strands_of(const scene::Scene& scene, const Written& written, std::size_t i) {
  return scene.strand_sets[written.strands[i].strands.index];
}

// Whatever differs at one of the moments.
Deforming find_deforming(const Run& run, const std::map<double, SceneThen>& seen) {
  const auto differs = [&](const auto& differs_then) {
    return std::any_of(seen.begin(), seen.end(), [&](const auto& at) { return differs_then(at.second); });
  };
  Deforming out;
  for (std::size_t i = 0; i < run.written.meshes.size(); ++i) {
    const scene::TriangleMesh& first = mesh_of(run.scene, run.written, i);
    if (differs([&](const SceneThen& then) {
          const scene::TriangleMesh& now = mesh_of(then.scene, then.written, i);
          return now.points != first.points || now.normals != first.normals;
        }))
      out.meshes.push_back(i);
  }
  for (std::size_t i = 0; i < run.written.strands.size(); ++i) {
    const scene::StrandSet& first = strands_of(run.scene, run.written, i);
    if (differs([&](const SceneThen& then) {
          const scene::StrandSet& now = strands_of(then.scene, then.written, i);
          return now.points != first.points || now.radii != first.radii;
        }))
      out.strands.push_back(i);
  }
  return out;
}

Poses poses_of(const Deforming& which, const SceneThen& then) {
  Poses out;
  for (const std::size_t i : which.meshes) out.meshes.push_back(pose(mesh_of(then.scene, then.written, i)));
  for (const std::size_t i : which.strands)
    out.strands.push_back(pose(strands_of(then.scene, then.written, i)));
  return out;
}

// All that deforms, at the moments that any of it was asked for: the scene is read once for each.
class PosesAt {
 public:
  PosesAt(Run& run, SceneAt scene_at, Deforming which, const std::map<double, SceneThen>& seen)
      : run_(run), scene_at_(scene_at), which_(std::move(which)) {
    for (const auto& [moment, then] : seen) known_.emplace(moment, poses_of(which_, then));
  }

  // Null after an error.
  const Poses* at(double moment) {
    if (failed_) return nullptr;
    const auto found = known_.find(moment);
    if (found != known_.end()) return &found->second;
    const std::optional<SceneThen> then = scene_at_(run_, moment);
    failed_ = !then || !deforms_only(run_, *then);
    return failed_ ? nullptr : &known_.emplace(moment, poses_of(which_, *then)).first->second;
  }
  bool failed() const { return failed_; }

 private:
  Run& run_;
  SceneAt scene_at_;
  Deforming which_;
  std::map<double, Poses> known_;
  bool failed_ = false;
};

void report_too_uneven(Run& run, Span span, std::string_view what, std::size_t poses, double largest) {
  run.diagnostics.error(
      span,
      fmt::format(
          "the points of {} move too unevenly while the shutter is open: of {} poses the blur is off by "
          "up to {:.2g} times what would be seen",
          what, poses, largest),
      "what turns as a whole is better turned by a `transform`, which is followed for 2000 turns; or close "
      "the "
      "shutter sooner");
}

// What is told of a thing that deforms, and the points of all that do.
struct About {
  Span span;
  std::string_view what;
  std::size_t points = 0;
};

// Gives a thing its poses; false after an error.
template <class Thing, class PoseOf>
bool add_poses(Run& run, Thing& thing, PosesAt& poses, const About& about, PoseOf pose_of) {
  const PoseError error = add_later_poses(
      thing,
      [&](double fraction) {
        const Poses* now = poses.at(fraction);
        return now ? pose_of(*now) : pose(thing);
      },
      about.points);
  if (poses.failed()) return false;
  // A jump is in one of so many parts, and too short to be seen.
  if (error.off_share > 1.5 / static_cast<double>(most_later_poses)) {
    report_too_uneven(run, about.span, about.what, thing.later.size() + 1, error.largest);
    return false;
  }
  return true;
}

}  // namespace

bool deforms_only(Run& run, const SceneThen& then) {
  const auto refuse = [&](Span span, std::string_view noun) {
    run.diagnostics.error(span, fmt::format("the {} of a mesh may not depend on `time`", noun),
                          "its points and normals may, and move while the shutter is open");
    return false;
  };
  const Written &first = run.written, &now = then.written;
  bool alike = now.meshes.size() == first.meshes.size() && now.strands.size() == first.strands.size();
  for (std::size_t i = 0; i < first.meshes.size() && alike; ++i) {
    const scene::TriangleMesh &was = mesh_of(run.scene, first, i), &is = mesh_of(then.scene, now, i);
    if (is.triangles != was.triangles) return refuse(first.meshes[i].triangles, "triangles");
    if (is.uvs != was.uvs && first.meshes[i].uvs.valid()) return refuse(first.meshes[i].uvs, "uvs");
    alike = is.points.size() == was.points.size() && is.normals.size() == was.normals.size();
  }
  for (std::size_t i = 0; i < first.strands.size() && alike; ++i)
    alike = strands_of(then.scene, now, i).begin == strands_of(run.scene, first, i).begin;
  alike &= now.combinations.size() == first.combinations.size();
  for (std::size_t i = 0; i < first.combinations.size() && alike; ++i) {
    if (shapes::same(*first.combinations[i].parts, *now.combinations[i].parts)) continue;
    run.diagnostics.error(first.combinations[i].header,
                          "what is combined may not change while the shutter is open",
                          "let the `transform` of the whole depend on `time`, or close the shutter");
    return false;
  }
  if (!alike) report_other_things(run);
  return alike;
}

void add_deformation(Run& run, SceneAt scene_at, const std::map<double, SceneThen>& seen) {
  const Deforming which = find_deforming(run, seen);
  if (which.meshes.empty() && which.strands.empty()) return;
  std::size_t points = 0;  // of all, which are kept together
  for (const std::size_t i : which.meshes) points += mesh_of(run.scene, run.written, i).points.size();
  for (const std::size_t i : which.strands) points += strands_of(run.scene, run.written, i).points.size();
  PosesAt poses(run, scene_at, which, seen);
  for (std::size_t k = 0; k < which.meshes.size(); ++k) {
    const Written::MeshAt& written = run.written.meshes[which.meshes[k]];
    scene::SharedMesh& shared = run.scene.meshes[written.mesh.index];
    scene::TriangleMesh mesh = *shared;
    const bool good = add_poses(run, mesh, poses, {written.points, "this mesh", points},
                                [k](const Poses& now) { return now.meshes[k]; });
    shared = std::move(mesh);
    if (!good) return;
  }
  for (std::size_t k = 0; k < which.strands.size(); ++k) {
    const Written::StrandsAt& written = run.written.strands[which.strands[k]];
    if (!add_poses(run, run.scene.strand_sets[written.strands.index], poses,
                   {written.points, "these curves", points},
                   [k](const Poses& now) { return now.strands[k]; }))
      return;
  }
}

}  // namespace tyndall::resolve
