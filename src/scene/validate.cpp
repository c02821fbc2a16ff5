// Range checks of scene things: see validate.h.
#include "scene/validate.h"

#include <fmt/format.h>

#include "base/numerics.h"
#include "scene/ranges.h"

namespace tyndall::scene {

namespace {

constexpr int max_scattering_orders = 64;

std::string text(const Vec3d& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }

void want_positive(Problems& problems, std::string_view field, double value, std::string help = {}) {
  if (!(value > 0))
    problems.push_back({field, fmt::format("'{}' must be above 0, found {}", field, value), help});
}

void want_not_negative(Problems& problems, std::string_view field, double value) {
  if (!(value >= 0))
    problems.push_back({field, fmt::format("'{}' must not be negative, found {}", field, value)});
}

void want_at_least(Problems& problems, std::string_view field, int value, int least) {
  if (value < least)
    problems.push_back({field, fmt::format("'{}' must be at least {}, found {}", field, least, value)});
}

void want_within(Problems& problems, std::string_view field, int value, const WholeRange& range) {
  if (!range.holds(value))
    problems.push_back(
        {field, fmt::format("'{}' must be from {} to {}, found {}", field, range.least, range.most, value)});
}

void want_share(Problems& problems, std::string_view field, double value) {
  if (!(value >= 0 && value <= 1))
    problems.push_back({field, fmt::format("'{}' must be from 0 to 1, found {}", field, value)});
}

// An emitted quantity: every channel is finite and not negative.
void want_color(Problems& problems, std::string_view field, const std::optional<Rgb>& color) {
  if (!color) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const float value = (*color)[i];
    if (value >= 0 && std::isfinite(value)) continue;
    problems.push_back({field, std::isfinite(value)
                                   ? fmt::format("'{}' must not be negative, found {}", field, value)
                                   : fmt::format("'{}' is too large to be stored", field)});
    return;
  }
}

void want_direction(Problems& problems, std::string_view field, const Vec3d& v) {
  const double length2 = length_squared(v);
  if (length2 > 0 && std::isfinite(length2)) return;
  problems.push_back({field, fmt::format("'{}' has no direction, found {}", field, text(v))});
}

// u × v must span an area that doubles can hold.
void want_area(Problems& problems, const Vec3d& u, const Vec3d& v) {
  const double area2 = length_squared(cross(u, v));
  // 1e-24: sin² of the smallest angle between u and v that leaves the normal half of its digits.
  if (area2 > 1e-24 * length_squared(u) * length_squared(v)) return;
  problems.push_back({"v", fmt::format("u and v span no area, found u {} and v {}", text(u), text(v)),
                      "u and v are half of two edges that are not parallel: u: (1, 0, 0) v: (0, 0, 1)"});
}

void want_view(Problems& problems, const Vec3d& from, const Vec3d& to, const Vec3d& up) {
  if (from == to) {
    problems.push_back({"to", fmt::format("'to' is where the camera stands, {}", text(to)),
                        "give a point that the camera looks at"});
  } else if (!Transform::look_at(from, to, up)) {
    problems.push_back({"up", fmt::format("'up' {} is along the view", text(up)),
                        "give a direction across the view: up: (0, 0, 1) for a camera that looks down"});
  }
}

}  // namespace

Problems validate(const RenderSettings& s) {
  Problems problems;
  if (!resolution_range.holds(s.width) || !resolution_range.holds(s.height))
    problems.push_back(
        {"resolution", fmt::format("'resolution' must be from {} to {} on each side, found ({}, {})",
                                   resolution_range.least, resolution_range.most, s.width, s.height)});
  want_within(problems, "samples", s.samples, samples_range);
  if (!s.step.automatic()) want_positive(problems, "step", s.step.metres);
  want_within(problems, "light_samples", s.light_samples, light_samples_range);
  want_within(problems, "bounces", s.bounces, bounces_range);
  return problems;
}

