// Parameters that only the scene language has: what statements take besides the fields of the scene's own
// structs.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "base/fields.h"
#include "base/numerics.h"
#include "base/problem.h"
#include "base/transform.h"
#include "base/vec.h"
#include "eval/value.h"
#include "generate/sweep.h"
#include "optics/atmosphere.h"
#include "scene/scene.h"

namespace tyndall::resolve {

// A medium, material or shape as written: read further by the statement that takes it.
struct Thing {
  eval::Type wanted;
  eval::Value value{};
  Span span{};
  bool given() const { return span.valid(); }
};

// A moment after the time of the frame: an angle, of which 360deg are a frame, or seconds.
struct ShutterTime {
  double value = 0;
  bool seconds = false;
  Angle angle(double fps) const { return {seconds ? value * fps * 2 * pi : value}; }
};
struct ShutterTimes {
  ShutterTime opens, closes;
};

struct AnimationParameters {
  static constexpr std::string_view keyword = scene::Animation::keyword;
  double fps = 0;
  eval::RangeValue frames;
  ShutterTimes shutter;
  scene::ShutterCurve shutter_curve;
  template <class F>
  static void fields(F&& field) {
    using P = AnimationParameters;
    field(&P::fps, FieldInfo{"fps", "frames a second, > 0", Quantity::plain, required});
    field(&P::frames,
          FieldInfo{"frames", "the first and the last frame: 1..48; whole numbers from -1e9 to 1e9",
                    Quantity::plain, required});
    field(&P::shutter,
          FieldInfo{"shutter",
                    "how long the shutter is open, 0deg to 360deg (a frame), or in seconds; or when it opens "
                    "and closes, after the time of the frame: `(-90deg, 90deg)`",
                    Quantity::angle});
    field(&P::shutter_curve,
          FieldInfo{"shutter_curve", "how it opens and closes: `box`, or `trapezoid(…)`, which see"});
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

// Curves as written; they become a scene::StrandSet.
struct CurvesParameters {
  static constexpr std::string_view keyword = scene::Curves::keyword;
  StrandPoints points;
  generate::Radii radius;
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

// `light sky`: becomes an environment and a distant light.
struct SkyLightParameters {
  static constexpr std::string_view keyword = "light sky";
  Vec3d sun;
  double turbidity = optics::usual_turbidity;
  template <class F>
  static void fields(F&& field) {
    using P = SkyLightParameters;
    field(&P::sun, FieldInfo{"sun", "the direction towards the sun", Quantity::direction, required});
    field(&P::turbidity, FieldInfo{"turbidity",
                                   "how hazy it is, 1 to 10: 2 is a very clear day, 3 a clear one, 6 a hazy "
                                   "one"});
  }

  Problems validate() const {
    Problems problems;
    want_direction(problems, "sun", sun);
    if (!(turbidity >= optics::least_turbidity && turbidity <= optics::most_turbidity))
      problems.push_back(
          {"turbidity", fmt::format("'turbidity' must be from {} to {}, found {}", optics::least_turbidity,
                                    optics::most_turbidity, turbidity)});
    return problems;
  }
};

// The shape of a light that is named after it: all of it must be given.
template <class S>
struct LightShapeParameters : S {
  static constexpr std::string_view keyword = scene::light_keyword<S>;
  template <class F>
  static void fields(F&& field) {
    S::fields([&](auto member, FieldInfo info) {
      info.presence = required;
      field(member, info);
    });
  }
};

// What `light mesh` takes besides the fields of scene::AreaLight.
struct MeshLightParameters {
  static constexpr std::string_view keyword = scene::AreaLight::mesh_keyword;
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
    field(&P::in,
          FieldInfo{"in", "the closed shape that it fills; grids that its medium looks up at p have one",
                    Quantity::plain, required});
    field(&P::medium, FieldInfo{"medium", "what it is filled with", Quantity::plain, required});
    field(&P::step,
          FieldInfo{"step", "length of a march's segments inside, as for `render`", Quantity::length});
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

// Materials of a file that are given others: by their names there.
struct MaterialOverrides {
  struct Entry {
    std::string name;
    Thing material{eval::Type::material};
  };
  std::vector<Entry> entries;
};

// What of a glTF file is meant, and when.
struct GltfChoice {
  std::optional<std::string> node, animation;
  double start = 0, speed = 1;
  bool loop = true;
  template <class T, class F>
  static void fields_of(F&& field) {
    field(&T::node,
          FieldInfo{"node", "the name of the node that is taken, with those below it; default: all"});
    field(&T::animation,
          FieldInfo{"animation", "the name of the animation that plays; default: the first; \"\": none"});
    field(&T::start, FieldInfo{"start", "when the animation begins [s]", Quantity::time});
    field(&T::speed, FieldInfo{"speed", "how fast it plays"});
    field(&T::loop, FieldInfo{"loop", "whether it begins again at its end"});
  }
};

struct GltfParameters : GltfChoice {
  static constexpr std::string_view keyword = "gltf";
  Transform transform;
  Thing material{eval::Type::material};
  MaterialOverrides materials;
  bool visible = true;
  std::optional<double> line_width;
  template <class F>
  static void fields(F&& field) {
    using P = GltfParameters;
    field(&P::transform, FieldInfo{"transform", "moves all that is in it"});
    field(&P::material, FieldInfo{"material", "of all surfaces, instead of those in the file"});
    field(&P::materials,
          FieldInfo{"materials", "a list of [\"name in the file\", material] instead of those"});
    field(&P::visible, FieldInfo{"visible", "whether the camera sees it"});
    field(&P::line_width,
          FieldInfo{"line_width",
                    "how thick its lines are, in the file's units, > 0; default: a 500th of the diagonal of "
                    "the box around all of them",
                    Quantity::length});
    GltfChoice::fields_of<P>(field);
  }
};

// Where a shape is wanted.
struct GltfShapeParameters : GltfChoice {
  static constexpr std::string_view keyword = GltfParameters::keyword;
  template <class F>
  static void fields(F&& field) {
    GltfChoice::fields_of<GltfShapeParameters>(field);
  }
};

struct GltfCameraParameters : GltfChoice, scene::CameraView {
  static constexpr std::string_view keyword = "camera gltf";
  std::optional<std::string> name;
  template <class F>
  static void fields(F&& field) {
    using P = GltfCameraParameters;
    field(&P::name, FieldInfo{"name", "of the camera, or of its node; default: the first"});
    CameraView::fields_of<P>(field);
    field(&P::animation,
          FieldInfo{"animation", "the name of the animation that plays; default: the first; \"\": none"});
    field(&P::start, FieldInfo{"start", "when the animation begins [s]", Quantity::time});
    field(&P::speed, FieldInfo{"speed", "how fast it plays"});
    field(&P::loop, FieldInfo{"loop", "whether it begins again at its end"});
  }
};

// A .ply or .obj file.
struct MeshFileParameters {
  static constexpr std::string_view keyword = scene::Mesh::keyword;
  Transform transform;
  Thing material{eval::Type::material};
  MaterialOverrides materials;
  bool visible = true;
  template <class F>
  static void fields(F&& field) {
    using P = MeshFileParameters;
    field(&P::transform, FieldInfo{"transform", "moves it"});
    field(&P::material, FieldInfo{"material", "of all of it, instead of those in the file"});
    field(&P::materials,
          FieldInfo{"materials", "a list of [\"name in the file\", material] instead of those"});
    field(&P::visible, FieldInfo{"visible", "whether the camera sees it"});
  }
};
struct MeshFileShapeParameters {
  static constexpr std::string_view keyword = scene::Mesh::keyword;
  template <class F>
  static void fields(F&&) {}
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
