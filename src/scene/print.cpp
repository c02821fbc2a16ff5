// The scene as text, every number in shortest exact form: `inspect --stage scene`, and what the scene hash is
// of. Places in the source are left out: a scene's print does not change with its layout.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>

#include "base/content_hash.h"
#include "scene/scene.h"
#include "shapes/combined_parts.h"

namespace tyndall::scene {

namespace {

class Printer {
 public:
  void line(std::string_view words) { fmt::format_to(out(), "{}\n", words); }
  template <class T>
  void item(std::string_view name, const T& value) {
    fmt::format_to(out(), "  {} ", name);
    put(value);
    put_text("\n");
  }
  template <class T>
  void item(std::string_view name, const std::optional<T>& value) {
    if (value) item(name, *value);
  }
  void item(std::string_view, const Resolution& size) {
    item("width", size.width);
    item("height", size.height);
  }
  // Every parameter that a struct's fields() names; optional ones only when they were given.
  template <class T>
  void fields(const T& thing) {
    T::fields([&](auto member, const FieldInfo& info) { item(info.name, thing.*member); });
  }
  void program(std::string_view name, const vm::Program& program);
  void count(std::string_view what, std::size_t n) { fmt::format_to(out(), "{} {}", what, n); }
  void put_text(std::string_view text) { buffer_.append(text); }

  std::string text() const { return fmt::to_string(buffer_); }

 private:
  std::back_insert_iterator<fmt::memory_buffer> out() { return std::back_inserter(buffer_); }

  void put(double v) { fmt::format_to(out(), "{}", v); }
  void put(int v) { fmt::format_to(out(), "{}", v); }
  void put(std::uint64_t v) { fmt::format_to(out(), "{}", v); }
  void put(std::uint32_t v) { fmt::format_to(out(), "{}", v); }
  void put(const image::Exposure& v) { put_text(describe(v)); }
  void put(image::Tonemap v) { put_text(describe(v)); }
  void put(const Step& v) { put_text(describe(v)); }
  void put(const MultipleScattering& v) { put_text(describe(v)); }
  void put(const Clamp& v) { put_text(describe(v)); }
  void put(bool v) { put_text(v ? "true" : "false"); }
  void put(const Angle& a) { fmt::format_to(out(), "{}rad", a.radians); }
  void put(std::string_view v) { put_text(v); }
  template <class T>
  void put(const Vec3<T>& v) {
    fmt::format_to(out(), "({}, {}, {})", v.x, v.y, v.z);
  }
  void put(const Transform& t) {
    if (t == Transform{}) return put_text("identity");
    put_text("x ");
    put(t.x);
    put_text(" y ");
    put(t.y);
    put_text(" z ");
    put(t.z);
    put_text(" t ");
    put(t.t);
  }
  void put(const MeshId& m) { put(m.index); }
  void put(const StrandSetId& s) { put(s.index); }
  void put(const std::vector<double>& v) { fmt::format_to(out(), "{}", fmt::join(v, " ")); }
  void put(const Pair<double>& v) { fmt::format_to(out(), "({}, {})", v.x, v.y); }
  void put(const std::array<std::uint32_t, 3>& v) { fmt::format_to(out(), "({}, {}, {})", v[0], v[1], v[2]); }
  void put(const std::array<float, 4>& v) { fmt::format_to(out(), "({})", fmt::join(v, ", ")); }
  void put(const RgbOutputs& o) { fmt::format_to(out(), "outputs {} {} {}", o[0], o[1], o[2]); }
  void put(const PhaseLobe::Number& n) {
    if (n.output)
      fmt::format_to(out(), "output {}", *n.output);
    else
      fmt::format_to(out(), "{}", n.value);
  }
  void put(const optics::SkyRadiance& r) {
    put(r.color);
    for (const PlanePointer& plane : r.picture)
      if (plane)
        fmt::format_to(out(), " {} {} x {} {:016x}", plane->name, plane->width, plane->height, plane->hash);
  }
  void put(const PhaseLobe& lobe) {
    put_text(optics::info(lobe.kind).keyword);
    for (std::size_t k = 0; k < lobe.parameters.size(); ++k) {
      put_text(k == 0 ? " (" : ", ");
      put(lobe.parameters[k]);
    }
    put_text(") weight ");
    put(lobe.weight);
  }

