// KHR_lights_punctual, and cameras.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "import/gltf/file.h"

namespace tyndall::gltf {

namespace {

// Candela and lux to watts: of light at 555 nm, as exporters take it.
constexpr double lumens_per_watt = 683;

scene::Light spot(const Element& light, const Rgb& intensity) {
  double inner = 0, outer = pi / 4;
  if (const auto cone = light.find("spot")) {
    inner = cone->number("innerConeAngle", inner);
    outer = cone->number("outerConeAngle", outer);
    if (!(inner >= 0 && inner <= outer && outer > 0 && outer <= pi / 2))
      cone->fail(fmt::format("has cones of {} and {} rad", inner, outer));
  }
  scene::SpotLight out;
  out.position = {};
  out.to = {0, 0, -1};
  out.angle = Angle{outer};
  out.blend = 1 - inner / outer;
  out.intensity = intensity;
  return out;
}

}  // namespace

std::optional<scene::Light> light_of(Document& document, const Element& node) {
  const auto extension = node.extension("KHR_lights_punctual");
  if (!extension) return std::nullopt;
  const auto all = document.root().extension("KHR_lights_punctual");
  if (!all) extension->fail("is there, but the file has no lights");
  const Element lights = (*all)["lights"];
  const Element light = lights.at((*extension)["light"].index(lights.size(), "lights"));
  const Vec3d color = light.vec("color", {1, 1, 1});
  const double intensity = light.number("intensity", 1);
  if (!(intensity >= 0)) light["intensity"].fail(fmt::format("is {}: no light is negative", intensity));
  if (!(min_component(color) >= 0)) light["color"].fail("is negative");
  const Rgb radiant(color * (intensity / lumens_per_watt));
  const std::string type = light["type"].text();
  if (type == "spot") return spot(light, radiant);
  if (type == "point") {
    scene::PointLight out;
    out.intensity = radiant;
    return out;
  }
  if (type == "directional") {
    scene::DistantLight out;
    out.direction = {0, 0, -1};
    out.irradiance = radiant;
    return out;
  }
  light["type"].fail(fmt::format("is '{}', which is none of glTF's", type));
}

std::optional<PlacedCamera> camera_of(Document& document, const Element& node) {
  const auto index = document.index(node, "camera", "cameras");
  if (!index) return std::nullopt;
  const Element camera = document.item("cameras", *index);
  PlacedCamera out;
  out.name = camera.text("name");
  if (out.name.empty() || node.find("name")) out.name = name_of(node);
  const std::string type = camera["type"].text();
  if (type == "perspective") {
    const Element lens = camera["perspective"];
    const double fov = lens["yfov"].number();
    if (!(fov > 0 && fov < pi)) lens["yfov"].fail(fmt::format("is {} rad: between 0 and pi is a view", fov));
    scene::PerspectiveCamera to;
    to.from = {};
    to.to = {0, 0, -1};
    to.fov = Angle{fov};
    out.camera = to;
  } else if (type == "orthographic") {
    const Element lens = camera["orthographic"];
    const double half = lens["ymag"].number();
    if (!(half > 0)) lens["ymag"].fail(fmt::format("is {}: nothing is seen", half));
    scene::OrthographicCamera to;
    to.from = {};
    to.to = {0, 0, -1};
    to.height = 2 * half;
    out.camera = to;
  } else {
    camera["type"].fail(fmt::format("is '{}', which is none of glTF's", type));
  }
  return out;
}

}  // namespace tyndall::gltf
