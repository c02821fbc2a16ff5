// Parameters that only the scene language has: what statements take besides the fields of the scene's own
// structs.
#pragma once

#include <optional>
#include <vector>

#include "base/fields.h"
#include "base/transform.h"
#include "base/vec.h"
#include "eval/value.h"
#include "scene/scene.h"

namespace tyndall::resolve {

// A medium, material or shape as written: read further by the statement that takes it.
struct Thing {
  eval::Type wanted;
  eval::Value value{};
  Span span{};
  bool given() const { return span.valid(); }
};

struct RenderParameters {
  static constexpr std::string_view keyword = scene::RenderSettings::keyword;
  Pair<int> resolution{scene::RenderSettings{}.width, scene::RenderSettings{}.height};
  int samples = scene::RenderSettings{}.samples;
  scene::Step step;
  int light_samples = scene::RenderSettings{}.light_samples;
  int bounces = scene::RenderSettings{}.bounces;
  std::uint64_t seed = scene::RenderSettings{}.seed;
  scene::MultipleScattering multiple_scattering;
  template <class F>
  static void fields(F&& field) {
    using P = RenderParameters;
    field(&P::resolution, FieldInfo{"resolution", "the picture's (width, height) in pixels, 1 to 16384"});
    field(&P::samples, FieldInfo{"samples", "paths through each pixel, 1 to 1073741824"});
    field(&P::step,
          FieldInfo{"step", "length of a march's segments, > 0 [m], or `auto(tolerance)`", Quantity::length});
    field(&P::light_samples, FieldInfo{"light_samples", "light points for each path segment, 1 to 65536"});
    field(&P::bounces, FieldInfo{"bounces", "scatterings and reflections at most, 0 to 1073741824"});
    field(&P::seed, FieldInfo{"seed", "of the random numbers, a whole number >= 0"});
    field(&P::multiple_scattering,
          FieldInfo{"multiple_scattering", "of light in media: `full`, or `approximate(…)`, which see"});
  }
};

struct AnimationParameters {
  static constexpr std::string_view keyword = scene::Animation::keyword;
  double fps = 0;
  eval::RangeValue frames;
  Angle shutter;
  template <class F>
  static void fields(F&& field) {
    using P = AnimationParameters;
    field(&P::fps, FieldInfo{"fps", "frames a second, > 0", Quantity::plain, required});
    field(&P::frames,
          FieldInfo{"frames", "the first and the last frame: 1..48; whole numbers from -1e9 to 1e9",
                    Quantity::plain, required});
    field(&P::shutter,
          FieldInfo{"shutter", "how long the shutter is open, 0deg to 360deg (a frame)", Quantity::angle});
  }
};

// A mesh as written; becomes a scene::TriangleMesh.
struct MeshParameters {
  static constexpr std::string_view keyword = scene::Mesh::keyword;
  std::vector<Vec3d> points, triangles, normals;
  std::vector<Pair<double>> uvs;
  template <class F>
  static void fields(F&& field) {
    using P = MeshParameters;
    field(&P::points,
          FieldInfo{"points", "a list of its corners: [(0, 0, 0), …] [m]", Quantity::position, required});
    field(&P::triangles,
          FieldInfo{"triangles",
                    "a list of three points each, counted from 0: [(0, 1, 2), …], counter-clockwise seen "
                    "from outside",
                    Quantity::plain, required});
    field(&P::normals,
          FieldInfo{"normals", "a list of smooth normals, one for each point", Quantity::direction});
    field(&P::uvs, FieldInfo{"uvs", "a list of pairs, one for each point"});
  }
};

// The points of strands: a list for each, whatever was written.
struct StrandPoints {
  std::vector<std::vector<Vec3d>> strands;
};
// One radius, or a list.
struct StrandRadii {
  std::vector<double> values;
};

// Curves as written; they become a scene::StrandSet.
struct CurvesParameters {
  static constexpr std::string_view keyword = scene::Curves::keyword;
  StrandPoints points;
  StrandRadii radius;
  template <class F>
  static void fields(F&& field) {
    using P = CurvesParameters;
    field(&P::points,
          FieldInfo{"points",
                    "a list of the points that a strand goes through, from its root: [(0, 0, 0), …]; or "
                    "a list of such lists [m]",
                    Quantity::position, required});
    field(&P::radius,
          FieldInfo{"radius",
                    "of the tube, >= 0 [m]; or a list: [root, tip], or one for each point of a strand",
                    Quantity::length, required});
  }
};

// What a mesh light takes besides its own fields.
struct MeshLightParameters {
  static constexpr std::string_view keyword = optics::MeshLight::keyword;
  Thing in{eval::Type::shape};
  template <class F>
  static void fields(F&& field) {
    field(&MeshLightParameters::in,
          FieldInfo{"in", "the shape that shines, from its outer or front side", Quantity::plain, required});
  }
};

// What every shape takes besides its own fields.
struct ShapePlacement {
  Transform transform;
  Thing material{eval::Type::material};
  bool visible = true;
  double priority = 0;
  template <class F>
  static void fields(F&& field) {
    using P = ShapePlacement;
    field(&P::transform, FieldInfo{"transform", "moves it"});
    field(&P::material, FieldInfo{"material", "its surface; default: grey 0.8"});
    field(&P::visible, FieldInfo{"visible", "whether the camera sees it"});
    field(&P::priority, FieldInfo{"priority", "where bodies of glass overlap the highest one is there"});
  }
};

// What lights, cameras and shape literals take besides their own fields.
struct Placement {
  Transform transform;
  template <class F>
  static void fields(F&& field) {
    field(&Placement::transform, FieldInfo{"transform", "moves it"});
  }
};

struct VolumeParameters {
  static constexpr std::string_view keyword = "volume";
  Thing in{eval::Type::shape}, medium{eval::Type::medium};
  std::optional<scene::Step> step;
  Thing material{eval::Type::material};
  std::optional<double> priority;
  Transform transform;
  bool visible = true;
  template <class F>
  static void fields(F&& field) {
    using P = VolumeParameters;
    field(&P::in, FieldInfo{"in", "the closed shape that it fills", Quantity::plain, required});
    field(&P::medium, FieldInfo{"medium", "what it is filled with", Quantity::plain, required});
    field(&P::step, FieldInfo{"step", "length of a march's segments inside, > 0 [m], or `auto(tolerance)`",
                              Quantity::length});
    field(&P::material, FieldInfo{"material", "of its boundary, which otherwise cannot be seen"});
    field(&P::priority,
          FieldInfo{"priority",
                    "it gives way to bodies of glass of a higher one; default: 0 with a material, "
                    "without one it is there beside them"});
    field(&P::transform, FieldInfo{"transform", "moves it, and the p of its medium"});
    field(&P::visible, FieldInfo{"visible", "whether the camera sees it"});
  }
};

struct GroupParameters {
  static constexpr std::string_view keyword = "group";
  Transform transform;
  Thing material{eval::Type::material};
  bool visible = true;
  template <class F>
  static void fields(F&& field) {
    using P = GroupParameters;
    field(&P::transform, FieldInfo{"transform", "moves all that is in it"});
    field(&P::material, FieldInfo{"material", "of the shapes in it that name none"});
    field(&P::visible, FieldInfo{"visible", "whether the camera sees the shapes and volumes in it"});
  }
};

struct PlaceParameters {
  static constexpr std::string_view keyword = "place";
  Transform transform;
  Thing material{eval::Type::material};
  template <class F>
  static void fields(F&& field) {
    using P = PlaceParameters;
    field(&P::transform, FieldInfo{"transform", "moves the object's copy"});
    field(&P::material, FieldInfo{"material", "of the shapes in it that name none"});
  }
};

}  // namespace tyndall::resolve
