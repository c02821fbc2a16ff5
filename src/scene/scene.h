// The waist: everything the renderer is told, as plain data in world space. Text ends above it, rendering
// begins below it. A test builds one in ten lines.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/fields.h"
#include "base/id.h"
#include "base/source.h"
#include "base/transform.h"
#include "base/vec.h"
#include "image/view.h"
#include "optics/surface_model.h"
#include "scene/lights.h"
#include "scene/medium.h"
#include "scene/motion.h"
#include "scene/render_settings.h"
#include "scene/shutter.h"
#include "scene/step.h"
#include "shapes/shape.h"
#include "vm/program/program.h"

namespace tyndall::scene {

// Shapes are in the space of their own statement; ShapeInstance::world_from_object places them.
using namespace shapes;

// -------------------------------------------------------------------------------------------------- settings

struct Animation {
  static constexpr std::string_view keyword = "animation";
  double fps = 24;
  int first_frame = 0, last_frame = 0;
  Shutter shutter;
  ShutterCurve shutter_curve{};
};

// ---------------------------------------------------------------------------------------------------- camera

// How its picture is shown; light has no part in it.
struct CameraView {
  image::Exposure exposure;
  image::Tonemap tonemap = image::View{}.tonemap;

  // As fields of the camera T.
  template <class T, class F>
  static void fields_of(F&& field) {
    field(&T::exposure,
          FieldInfo{"exposure",
                    "in stops, of pictures for the eye: a number, `auto`, or `auto(…)` with stops beside the "
                    "metered ones"});
    field(&T::tonemap,
          FieldInfo{"tonemap", "the tone curve of pictures for the eye: `film`, `agx`, `neutral` or `none`"});
  }
};

struct PerspectiveCamera : CameraView {
  static constexpr std::string_view keyword = "camera perspective";
  Vec3d from{0, 0, 5}, to, up{0, 1, 0};
  Angle fov{0.6981317007977318};  // vertical
  double aperture = 0;            // lens radius [m]
  double focus = 0;               // distance along the axis [m]; 0: the distance to `to`
  template <class F>
  static void fields(F&& field) {
    field(&PerspectiveCamera::from, FieldInfo{"from", "its position [m]", Quantity::position, required});
    field(&PerspectiveCamera::to, FieldInfo{"to", "what it looks at [m]", Quantity::position, required});
    field(&PerspectiveCamera::fov,
          FieldInfo{"fov", "vertical field of view, in (0deg, 180deg)", Quantity::angle});
    field(&PerspectiveCamera::up, FieldInfo{"up", "which way is up", Quantity::direction});
    field(&PerspectiveCamera::aperture, FieldInfo{"aperture", "lens radius, >= 0 [m]", Quantity::length});
    field(&PerspectiveCamera::focus,
          FieldInfo{"focus", "distance in focus along the axis [m]; default: to `to`", Quantity::length});
    fields_of<PerspectiveCamera>(field);
  }
};

// Parallel rays; `height` is the height of the picture in the world.
struct OrthographicCamera : CameraView {
  static constexpr std::string_view keyword = "camera orthographic";
  Vec3d from{0, 0, 5}, to, up{0, 1, 0};
  double height = 1;
  template <class F>
  static void fields(F&& field) {
    field(&OrthographicCamera::from,
          FieldInfo{"from", "the centre of its window [m]", Quantity::position, required});
    field(&OrthographicCamera::to, FieldInfo{"to", "what it looks at [m]", Quantity::position, required});
    field(&OrthographicCamera::height,
          FieldInfo{"height", "height of the picture in the world, > 0 [m]", Quantity::length, required});
    field(&OrthographicCamera::up, FieldInfo{"up", "which way is up", Quantity::direction});
    fields_of<OrthographicCamera>(field);
  }
};

// Sees all around in one picture: longitude across, latitude up (equirectangular). The centre of the picture
// is the way to `to`; +y is its top.
struct SphericalCamera : CameraView {
  static constexpr std::string_view keyword = "camera spherical";
  Vec3d from, to{0, 0, -1}, up{0, 1, 0};  // `up` is what transforms make of +y
  template <class F>
  static void fields(F&& field) {
    field(&SphericalCamera::from, FieldInfo{"from", "its position [m]", Quantity::position, required});
    field(&SphericalCamera::to,
          FieldInfo{"to", "the centre of its picture [m]", Quantity::position, required});
    fields_of<SphericalCamera>(field);
  }
};

using Camera = std::variant<PerspectiveCamera, OrthographicCamera, SphericalCamera>;

// ------------------------------------------------------------------------------------------------- materials

// A surface whose parameters may be programs of p n P N uv time. Optional ones are outputs of the program;
// absent ones have their defaults (optics::SurfaceParameters) and cost nothing. What they mean: shader's
// table of material outputs.
struct Material {
  std::string name;
  Span definition;
  vm::Program program;
  RgbOutputs base_color{};             // reflectance in [0, 1]
  std::optional<RgbOutputs> emission;  // emitted radiance [W/m²/sr], both sides
  std::optional<std::uint8_t> metallic, roughness, specular, transmission, coat;  // in [0, 1]
  // What bodies of the language do not set, but importers do: the gloss's reflectance at normal incidence is
  // multiplied by a colour, at least 0; the roughness of the coat, in [0, 1].
  std::optional<RgbOutputs> specular_color;
  std::optional<std::uint8_t> coat_roughness;
  std::optional<std::uint8_t> ior;      // >= 1; one value for the whole surface
  std::optional<std::uint8_t> opacity;  // in [0, 1]
  std::optional<RgbOutputs> sheen;      // in [0, 1]
  std::optional<RgbOutputs> normal;     // shading normal in object space, of any length
  std::vector<GivenNumber> given;       // one per output, for reports on bad values
  LatticePlaces lattice_places;

