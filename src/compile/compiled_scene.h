// Scene to what the integrator asks: ray queries by Embree, light tables, bound programs, and the features
// used.
//
// The world is recentred on the camera in double: everything below is in "render space" = world space -
// origin.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/interval.h"
#include "base/transform.h"
#include "base/vec.h"
#include "compile/lights/compiled_light.h"
#include "optics/albedo_tables.h"
#include "optics/phase.h"
#include "scene/scene.h"

namespace tyndall::compile {

inline constexpr std::uint32_t no_index = 0xffffffffu;

struct Ray {
  Vec3d origin, direction;  // render space; unit direction
  double t_max = 0;
  double time = 0;  // a fraction of the time that the shutter is open; 0 in still scenes
};

// Hits of a ray in their order: by t, at the same t by the number of the surface in the scene (its shapes,
// then those of its instances one after the other, then the surfaces of lights), then by its parts.
struct HitOrder {
  double t = 0;
  std::uint64_t surface = std::numeric_limits<std::uint64_t>::max();
  std::uint32_t part = std::numeric_limits<std::uint32_t>::max();
};

struct SurfaceHit {
  double t = 0;
  Vec3d position;                               // on the surface, from the shape's own equation
  Vec3d normal;                                 // geometric, unit, outward (not turned to the ray)
  Vec3d position_object, normal_object;         // the same in the shape's own space
  Vec3d shading_normal, shading_normal_object;  // unit; smoothed over a mesh that has normals
  Pair<double> uv;
  double time = 0;  // the ray's
  // Images of normals along the axes of object space, for materials that set normals (Features::normals).
  std::array<Vec3d, 3> normal_axes{};
  bool sheet = false;  // of a shape without an inside: glass is a pane
  // How far off the surface rays that leave it must start, on the side of the ray and behind [m].
  double offset_before = 0, offset_behind = 0;
  double outside_ior = 1;     // of what a body of glass stands in here
  std::uint64_t surface = 0;  // HitOrder's
  std::uint32_t part = 0;
  const scene::TriangleMesh* mesh = nullptr;  // that `part` is a triangle of; null: no mesh
  Pair<double> weights;                       // of the triangle's second and third corner
  double priority = 0;                        // of the inside, where bodies of glass overlap
  std::uint32_t material = no_index;          // index of scene.materials, or no_index when a light was hit
  std::uint32_t light = no_index;             // index of lights when it is a light's surface
  std::uint32_t glow = no_index;  // index of lights when the surface's material glows and is sampled
};

// A ray's interval inside of one volume, clipped to the ray.
struct VolumeInterval {
  double t0 = 0, t1 = 0;
  std::uint32_t volume = 0;
};

// Which rays a visibility query is for.
enum class RayKind : std::uint8_t { camera, scattered, shadow };

// What the scene needs (transport §9); `inspect --stage features` prints it.
struct Features {
  bool volumes = false, surfaces = false, overlap = false, heterogeneous = false, chromatic = false,
       chromatic_extinction = false;
  bool medium_emission = false, delta_lights = false, area_lights = false, distant_discs = false,
       environment = false, surface_emission = false;
  // Materials: beyond matte, glass among them, less than opaque, with normals of their own.
  bool layered_surfaces = false, glass = false, see_through = false, normals = false;
  bool nested_glass = false;  // bodies of glass that may overlap or touch something, or cut volumes
  bool motion = false;        // rays have times of their own
  bool proven_steps = false;  // some steps follow from a tolerance that is proven
  // Of a ray more than the nearest surface may count.
  bool walks_surfaces() const { return see_through || nested_glass; }
};

// What the renderer asks of a material besides its program.
struct CompiledMaterial {
  bool matte = true;   // Lambert's law alone
  bool opaque = true;  // no opacity
  bool transmits = false;
  bool reads_mesh = false;  // what only meshes give, vm::is_of_mesh
  double ior = 1.5;
  std::optional<float> bad_ior{};  // set: what the program gave at the scene's time is out of range
  std::size_t bad_ior_branch = 0;  // which statement gave it
};

// What an output of a medium's full program is for.
enum class OutputUse : std::uint8_t { shown, coefficient, parameter };

// A medium as rays go through it: its programs, and what marching asks besides.
struct CompiledMedium : scene::Medium {
  bool uniform = false;                   // one value for the whole ray: closed forms
  bool constant = false;                  // and the same for all rays: no program need run at all
  std::optional<Rgb> constant_sigma_t{};  // set when no program need run for transmittance [1/m]
  // Set when there is one lobe and that is the same everywhere: where the medium is alone, the lobe is all.
  std::optional<optics::Phase> constant_phase{};
  std::vector<OutputUse> uses{};  // per output of the full program
};

// Of a body of glass: higher ones win; of equals the one that stands later in the scene.
struct SolidRank {
  double priority = 0;
  std::int64_t order = -1;  // HitOrder's number of the surface; -1: a volume without a boundary
  auto operator<=>(const SolidRank&) const = default;
};

// A volume that moves, at a moment: a fraction of the time that the shutter is open. What is flat for one
// moment is taken for what it is beside it.
class VolumeMotion {
 public:
  VolumeMotion(const scene::Moving<scene::Volume>& keys, const Vec3d& origin);  // of render space
  const scene::Moving<scene::Volume>& keys() const { return *keys_; }
  const Vec3d& origin() const { return origin_; }
  Transform shape_from_render(double time) const { return at(time).shape_from_render; }
  Transform medium_from_render(double time) const { return at(time).medium_from_render; }
  // Set when it is not the same all the time.
  std::optional<scene::Shape> shape(double time) const;

