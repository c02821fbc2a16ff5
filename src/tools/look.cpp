#include "tools/look.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <unordered_map>

#include "compile/compiled_scene.h"
#include "compile/geometry/geometry.h"
#include "image/image.h"
#include "tools/files_in_use.h"
#include "tools/numbers.h"
#include "tools/profile.h"
#include "tools/report.h"
#include "tools/slice.h"
#include "vm/run/machine.h"

namespace tyndall::tools {
namespace {

// Points of the picture's longer side.
constexpr int slice_size = 480;
// Points along each side of a volume's box that a profile is taken at.
constexpr int profile_points = 32;

ExitStatus fail(const std::string& message) {
  print_error(message);
  return ExitStatus::problem;
}

// Calls media without a name by their line, "line:12"; "line:12:40" with the column where another has the
// line already.
void name_by_lines(scene::Scene& scene, const Sources& sources) {
  std::unordered_map<std::string, Span> taken;
  for (scene::Medium& medium : scene.media) {
    if (medium.name != "medium") continue;  // a reserved word, which no definition can have
    const LineColumn at = sources[medium.definition.source].locate(medium.definition.begin);
    medium.name = fmt::format("line:{}", at.line);
    if (taken.try_emplace(medium.name, medium.definition).first->second != medium.definition)
      medium.name += fmt::format(":{}", at.column);
  }
}

// A volume of the scene, or of an object where it is first placed.
struct PlacedVolume {
  const scene::Volume* volume;
  Transform world_from_object;
};

class Volumes {
 public:
  explicit Volumes(const scene::Scene& scene) : scene_(scene), seen_(scene.prototypes.size(), false) {
    add(scene.volumes, scene.instances, {});
  }
  std::vector<PlacedVolume> all;

 private:
  void add(const std::vector<scene::Volume>& volumes, const std::vector<scene::Instance>& instances,
           const Transform& world_from_object) {
    for (const scene::Volume& volume : volumes) all.push_back({&volume, world_from_object});
    for (const scene::Instance& instance : instances) {
      if (seen_[instance.prototype.index]) continue;
      seen_[instance.prototype.index] = true;
      const scene::Prototype& things = scene_.prototypes[instance.prototype.index];
      add(things.volumes, things.instances, world_from_object * instance.world_from_object);
    }
  }

