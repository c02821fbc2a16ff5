// Range checks of scene things: see validate.h.
#include "scene/validate.h"

#include <fmt/format.h>

#include <concepts>

#include "base/numerics.h"

namespace tyndall::scene {

namespace {

constexpr int max_scattering_orders = 64;

void want_at_least(Problems& problems, std::string_view field, int value, int least) {
  if (value < least)
    problems.push_back({field, fmt::format("'{}' must be at least {}, found {}", field, least, value)});
}

void want_share(Problems& problems, std::string_view field, double value) {
  if (!(value >= 0 && value <= 1))
    problems.push_back({field, fmt::format("'{}' must be from 0 to 1, found {}", field, value)});
}

// What the row of a setting says of its values.
template <std::integral Whole>
void want(Problems& problems, const SettingInfo& info, Whole value) {
  if (info.range && !info.range->holds(value))
    problems.push_back({info.name, fmt::format("'{}' must be from {} to {}, found {}", info.name,
                                               info.range->least, info.range->most, value)});
}

void want(Problems& problems, const SettingInfo& info, const Resolution& size) {
  if (!info.range->holds(size.width) || !info.range->holds(size.height))
    problems.push_back(
        {info.name, fmt::format("'{}' must be from {} to {} on each side, found ({}, {})", info.name,
                                info.range->least, info.range->most, size.width, size.height)});
}

void want(Problems& problems, const SettingInfo& info, const Step& step) {
  if (step.fixed()) want_positive(problems, info.name, step.metres);
}

void want(Problems&, const SettingInfo&, const MultipleScattering&) {}

void want(Problems& problems, const SettingInfo& info, const Clamp& clamp) {
  for (const double limit : {clamp.direct, clamp.indirect}) {
    if (limit > 0) continue;
    problems.push_back({info.name, fmt::format("'{}' must be above 0, found {}", info.name, limit),
                        "`clamp: off` sets no limit"});
    return;
  }
}

void want_view(Problems& problems, const Vec3d& from, const Vec3d& to, const Vec3d& up) {
  if (from == to) {
    problems.push_back({"to", fmt::format("'to' is the position of the camera, {}", text_of(to)),
                        "give a point that the camera looks at"});
  } else if (!Transform::look_at(from, to, up)) {
    problems.push_back({"up", fmt::format("'up' {} is along the view", text_of(up)),
                        "give a direction across the view: up: (0, 0, 1) for a camera that looks down"});
  }
}

}  // namespace

Problems validate(const RenderSettings& s) {
  Problems problems;
  RenderSettings::fields([&](auto member, const SettingInfo& info) { want(problems, info, s.*member); });
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
  constexpr double whole = 2 * pi * (1 + 1e-12);
  const double opens = a.shutter.opens.radians, closes = a.shutter.closes.radians;
  constexpr double degrees = 180 / pi;
  if (opens == 0) {
    if (!(closes >= 0 && closes <= whole))
      problems.push_back(
          {"shutter", fmt::format("'shutter' must be from 0deg to 360deg, found {}deg", closes * degrees)});
  } else if (!(closes >= opens)) {
    problems.push_back({"shutter",
                        fmt::format("'shutter' closes before it opens, found ({}deg, {}deg)", opens * degrees,
                                    closes * degrees),
                        "give first when it opens, then when it closes"});
  } else if (!(closes - opens <= whole && opens >= -whole && closes <= whole)) {
    problems.push_back(
        {"shutter", fmt::format("'shutter' must be open for 360deg at most, from -360deg to 360deg, found "
                                "({}deg, {}deg)",
                                opens * degrees, closes * degrees)});
  }
  return problems;
}

Problems validate(const TrapezoidCurve& c) {
  Problems problems;
  want_share(problems, "opening", c.opening);
  want_share(problems, "closing", c.closing);
  if (problems.empty() && c.opening + c.closing > 1 + 1e-12)
    problems.push_back(
        {"closing", fmt::format("'opening' and 'closing' must be at most 1 together, found {} + {}",
                                c.opening, c.closing)});
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
    problems.push_back(
        {"to", fmt::format("'to' {} must be to the side of 'from' {}", text_of(c.to), text_of(c.from)),
         "the top of the picture is +y: turn the camera with a `transform`"});
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

}  // namespace tyndall::scene