  fmt::memory_buffer buffer_;
};

// The listing, two spaces in.
void Printer::program(std::string_view name, const vm::Program& program) {
  fmt::format_to(out(), "  {}\n", name);
  const std::string listing = vm::print(program);
  std::string_view rest = listing;
  while (!rest.empty()) {
    const std::size_t end = rest.find('\n');
    fmt::format_to(out(), "    {}\n", rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
  }
}

void print_settings(Printer& p, const Scene& scene) {
  p.line(RenderSettings::keyword);
  p.fields(scene.settings);
  p.line(Animation::keyword);
  p.item("fps", scene.animation.fps);
  p.item("first_frame", scene.animation.first_frame);
  p.item("last_frame", scene.animation.last_frame);
  if (scene.animation.shutter.opens != Angle{}) p.item("shutter_opens", scene.animation.shutter.opens);
  p.item("shutter", scene.animation.shutter.closes);
  if (scene.animation.shutter_curve != ShutterCurve{})
    p.item("shutter_curve", describe(scene.animation.shutter_curve));
  p.item("frame", scene.frame);
  p.item("time", scene.time);
}

void print_medium(Printer& p, const Medium& m) {
  p.item("name", m.name);
  p.item("sigma_s", m.sigma_s);
  p.item("sigma_t", m.sigma_t);
  p.item("emission", m.emission);
  for (const PhaseLobe& lobe : m.phase) p.item("phase", lobe);
  p.program("full", m.full);
  p.item("extinction_sigma_t", m.extinction_sigma_t);
  p.program("extinction", m.extinction);
}

void print_material(Printer& p, const Material& m) {
  p.item("name", m.name);
  p.item("base_color", m.base_color);
  p.item("emission", m.emission);
  p.item("metallic", m.metallic);
  p.item("roughness", m.roughness);
  p.item("specular", m.specular);
  p.item("transmission", m.transmission);
  p.item("coat", m.coat);
  p.item("specular_color", m.specular_color);
  p.item("coat_roughness", m.coat_roughness);
  p.item("ior", m.ior);
  p.item("opacity", m.opacity);
  p.item("sheen", m.sheen);
  p.item("normal", m.normal);
  p.program("program", m.program);
}

void print_mesh(Printer& p, const TriangleMesh& mesh) {
  for (const Vec3d& point : mesh.points) p.item("point", point);
  for (const auto& triangle : mesh.triangles) p.item("triangle", triangle);
  for (const Vec3d& normal : mesh.normals) p.item("normal", normal);
  for (const Pair<double>& uv : mesh.uvs) p.item("uv", uv);
  for (const auto& tangent : mesh.tangents) p.item("tangent", tangent);
  for (const auto& color : mesh.colors) p.item("color", color);
  for (const Pair<double>& uv : mesh.second_uvs) p.item("uv2", uv);
  if (mesh.thin) p.line("  thin");
  for (const MeshPose& pose : mesh.later) {
    p.line("  later");
    for (const Vec3d& point : pose.points) p.item("point", point);
    for (const Vec3d& normal : pose.normals) p.item("normal", normal);
    for (const auto& tangent : pose.tangents) p.item("tangent", tangent);
  }
}

const std::string& hash_of(const SharedMesh& mesh) {
  std::string& known = mesh.findings().print_hash;
  if (known.empty()) {
    Printer p;
    print_mesh(p, *mesh);
    ContentHash hash;
    hash.add(p.text());
    known = hash.text();
  }
  return known;
}

// The keyword of a variant's alternative on a line, and its fields; the parts of a combination, in braces.
template <class Variant>
void print_variant(Printer& p, const Variant& variant) {
  std::visit(
      [&](const auto& thing) {
        p.line(thing.keyword);
        p.fields(thing);
        if constexpr (requires { thing.parts; }) {
          p.line("{");
          for (const CombinedPart& part : thing.parts->list) {
            print_variant(p, part.shape);
            if (part.placed) p.item("transform", part.placed->outer_from_part);
          }
          p.line("}");
        }
      },
      variant);
}

// The shapes, volumes and instances of a scene or a prototype.
template <class Things>
void print_things(Printer& p, const Things& things) {
  const auto material = [&](MaterialId id) {
    if (id.valid()) p.item("material", id.index);
  };
  for (const ShapeInstance& s : things.shapes) {
    print_variant(p, s.shape);
    p.item("world_from_object", s.world_from_object);
    material(s.material);
    p.item("visible", s.visible);
    if (s.priority != 0) p.item("priority", s.priority);
  }
  for (const Volume& v : things.volumes) {
    p.put_text("volume in ");
    print_variant(p, v.shape);
    p.item("world_from_shape", v.world_from_shape);
    p.item("world_from_medium", v.world_from_medium);
    p.item("medium", v.medium.index);
    p.item("step", v.step);
    p.item("priority", v.priority);
    p.item("boundary", v.boundary);
    p.item("visible", v.visible);
  }
  for (const Instance& i : things.instances) {
    p.line("instance");
    p.item("prototype", i.prototype.index);
    p.item("world_from_object", i.world_from_object);
    material(i.material);
    p.item("visible", i.visible);
  }
}

template <class Light>
void print_light(Printer& p, const Light& light) {
  p.line(light.keyword);
  p.fields(light);
  if constexpr (requires { light.world_from_sky; }) p.item("world_from_sky", light.world_from_sky);
}

// As it is written: with its shape's own parameters where it is named after that.
void print_light(Printer& p, const AreaLight& light) {
  p.line(light.keyword());
  std::visit(
      [&]<class S>(const S& shape) {
        if constexpr (is_one_of<S, LightShapes>) p.fields(shape);
      },
      light.shape);
  p.fields(light);
  if (light.keyword() != AreaLight::mesh_keyword) return;
  p.put_text("in ");
  print_variant(p, light.shape);
  p.item("world_from_shape", light.world_from_shape);
}

template <class T>
void print_keys(Printer& p, const Moving<T>& moving) {
  for (std::size_t i = 0; i < moving.keys.size(); ++i) {
    p.item("at", moving.times[i]);
    p.item("key", moving_numbers(moving.keys[i]));
  }
  for (const Turning& turning : moving.turnings) p.item("pivot", turning.pivot);
}

// The numbers of what moves, moment by moment.
template <class T>
void print_moving(Printer& p, std::string_view what, const std::vector<Moving<T>>& all) {
  for (const Moving<T>& moving : all) {
    p.put_text("moving ");
    p.count(what, moving.index);
    p.line("");
    print_keys(p, moving);
  }
}

}  // namespace

std::string print(const Scene& scene, Printed printed) {
  Printer p;
  print_settings(p, scene);
  Camera camera = scene.camera;
  if (printed == Printed::as_light) std::visit([](CameraView& view) { view = {}; }, camera);
  print_variant(p, camera);
  print_keys(p, scene.motion.camera);
  for (std::size_t i = 0; i < scene.media.size(); ++i) {
    p.count("medium", i);
    p.line("");
    print_medium(p, scene.media[i]);
  }
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    p.count("material", i);
    p.line("");
    print_material(p, scene.materials[i]);
  }
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    p.count("mesh", i);
    p.line("");
    if (printed == Printed::as_light)
      p.item("hash", hash_of(scene.meshes[i]));
    else
      print_mesh(p, *scene.meshes[i]);
  }
  for (std::size_t i = 0; i < scene.strand_sets.size(); ++i) {
    p.count("strands", i);
    p.line("");
    for (const std::uint32_t first : scene.strand_sets[i].begin) p.item("begin", first);
    for (const Vec3d& point : scene.strand_sets[i].points) p.item("point", point);
    for (const double radius : scene.strand_sets[i].radii) p.item("radius", radius);
    for (const StrandPose& pose : scene.strand_sets[i].later) {
      p.line("  later");
      for (const Vec3d& point : pose.points) p.item("point", point);
      for (const double radius : pose.radii) p.item("radius", radius);
    }
  }
  for (std::size_t i = 0; i < scene.prototypes.size(); ++i) {
    p.count("prototype", i);
    p.line("");
    p.item("name", scene.prototypes[i].name);
    print_things(p, scene.prototypes[i]);
    print_moving(p, "shape", scene.prototypes[i].moving_shapes);
    print_moving(p, "instance", scene.prototypes[i].moving_instances);
    p.line("end");
  }
  print_things(p, scene);
  for (const LightInstance& l : scene.lights) {
    std::visit([&](const auto& light) { print_light(p, light); }, l.light);
  }
  print_moving(p, "shape", scene.motion.shapes);
  print_moving(p, "instance", scene.motion.instances);
  print_moving(p, "volume", scene.motion.volumes);
  print_moving(p, "light", scene.motion.lights);
  return p.text();
}

}  // namespace tyndall::scene