Problems validate(const ApproximateScattering& a) {
  Problems problems;
  want_at_least(problems, "real", a.real, 0);
  want_at_least(problems, "orders", a.orders, 0);
  if (a.orders > max_scattering_orders)
    problems.push_back(
        {"orders", fmt::format("'orders' must be at most {}, found {}", max_scattering_orders, a.orders)});
  want_share(problems, "extinction", a.extinction);
  want_share(problems, "contribution", a.contribution);
  want_share(problems, "anisotropy", a.anisotropy);
  return problems;
}

Problems validate(const Animation& a) {
  Problems problems;
  want_positive(problems, "fps", a.fps);
  if (!(a.first_frame <= a.last_frame))
    problems.push_back(
        {"frames", fmt::format("'frames' holds no frame, found {}..{}", a.first_frame, a.last_frame)});
  // A whole turn written as 360deg may round up by an ulp or two.
  if (!(a.shutter.radians >= 0 && a.shutter.radians <= 2 * pi * (1 + 1e-12)))
    problems.push_back({"shutter", fmt::format("'shutter' must be from 0deg to 360deg, found {}deg",
                                               a.shutter.radians * 180 / pi)});
  return problems;
}

Problems validate(const PerspectiveCamera& c) {
  Problems problems;
  if (!(c.fov.radians > 0 && c.fov.radians < pi))
    problems.push_back(
        {"fov", fmt::format("'fov' must be between 0deg and 180deg, found {}deg", c.fov.radians * 180 / pi)});
  want_not_negative(problems, "aperture", c.aperture);
  want_not_negative(problems, "focus", c.focus);
  want_view(problems, c.from, c.to, c.up);
  return problems;
}

Problems validate(const OrthographicCamera& c) {
  Problems problems;
  want_positive(problems, "height", c.height);
  want_view(problems, c.from, c.to, c.up);
  return problems;
}

Problems validate(const SphericalCamera& c) {
  Problems problems;
  if (c.from == c.to || !Transform::look_at(c.from, c.to, c.up))
    problems.push_back({"to",
                        fmt::format("'to' {} must be to the side of 'from' {}", text(c.to), text(c.from)),
                        "the top of the picture is +y: turn the camera with a `transform`"});
  return problems;
}

Problems validate(const Sphere& s) {
  Problems problems;
  want_positive(problems, "radius", s.radius);
  return problems;
}

Problems validate(const Box& b) {
  Problems problems;
  for (std::size_t i = 0; i < 3; ++i) {
    if (b.min[i] < b.max[i]) continue;
    problems.push_back({"max", fmt::format("'max' must be above 'min' on every axis, found {} and {} on {}",
                                           b.min[i], b.max[i], "xyz"[i])});
    break;
  }
  return problems;
}

Problems validate(const Plane& p) {
  Problems problems;
  want_direction(problems, "normal", p.normal);
  return problems;
}

Problems validate(const Quad& q) {
  Problems problems;
  want_area(problems, q.u, q.v);
  return problems;
}

Problems validate(const Disk& d) {
  Problems problems;
  want_direction(problems, "normal", d.normal);
  want_positive(problems, "radius", d.radius);
  return problems;
}

Problems validate(const Cylinder& c) {
  Problems problems;
  const double length2 = length_squared(c.to - c.from);
  if (!(length2 > 0 && std::isfinite(length2)))
    problems.push_back(
        {"to", fmt::format("'to' must be away from 'from', found {} and {}", text(c.to), text(c.from)),
         "a cylinder without height is a `disk`"});
  want_positive(problems, "radius", c.radius);
  return problems;
}

