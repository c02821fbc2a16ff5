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
#include "optics/lights.h"
#include "optics/surface_model.h"
#include "scene/medium.h"
#include "scene/motion.h"
#include "scene/multiple_scattering.h"
#include "scene/step.h"
#include "vm/program.h"

namespace tyndall::scene {

// -------------------------------------------------------------------------------------------------- settings

struct RenderSettings {
  static constexpr std::string_view keyword = "render";
  int width = 640, height = 360;  // `resolution: (w, h)`, read by resolve
  int samples = 64;
  Step step;  // volumes may override it
  int light_samples = 1;
  int bounces = 1024;
  std::uint64_t seed = 0;
  MultipleScattering multiple_scattering;
};

struct Animation {
  static constexpr std::string_view keyword = "animation";
  double fps = 24;
  int first_frame = 0, last_frame = 0;
  Angle shutter;  // 0 closed; 360deg is the whole frame
};

// ---------------------------------------------------------------------------------------------------- camera

struct PerspectiveCamera {
  static constexpr std::string_view keyword = "camera perspective";
  Vec3d from{0, 0, 5}, to, up{0, 1, 0};
  Angle fov{0.6981317007977318};  // vertical
  double aperture = 0;            // lens radius [m]
  double focus = 0;               // distance along the axis [m]; 0: the distance to `to`
  double exposure = 0;            // stops, 8-bit outputs only
  template <class F>
  static void fields(F&& field) {
    field(&PerspectiveCamera::from, FieldInfo{"from", "where it stands [m]", Quantity::position, required});
    field(&PerspectiveCamera::to, FieldInfo{"to", "what it looks at [m]", Quantity::position, required});
    field(&PerspectiveCamera::fov,
          FieldInfo{"fov", "vertical field of view, in (0deg, 180deg)", Quantity::angle});
    field(&PerspectiveCamera::up, FieldInfo{"up", "which way is up", Quantity::direction});
    field(&PerspectiveCamera::aperture, FieldInfo{"aperture", "lens radius, >= 0 [m]", Quantity::length});
    field(&PerspectiveCamera::focus,
          FieldInfo{"focus", "distance in focus along the axis [m]; default: to `to`", Quantity::length});
    field(&PerspectiveCamera::exposure,
          FieldInfo{"exposure", "stops, for 8-bit outputs only", Quantity::plain});
  }
};

// Parallel rays; `height` is the height of the picture in the world.
struct OrthographicCamera {
  static constexpr std::string_view keyword = "camera orthographic";
  Vec3d from{0, 0, 5}, to, up{0, 1, 0};
  double height = 1;
  double exposure = 0;
  template <class F>
  static void fields(F&& field) {
    field(&OrthographicCamera::from,
          FieldInfo{"from", "the middle of its window [m]", Quantity::position, required});
    field(&OrthographicCamera::to, FieldInfo{"to", "what it looks at [m]", Quantity::position, required});
    field(&OrthographicCamera::height,
          FieldInfo{"height", "height of the picture in the world, > 0 [m]", Quantity::length, required});
    field(&OrthographicCamera::up, FieldInfo{"up", "which way is up", Quantity::direction});
    field(&OrthographicCamera::exposure,
          FieldInfo{"exposure", "stops, for 8-bit outputs only", Quantity::plain});
  }
};

// Sees all around in one picture: longitude across, latitude up (equirectangular). The centre of the picture
// is the way to `to`; +y is its top.
struct SphericalCamera {
  static constexpr std::string_view keyword = "camera spherical";
  Vec3d from, to{0, 0, -1}, up{0, 1, 0};  // `up` is what transforms make of +y
  double exposure = 0;
  template <class F>
  static void fields(F&& field) {
    field(&SphericalCamera::from, FieldInfo{"from", "where it stands [m]", Quantity::position, required});
    field(&SphericalCamera::to,
          FieldInfo{"to", "the middle of its picture [m]", Quantity::position, required});
    field(&SphericalCamera::exposure,
          FieldInfo{"exposure", "stops, for 8-bit outputs only", Quantity::plain});
  }
};

using Camera = std::variant<PerspectiveCamera, OrthographicCamera, SphericalCamera>;

// -------------------------------------------------------------------------------------------------- shapes

// In the space of their own statement; ShapeInstance::world_from_object places them.

struct Sphere {
  static constexpr std::string_view keyword = "sphere";
  Vec3d center;
  double radius = 1;
  template <class F>
  static void fields(F&& field) {
    field(&Sphere::center, FieldInfo{"center", "its middle [m]", Quantity::position});
    field(&Sphere::radius, FieldInfo{"radius", "its radius, > 0 [m]", Quantity::length});
  }
};

struct Box {
  static constexpr std::string_view keyword = "box";
  Vec3d min, max;
  template <class F>
  static void fields(F&& field) {
    field(&Box::min, FieldInfo{"min", "its lowest corner [m]", Quantity::position, required});
    field(&Box::max, FieldInfo{"max", "its highest corner [m]", Quantity::position, required});
  }
};

struct Plane {
  static constexpr std::string_view keyword = "plane";
  Vec3d point, normal{0, 1, 0};
  template <class F>
  static void fields(F&& field) {
    field(&Plane::point, FieldInfo{"point", "any point of it [m]", Quantity::position, required});
    field(&Plane::normal, FieldInfo{"normal", "the way it faces", Quantity::direction, required});
  }
};

// Half edges u, v around center; faces u × v.
struct Quad {
  static constexpr std::string_view keyword = "quad";
  Vec3d center, u, v;
  template <class F>
  static void fields(F&& field) {
    field(&Quad::center, FieldInfo{"center", "its middle [m]", Quantity::position, required});
    field(&Quad::u, FieldInfo{"u", "half of one edge [m]", Quantity::direction, required});
    field(&Quad::v, FieldInfo{"v", "half of the other edge [m]", Quantity::direction, required});
  }
};

struct Disk {
  static constexpr std::string_view keyword = "disk";
  Vec3d center, normal{0, 1, 0};
  double radius = 1;
  template <class F>
  static void fields(F&& field) {
    field(&Disk::center, FieldInfo{"center", "its middle [m]", Quantity::position, required});
    field(&Disk::normal, FieldInfo{"normal", "the way it faces", Quantity::direction, required});
    field(&Disk::radius, FieldInfo{"radius", "its radius, > 0 [m]", Quantity::length, required});
  }
};

// Closed by flat ends.
struct Cylinder {
  static constexpr std::string_view keyword = "cylinder";
  Vec3d from, to{0, 1, 0};
  double radius = 1;
  template <class F>
  static void fields(F&& field) {
    field(&Cylinder::from, FieldInfo{"from", "the middle of one end [m]", Quantity::position, required});
    field(&Cylinder::to, FieldInfo{"to", "the middle of the other end [m]", Quantity::position, required});
    field(&Cylinder::radius, FieldInfo{"radius", "its radius, > 0 [m]", Quantity::length, required});
  }
};

// Triangles between points; front sides are those from which the corners run counter-clockwise.
struct TriangleMesh {
  std::vector<Vec3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // indices of points
  std::vector<Vec3d> normals;                           // one a point, or none
  std::vector<Pair<double>> uvs;                        // one a point, or none
};
using MeshId = Id<TriangleMesh>;

// One of the scene's meshes, as a shape.
struct Mesh {
  static constexpr std::string_view keyword = "mesh";
  MeshId mesh;
  template <class F>
  static void fields(F&& field) {
    field(&Mesh::mesh, FieldInfo{"mesh", "the number of the mesh"});
  }
};

// Tubes along smooth curves: hair, grass, threads. Each strand goes through its points, by Catmull and Rom's
// spline; its radius goes from point to point along with it.
struct StrandSet {
  std::vector<Vec3d> points;         // of all strands, one strand after the other
  std::vector<double> radii;         // one a point, >= 0
  std::vector<std::uint32_t> begin;  // of each strand, and the end of the last
  std::size_t strands() const { return begin.empty() ? 0 : begin.size() - 1; }
};
using StrandSetId = Id<StrandSet>;

// One of the scene's strand sets, as a shape.
struct Curves {
  static constexpr std::string_view keyword = "curves";
  StrandSetId strands;
  template <class F>
  static void fields(F&& field) {
    field(&Curves::strands, FieldInfo{"strands", "the number of the strand set"});
  }
};

using Shape = std::variant<Sphere, Box, Plane, Quad, Disk, Cylinder, Mesh, Curves>;

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

// `in` must be closed: a sphere, box, cylinder or mesh. The medium's p is in the space just inside the
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
  optics::Light light;  // world space
  Span definition;
  std::optional<Shape> shape{};  // of a mesh light, placed by its world_from_shape
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
  std::vector<TriangleMesh> meshes;
  std::vector<StrandSet> strand_sets;
  std::vector<ShapeInstance> shapes;
  std::vector<Volume> volumes;
  std::vector<LightInstance> lights;  // those of placed objects too
  std::vector<Prototype> prototypes;
  std::vector<Instance> instances;
};

// How long the shutter is open [s].
double shutter_seconds(const Animation& animation);

// The scene as text, one thing a paragraph, with every number: `inspect --stage scene`, and the scene hash.
std::string print(const Scene& scene);

// The volumes of the scene, then those of its instances, in world space.
std::vector<Volume> all_volumes(const Scene& scene);
// The same scene with a copy of every instance's things in place of the instances, after the scene's own
// things.
Scene expanded(const Scene& scene);

// How many edges of a mesh lack a triangle on either side, or are between two that turn against each other;
// points at the same place are one. 0: the mesh is closed, and its inside is where lines cross it unevenly.
std::size_t open_edges(const TriangleMesh& mesh);

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