 private:
  struct Place {
    std::uint64_t motion = 0;
    double time = 0;
    Transform shape_from_render, medium_from_render;
  };
  // Kept for each thread: the rays of a path have one time, and each asks several times.
  const Place& at(double time) const;
  Transform from_render(const scene::MovingTransform& world_from_this, double time) const;

  std::uint64_t number_;  // of all that are ever made, from 1
  const scene::Moving<scene::Volume>* keys_;
  scene::MovingTransform world_from_shape_, world_from_medium_;
  bool shape_changes_;
  Vec3d origin_;
};

struct CompiledVolume {
  std::uint32_t medium = 0;
  Transform shape_from_render, render_from_shape;  // of the bounding shape
  Transform medium_from_render;                    // render space to the medium's p
  scene::Step step;                                // with its metres, unless it is proven
  bool skips = false;      // its grid finds so much empty or uniform that looking into it pays
  double widest_step = 0;  // of a step that is chosen for it [m]
  // > 0: the step changes from cell to cell of its grids, so that no more than this is the product of a
  // segment's length and what bounds of extinction leave open there (steps/graded_step.h).
  double most_spread = 0;
  float majorant = 0;      // of its grids: nothing in it is denser [1/m]
  // Index of grids when the medium varies in space: the first of `time_slabs`, one for each of as many equal
  // parts of the time that the shutter is open. A medium that is the same all that time has one.
  std::uint32_t grid = no_index, time_slabs = 1;
  scene::Shape shape;
  bool visible = true;
  std::optional<SolidRank> rank{};               // set: it gives way to bodies of glass above it
  std::shared_ptr<const VolumeMotion> motion{};  // of those that move

  // What of it depends on the ray's time, a fraction of the time that the shutter is open.
  std::uint32_t grid_at(double time) const {
    return grid + std::min(static_cast<std::uint32_t>(time * time_slabs), time_slabs - 1);
  }
  Transform medium_from_render_at(double time) const {
    return motion ? motion->medium_from_render(time) : medium_from_render;
  }
};

// A light as it is at a ray's time: the scene's own, or moved.
class LightAt {
 public:
  LightAt(const class CompiledScene& world, std::uint32_t index, double time);
  const CompiledLight& operator*() const { return moved_ ? *moved_ : *light_; }
  const CompiledLight* operator->() const { return &**this; }

 private:
  const CompiledLight* light_;
  std::optional<CompiledLight> moved_;
};

// A field of a lattice that a shader asks for at places as far from 0 as `reach` (coarse_fields.h).
struct CoarseField {
  std::string shader, name;
  Span span;
  float reach = 0;
};

// What the steps of marches change of the picture, as a pilot estimates it (steps/choose_steps.h), in shares
// of its light; and of all steps the one that changes most, with the finest one that is worth asking for.
struct StepBias {
  bool known = false;  // some medium is marched with a step that is not proven
  double share = 0;
  double proven = 0;  // the laxest tolerance of those that are proven
  double worst_share = 0, worst = 0, enough = 0;  // share, [m], [m]
};

struct Kept;         // kept.h
class Geometry;      // Embree, behind geometry.cpp
class Solids;        // nested_dielectrics.h
class MajorantGrid;  // majorant_grid.h
class LightTree;     // light_tree.h

class CompiledScene {
 public:
  ~CompiledScene();
  CompiledScene(CompiledScene&&) noexcept;

  scene::Scene scene;  // as given
  Vec3d origin;        // world position of render space's zero
  Features features;
  std::vector<CompiledMedium> media;
  std::vector<CompiledMaterial> materials;
  std::shared_ptr<const optics::AlbedoTables> albedo_tables;  // when there are layered surfaces
  std::vector<CompiledVolume> volumes;
  // The scene's, then shapes whose material glows alike everywhere.
  std::vector<CompiledLight> lights;
  std::vector<std::uint32_t> distant_lights;    // indices of lights
  std::unique_ptr<const LightTree> light_tree;  // when there are many
  std::unique_ptr<Geometry> geometry;
  std::unique_ptr<const Solids> solids;              // when Features::nested_glass or volumes have priorities
  std::vector<std::unique_ptr<MajorantGrid>> grids;  // of volumes whose medium varies; see majorant_dda.h
  std::vector<CoarseField> coarse_fields;
  StepBias step_bias;

  // The nearest surface (shape or visible area light) behind `after` and before ray.t_max, if any.
  std::optional<SurfaceHit> closest_hit(const Ray& ray, RayKind kind, const HitOrder& after = {}) const;
  // True when an opaque shape, or an area light other than `target_light`, blocks the segment (0, ray.t_max).
  bool occluded(const Ray& ray, std::uint32_t target_light = no_index) const;
  // Every volume interval that meets [0, t_max), appended to `out` (cleared first), in order of (t0, volume).
  // Complete for rays that start inside volumes: no state is carried.
  void volume_intervals(const Ray& ray, RayKind kind, std::vector<VolumeInterval>& out) const;

  // Seconds, for shaders.
  float seconds_at(double time) const { return static_cast<float>(scene.time + time * shutter_seconds); }
  double shutter_seconds = 0;

 private:
  friend CompiledScene compile(scene::Scene scene, Kept& kept);
  CompiledScene();
};

// Builds everything that rays need. The scene must be valid (resolve's errors were none).
CompiledScene compile(scene::Scene scene);
// Likewise, of a frame after another one: takes over what that one left (kept.h). The result is the same.
CompiledScene compile(scene::Scene scene, Kept& kept);

}  // namespace tyndall::compile
