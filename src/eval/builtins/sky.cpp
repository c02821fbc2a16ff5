// sky(direction, sun): the radiance of the clear sky, looked up in the picture that `light sky` shines with.
#include <fmt/format.h>

#include "base/numerics.h"
#include "eval/builtins/maker.h"
#include "optics/atmosphere.h"

namespace tyndall::eval {

using vm::Op;

namespace {

// An argument that the picture is made for; nothing after reporting that it is not known.
std::optional<Value> settled(CallSite& site, Type type, std::size_t i) {
  bool ok = true;
  const Value value = site.as(type, i, ok);
  if (!ok) return std::nullopt;
  if (value.known()) return value;
  site.ev.error(site.spans[i], fmt::format("{} must be known when the scene is read", site.what(i)),
                "one sky is computed before rendering: give it the same everywhere and for a whole frame");
  return std::nullopt;
}

struct GivenSky {
  Vec3d sun;
  std::shared_ptr<const optics::Daylight> daylight;
};

std::optional<GivenSky> given_sky(CallSite& site) {
  const std::optional<Value> sun = settled(site, Type::vec, 1);
  if (!sun) return std::nullopt;
  if (length_squared(sun->as_vec()) == 0) {
    site.ev.error(site.spans[1], "a vec of length 0 has no direction");
    return std::nullopt;
  }
  double turbidity = optics::usual_turbidity;
  if (site.given[2]) {
    const std::optional<Value> given = settled(site, Type::number, 2);
    if (!given) return std::nullopt;
    turbidity = given->as_number();
    if (!(turbidity >= optics::least_turbidity && turbidity <= optics::most_turbidity)) {
      site.ev.error(site.spans[2], fmt::format("{} must lie in [{}, {}], found {}", site.what(2),
                                               optics::least_turbidity, optics::most_turbidity, turbidity));
      return std::nullopt;
    }
  }
  const Vec3d unit = normalize(sun->as_vec());
  return GivenSky{unit, optics::daylight(std::clamp(unit.y, -1.0, 1.0), turbidity)};
}

Value sky(CallSite& site) {
  bool ok = true;
  const Value direction = site.as(Type::vec, 0, ok);
  const std::optional<GivenSky> given = given_sky(site);
  if (!ok || !given) return {};
  const Maker m = maker(site);
  const auto& d = direction.scalars;
  const Scalar length = m.length(direction);
  if (length.known() && length.value == 0)
    return site.ev.error(site.spans[0], "a vec of length 0 has no direction");
  const Scalar longitude = m.op(Op::atan2, {d[0], m.op(Op::neg, {d[2]})});
  const Scalar u = m.add(
      m.mul(m.add(longitude, Scalar{optics::azimuth_of_sun(given->sun)}), Scalar{0.5 / pi}), Scalar{0.5});
  // Half a texel inside of the poles, where the picture does not go on.
  const double edge = 0.5 / given->daylight->picture[0]->height;
  const Scalar latitude = m.op(Op::asin, {m.op(Op::clamp, {m.div(d[1], length), Scalar{-1}, Scalar{1}})});
  const Scalar v =
      m.op(Op::clamp, {m.add(m.mul(latitude, Scalar{1 / pi}), Scalar{0.5}), Scalar{edge}, Scalar{1 - edge}});
  Value result = Value::of(Type::vec, {});
  for (std::size_t i = 0; i < 3; ++i)
    result.scalars[i] = texel_at(site.ev, given->daylight->picture[i], u, v, site.span);
  return result;
}

}  // namespace

Handlers sky_handler(std::string_view name) {
  if (name == "sky") return {sky};
  return {};
}

}  // namespace tyndall::eval