  // Lambert's law alone.
  bool matte() const { return !metallic && !specular && !transmission && !coat && !sheen; }
};
using MaterialId = Id<Material>;

struct ShapeInstance {
  Shape shape;
  Transform world_from_object;
  MaterialId material;  // always valid: resolve adds the default material (grey 0.8) when needed
  bool visible = true;  // to camera rays
  Span definition{};
  double priority = 0;  // of its inside where bodies of glass overlap
};

// `in` must be closed. The medium's p is in the space just inside the
// volume's own transform.
struct Volume {
  Shape shape;
  Transform world_from_shape;   // the shape's own transform included
  Transform world_from_medium;  // the volume's transform: p = inverse(world_from_medium) * P
  MediumId medium;
  std::optional<Step> step;
  bool visible = true;
  Span definition{};
  // Set: the medium gives way to bodies of glass of a higher priority.
  std::optional<double> priority{};
  // The shape that is its boundary, of the shapes beside it.
  std::optional<std::uint32_t> boundary{};
};

struct LightInstance {
  Light light;  // world space
  Span definition;
};

// ------------------------------------------------------------------------------------------------ prototypes

struct Prototype;
using PrototypeId = Id<Prototype>;

// An object where it was placed: its things are there without being copied.
struct Instance {
  PrototypeId prototype;
  Transform world_from_object;
  MaterialId
      material{};       // of the shapes that name none; invalid inside a prototype: the placement's around it
  bool visible = true;  // to camera rays; false hides all of it
  Span definition{};
};

// An object's things in its own space: the "world" of their transforms. A shape whose material is invalid
// takes that of the instance. Its instances name earlier prototypes only.
struct Prototype {
  std::string name;
  std::vector<ShapeInstance> shapes;
  std::vector<Volume> volumes;
  std::vector<Instance> instances;
  // In order of index.
  std::vector<Moving<ShapeInstance>> moving_shapes;
  std::vector<Moving<Instance>> moving_instances;
};

// What moves of a scene beside its prototypes' things, each in order of index.
struct Motion {
  Moving<Camera> camera;  // empty: it stands still
  std::vector<Moving<ShapeInstance>> shapes;
  std::vector<Moving<Instance>> instances;
  std::vector<Moving<Volume>> volumes;  // of all_volumes
  std::vector<Moving<LightInstance>> lights;
};

// ----------------------------------------------------------------------------------------------------- scene

struct Scene {
  RenderSettings settings;
  Animation animation;
  int frame = 0;    // the whole number that `frame` was
  double time = 0;  // seconds, when the shutter opens
  Motion motion;    // while it is open
  Camera camera;
  std::vector<Medium> media;
  std::vector<Material> materials;
  std::vector<SharedMesh> meshes;
  std::vector<StrandSet> strand_sets;
  std::vector<ShapeInstance> shapes;
  std::vector<Volume> volumes;
  std::vector<LightInstance> lights;  // those of placed objects too
  std::vector<Prototype> prototypes;
  std::vector<Instance> instances;
};

// How long the shutter is open, and when it opens after the time of the frame [s].
double shutter_seconds(const Animation& animation);
double opening_seconds(const Animation& animation);
// When the shutter of a frame opens [s].
double opening_time(const Animation& animation, int frame);

// The scene as text, one thing a paragraph, with every number: `inspect --stage scene`, and, of what decides
// its light alone, the scene hash. There a hash of each mesh, found once, stands for its points, and how the
// picture is shown is left out.
enum class Printed : bool { whole, as_light };
std::string print(const Scene& scene, Printed printed = Printed::whole);

// The volumes of the scene, then those of its instances, in world space.
std::vector<Volume> all_volumes(const Scene& scene);
// The same scene with a copy of every instance's things in place of the instances, after the scene's own
// things.
Scene expanded(const Scene& scene);

// How many edges of a mesh lack a triangle on either side, or are between two that turn against each other;
// points at the same place are one. 0: the mesh is closed, and its inside is where lines cross it unevenly.
std::size_t open_edges(const TriangleMesh& mesh);
std::size_t open_edges(const SharedMesh& mesh);  // counted once

// Ready-made parts for tests and defaults.
MaterialId add_diffuse(Scene& scene, const Rgb& base_color, const Rgb& emission = {});
struct ConstantSurface {
  optics::SurfaceParameters parameters;
  float ior = 1.5f, opacity = 1;
};
MaterialId add_surface(Scene& scene, const ConstantSurface& surface);
struct ConstantMedium {
  Rgb sigma_s, sigma_t, emission;
  std::vector<PhaseLobe> phase;  // empty: isotropic when anything scatters
};
MediumId add_constant_medium(Scene& scene, const ConstantMedium& medium);

}  // namespace tyndall::scene