  const scene::Scene& scene_;
  std::vector<bool> seen_;
};

// The box around a volume in its medium's space; nothing for one without bounds.
std::optional<MediumPlace> place_of(const compile::CompiledScene& world, const PlacedVolume& placed) {
  const scene::Volume& volume = *placed.volume;
  const std::optional<compile::Bounds> box = world.geometry->bounds_of(volume.shape);
  const std::optional<Transform> medium_from_object = volume.world_from_medium.inverse();
  if (!box || !medium_from_object) return std::nullopt;
  const Transform medium_from_shape = *medium_from_object * volume.world_from_shape;
  MediumPlace place{
      &world.scene.media[volume.medium.index], {}, placed.world_from_object * volume.world_from_medium};
  for (int corner = 0; corner < 8; ++corner) {
    Vec3d p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = corner >> k & 1 ? box->hi[k] : box->lo[k];
    const Vec3d q = medium_from_shape.point(p);
    for (std::size_t k = 0; k < 3; ++k) {
      place.box.lo[k] = corner == 0 ? q[k] : std::min(place.box.lo[k], q[k]);
      place.box.hi[k] = corner == 0 ? q[k] : std::max(place.box.hi[k], q[k]);
    }
  }
  return place;
}

std::vector<std::string> quoted(const std::vector<std::string>& names) {
  std::vector<std::string> result;
  for (const std::string& name : names) result.push_back(fmt::format("'{}'", name));
  return result;
}

// "there is none" with what there is.
std::string none_named(std::string_view what, const std::string& name,
                       const std::vector<std::string>& names) {
  const std::string meant = did_you_mean(name, {names.begin(), names.end()});
  return fmt::format("no {} '{}' here: there is {}{}{}", what, name,
                     names.empty() ? "none" : fmt::format("{}", fmt::join(quoted(names), ", ")),
                     meant.empty() ? "" : "; ", meant);
}

ExitStatus show_slice(const LookArguments& arguments, LoadedScene& loaded) {
  const std::optional<SlicePlane> plane = parse_slice(arguments.slice);
  const compile::CompiledScene world = compile::compile(std::move(loaded.scene));
  std::optional<MediumPlace> place;
  std::vector<std::string> names;
  for (const PlacedVolume& placed : Volumes(world.scene).all) {
    const scene::Medium& medium = world.scene.media[placed.volume->medium.index];
    if (std::find(names.begin(), names.end(), medium.name) == names.end()) names.push_back(medium.name);
    if ((!arguments.medium.empty() && medium.name != arguments.medium) || place) continue;
    place = place_of(world, placed);
    if (!place) return fail(fmt::format("the volume of medium '{}' has no bounds to slice", medium.name));
  }
  if (arguments.medium.empty() && names.size() > 1)
    return misuse(
        fmt::format("--slice wants one medium to cut: --medium {}", fmt::join(names, " or --medium ")));
  if (!place && arguments.medium.empty()) return fail("there is no medium to slice: no volume in this scene");
  if (!place) return fail(none_named("volume with a medium", arguments.medium, names));
  const scene::Watched& watched = *place->medium->watched;
  const std::string& show = arguments.show.empty() ? "density" : arguments.show;
  if (!watched.program)
    return fail(
        none_named(fmt::format("value of medium '{}' named", place->medium->name), show, watched.names));
  const auto axis = static_cast<std::size_t>(plane->axis);
  if (plane->at < place->box.lo[axis] || plane->at > place->box.hi[axis])
    return fail(fmt::format("--slice {} misses the volume: its {} goes from {:g} to {:g}", arguments.slice,
                            "xyz"[plane->axis], place -> box.lo[axis], place->box.hi[axis]));

  const Slice slice = cut(*place, watched, show, world.scene.time, *plane, slice_size);
  const bool values = arguments.output.ends_with(".exr");
  const std::string problem =
      image::write(arguments.output, values ? values_of(slice, show) : picture_of(slice), {});
  if (!problem.empty()) return fail(problem);
  print_result(
      fmt::format("{}\n  {} from {:g} to {:g}, {} from {:g} to {:g}\n  min {:g}, max {:g}, mean {:g}\n",
                  slice.title, slice.right_axis, slice.left, slice.right, slice.up_axis, slice.bottom,
                  slice.top, slice.lowest, slice.highest, slice.mean));
  if (slice.not_finite > 0)
    print_result(fmt::format("  {} values are no finite numbers{}\n", slice.not_finite,
                             values ? "" : " (drawn in magenta)"));
  return ExitStatus::done;
}

// Runs a medium's programs at a lattice of points in the box, and counts.
std::vector<ProgramLanes> profile_of(const MediumPlace& place, float time) {
  std::array<std::vector<float>, 6> lanes;
  for (int i = 0; i < profile_points * profile_points * profile_points; ++i) {
    const std::array<int, 3> at = {i % profile_points, i / profile_points % profile_points,
                                   i / profile_points / profile_points};
    Vec3d p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = place.box.lo[k] + (place.box.hi[k] - place.box.lo[k]) * (at[k] + 0.5) / profile_points;
    const Vec3d world = place.world_from_medium.point(p);
    for (std::size_t k = 0; k < 3; ++k) {
      lanes[k].push_back(static_cast<float>(p[k]));
      lanes[k + 3].push_back(static_cast<float>(world[k]));
    }
  }
  std::vector<ProgramLanes> result;
  vm::Machine machine;
  for (const vm::Program* program : {&place.medium->full, &place.medium->extinction}) {
    vm::BatchInputs inputs;
    for (const vm::Input input : program->inputs)
      inputs[input] = vm::is_uniform(input) ? &time : lanes[static_cast<std::size_t>(input)].data();
    std::vector<std::vector<float>> values(program->outputs.size(), std::vector<float>(lanes[0].size()));
    std::vector<float*> outputs;
    for (std::vector<float>& v : values) outputs.push_back(v.data());
    machine.run(*program, inputs, lanes[0].size(), outputs);
    const bool full = program == &place.medium->full;
    result.push_back({fmt::format("medium {}{}", place.medium->name, full ? "" : ", extinction alone"),
                      program, machine.lanes_run(*program)});
  }
  return result;
}

ExitStatus show_profile(const LookArguments& arguments, LoadedScene& loaded) {
  const compile::CompiledScene world = compile::compile(std::move(loaded.scene));
  std::vector<ProgramLanes> programs;
  std::vector<std::string> names;
  std::vector<bool> seen(world.scene.media.size(), false);
  for (const PlacedVolume& placed : Volumes(world.scene).all) {
    const scene::MediumId id = placed.volume->medium;
    const scene::Medium& medium = world.scene.media[id.index];
    if (seen[id.index]) continue;
    seen[id.index] = true;
    names.push_back(medium.name);
    if (!arguments.medium.empty() && medium.name != arguments.medium) continue;
    const std::optional<MediumPlace> place = place_of(world, placed);
    if (!place)
      return fail(fmt::format("the volume of medium '{}' has no bounds to take points in", medium.name));
    for (ProgramLanes& p : profile_of(*place, static_cast<float>(world.scene.time)))
      programs.push_back(std::move(p));
  }
  if (programs.empty()) return fail(none_named("volume with a medium", arguments.medium, names));
  print_result(profile_text(programs, loaded.sources));
  return ExitStatus::done;
}

}  // namespace

void add_look_options(CLI::App& command, LookArguments& arguments) {
  command
      .add_option(
          "--medium", arguments.medium,
          "With --slice or --profile: the medium to look at, by its name, or an unnamed one by its line")
      ->option_text("NAME|line:N");
  const RealOption& slice = real_option("--slice");
  command
      .add_option(std::string(slice.name), arguments.slice,
                  "Picture a plane through a medium's volume, in its p")
      ->option_text(std::string(slice.form));
  command
      .add_option("--show", arguments.show,
                  "With --slice: the output or name of the body to picture (default: density)")
      ->option_text("NAME");
  command
      .add_option("-o,--output", arguments.output,
                  "With --slice: the picture to write, in false colours; .exr: the numbers")
      ->option_text("OUT");
  command.add_flag("--profile", arguments.profile,
                   "Print the share of each source line in the shaders' time, over the volumes' boxes");
}

ExitStatus look(const SceneRequest& request, const LookArguments& arguments) {
  FilesInUse files;
  if (!arguments.profile) {
    if (arguments.slice.empty()) return misuse("this wants a plane to look at: --slice z=0");
    if (!parse_slice(arguments.slice))
      return misuse(
          fmt::format("--slice wants {}, not '{}'", real_option("--slice").wanted, arguments.slice));
    if (arguments.output.empty()) return misuse("--slice wants the picture to write: -o slice.png");
    files.read(request.path, "the scene");
    std::string problem = image::check_writable(arguments.output);
    if (problem.empty()) problem = files.write(arguments.output, "-o");
    if (!problem.empty()) return fail(problem);
  } else if (!arguments.slice.empty() || !arguments.show.empty() || !arguments.output.empty()) {
    return misuse("--profile prints text: --slice, --show and -o belong to another call");
  }
  SceneRequest watching = request;
  if (!arguments.profile) watching.watch = arguments.show.empty() ? "density" : arguments.show;
  const std::unique_ptr<LoadedScene> loaded = load(watching);
  print_diagnostics(loaded->diagnostics, loaded->sources);
  if (loaded->diagnostics.has_errors()) return ExitStatus::problem;
  if (const std::string problem = files.read_by_scene(loaded->files_read); !problem.empty())
    return fail(problem);
  name_by_lines(loaded->scene, loaded->sources);
  return arguments.profile ? show_profile(arguments, *loaded) : show_slice(arguments, *loaded);
}

}  // namespace tyndall::tools