Problems validate(const StrandSet& s) {
  Problems problems;
  for (const double radius : s.radii) {
    if (radius >= 0 && std::isfinite(radius)) continue;
    problems.push_back({"radius", fmt::format("'radius' must be 0 or more, found {}", radius)});
    break;
  }
  for (std::size_t strand = 0; strand < s.strands() && problems.empty(); ++strand) {
    const auto first = s.points.begin() + s.begin[strand], last = s.points.begin() + s.begin[strand + 1];
    if (std::all_of(first, last, [&](const Vec3d& p) { return p == *first; }))
      problems.push_back(
          {"points", fmt::format("the points of strand {} are all at the same place", strand)});
  }
  return problems;
}

Problems validate(const TriangleMesh& m) {
  Problems problems;
  if (m.triangles.empty()) problems.push_back({"triangles", "'triangles' holds none"});
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    const auto& t = m.triangles[i];
    const std::uint32_t largest = std::max({t[0], t[1], t[2]});
    if (largest < m.points.size()) continue;
    problems.push_back(
        {"triangles",
         fmt::format("triangle {} names point {}, and there are {}", i, largest, m.points.size()),
         "points are counted from 0"});
    break;
  }
  const auto one_a_point = [&](std::string_view field, std::size_t size) {
    if (size != 0 && size != m.points.size())
      problems.push_back({field,
                          fmt::format("'{}' holds {}, and there are {} points", field, size, m.points.size()),
                          "give one for each point, in their order"});
  };
  one_a_point("normals", m.normals.size());
  one_a_point("uvs", m.uvs.size());
  for (const Vec3d& normal : m.normals) {
    want_direction(problems, "normals", normal);
    if (!problems.empty()) break;
  }
  return problems;
}

Problems validate(const optics::PointLight& l) {
  Problems problems;
  want_color(problems, "power", l.power);
  want_color(problems, "intensity", l.intensity);
  return problems;
}

Problems validate(const optics::SpotLight& l) {
  Problems problems;
  if (l.position == l.to)
    problems.push_back({"to", fmt::format("'to' is where the light stands, {}", text(l.to)),
                        "give a point that the light is turned to"});
  if (!(l.angle.radians > 0 && l.angle.radians < pi))
    problems.push_back({"angle", fmt::format("'angle' must be between 0deg and 180deg, found {}deg",
                                             l.angle.radians * 180 / pi)});
  if (!(l.blend >= 0 && l.blend <= 1))
    problems.push_back({"blend", fmt::format("'blend' must be from 0 to 1, found {}", l.blend)});
  want_color(problems, "power", l.power);
  want_color(problems, "intensity", l.intensity);
  return problems;
}

Problems validate(const optics::SphereLight& l) {
  Problems problems;
  want_positive(problems, "radius", l.radius, "a light without extent is a `light point`");
  want_color(problems, "power", l.power);
  want_color(problems, "radiance", l.radiance);
  return problems;
}

Problems validate(const optics::QuadLight& l) {
  Problems problems;
  want_area(problems, l.u, l.v);
  want_color(problems, "power", l.power);
  want_color(problems, "radiance", l.radiance);
  return problems;
}

Problems validate(const optics::DiskLight& l) {
  Problems problems;
  want_direction(problems, "normal", l.normal);
  want_positive(problems, "radius", l.radius, "a light without extent is a `light point`");
  want_color(problems, "power", l.power);
  want_color(problems, "radiance", l.radiance);
  return problems;
}

Problems validate(const optics::MeshLight& l) {
  Problems problems;
  want_color(problems, "power", l.power);
  want_color(problems, "radiance", l.radiance);
  return problems;
}

Problems validate(const optics::DistantLight& l) {
  Problems problems;
  want_direction(problems, "direction", l.direction);
  want_color(problems, "irradiance", l.irradiance);
  if (!(l.angle.radians >= 0 && l.angle.radians < pi))
    problems.push_back({"angle", fmt::format("'angle' must be from 0deg to below 180deg, found {}deg",
                                             l.angle.radians * 180 / pi)});
  return problems;
}

Problems validate(const optics::EnvironmentLight& l) {
  Problems problems;
  want_color(problems, "radiance", l.radiance.color);
  return problems;
}

}  // namespace tyndall::scene
