// The rows of the table of built-ins.
#include "vm/builtins.h"

#include <algorithm>
#include <array>

namespace tyndall::vm {

namespace {

using enum Shape;
using Parameters = std::vector<BuiltinParameter>;

constexpr std::string_view numbers = "number|pair|vec";
constexpr std::string_view quantities = "number|angle|pair|vec";

Builtin row(std::string_view name, Shape shape, Op op, Parameters parameters, std::string_view result,
            std::string_view documentation, std::string_view example) {
  return {name, shape, op, std::move(parameters), result, documentation, example, true};
}
Builtin other(std::string_view name, Parameters parameters, std::string_view result,
              std::string_view documentation, std::string_view example) {
  return row(name, custom, Op::copy, std::move(parameters), result, documentation, example);
}
Builtin scene_only(std::string_view name, Parameters parameters, std::string_view documentation,
                   std::string_view example) {
  Builtin builtin = other(name, std::move(parameters), "transform", documentation, example);
  builtin.in_bodies = false;
  return builtin;
}

void add_arithmetic(std::vector<Builtin>& rows) {
  rows.insert(
      rows.end(),
      {
          row("abs", componentwise, Op::abs, {{"x", quantities, ""}}, "as x",
              "The size of x without its sign.", "abs(-2)"),
          row("floor", componentwise, Op::floor, {{"x", numbers, ""}}, "as x",
              "The largest whole number that is not above x.", "floor(2.7)"),
          row("ceil", componentwise, Op::ceil, {{"x", numbers, ""}}, "as x",
              "The smallest whole number that is not below x.", "ceil(2.2)"),
          row("fract", componentwise, Op::fract, {{"x", numbers, ""}}, "as x", "x - floor(x), in [0, 1).",
              "fract(2.7)"),
          row("mod", componentwise, Op::mod, {{"a", quantities, ""}, {"b", quantities, ""}}, "as the wider",
              "The remainder of a / b, with the sign of b: in [0, b).", "mod(-1, 3)"),
          row("min", componentwise, Op::min, {{"a", quantities, ""}, {"b", quantities, ""}}, "as the wider",
              "The smaller of two.", "min(1, 2)"),
          row("max", componentwise, Op::max, {{"a", quantities, ""}, {"b", quantities, ""}}, "as the wider",
              "The larger of two.", "max(1, 2)"),
          row("clamp", componentwise, Op::clamp,
              {{"x", quantities, ""}, {"low", quantities, ""}, {"high", quantities, ""}}, "as the widest",
              "x, or the nearer of the two limits when it lies outside.", "clamp(1.5, 0, 1)"),
          row("mix", componentwise, Op::mix,
              {{"a", "number|angle|pair|vec|phase", ""}, {"b", "as a", ""}, {"w", numbers, ""}},
              "as the widest",
              "a + (b - a) w: a at 0, b at 1. Of phase functions: a mixture with the share w of b.",
              "mix(10, 20, 0.25)"),
          row("step", componentwise, Op::step, {{"edge", numbers, ""}, {"x", numbers, ""}}, "as the wider",
              "0 below the edge, 1 from it on.", "step(0.5, 0.7)"),
          row("smoothstep", componentwise, Op::smoothstep,
              {{"from", numbers, ""}, {"to", numbers, ""}, {"x", numbers, ""}}, "as the widest",
              "0 before `from`, 1 after `to`, smooth (3t^2 - 2t^3) between. The edges may fall.",
              "smoothstep(1, 0.4, 0.6)"),
          row("sqrt", componentwise, Op::sqrt, {{"x", numbers, ""}}, "as x", "The square root of x >= 0.",
              "sqrt(2)"),
          row("pow", componentwise, Op::pow, {{"x", numbers, ""}, {"y", numbers, ""}}, "as the wider",
              "x to the power y, as x ^ y. A negative x takes whole y only.", "pow(2, 0.5)"),
          row("exp", componentwise, Op::exp, {{"x", numbers, ""}}, "as x", "e to the power x.", "exp(-1)"),
          row("log", componentwise, Op::log, {{"x", numbers, ""}}, "as x", "The natural logarithm of x > 0.",
              "log(10)"),
      });
}

void add_angles(std::vector<Builtin>& rows) {
  const auto sine = [](std::string_view name, Op op, std::string_view documentation,
                       std::string_view example) {
    return row(name, angle_to_number, op, {{"angle", "angle|number", ""}}, "number", documentation, example);
  };
  rows.insert(
      rows.end(),
      {
          sine("sin", Op::sin, "The sine of an angle, or of a computed number, in radians.", "sin(30deg)"),
          sine("cos", Op::cos, "The cosine of an angle, or of a computed number, in radians.", "cos(60deg)"),
          sine("tan", Op::tan, "The tangent of an angle, or of a computed number, in radians.", "tan(45deg)"),
          row("asin", number_to_angle, Op::asin, {{"x", "number", ""}}, "angle",
              "The angle in [-90deg, 90deg] whose sine is x, for x in [-1, 1].", "asin(0.5)"),
          row("acos", number_to_angle, Op::acos, {{"x", "number", ""}}, "angle",
              "The angle in [0deg, 180deg] whose cosine is x, for x in [-1, 1].", "acos(0.5)"),
          row("atan", number_to_angle, Op::atan, {{"x", "number", ""}}, "angle",
              "The angle in (-90deg, 90deg) whose tangent is x.", "atan(1)"),
          row("atan2", number_to_angle, Op::atan2, {{"y", "number", ""}, {"x", "number", ""}}, "angle",
              "The angle in [-180deg, 180deg] of the point (x, y), from the x axis.", "atan2(1, -1)"),
      });
}

void add_vectors(std::vector<Builtin>& rows) {
  rows.insert(
      rows.end(),
      {
          row("length", Shape::length, Op::length3, {{"v", "pair|vec|list", ""}}, "number",
              "The length of a vector, or the number of a list's entries.", "length((1, 2, 2))"),
          other("distance", {{"a", "pair|vec", ""}, {"b", "as a", ""}}, "number",
                "The distance of two points.", "distance((1, 0, 0), (0, 0, 0))"),
          other("dot", {{"a", "pair|vec", ""}, {"b", "as a", ""}}, "number", "The scalar product.",
                "dot((1, 2, 3), (0, 1, 0))"),
          other("cross", {{"a", "vec", ""}, {"b", "vec", ""}}, "vec", "The vector product, right-handed.",
                "cross((1, 0, 0), (0, 1, 0))"),
          other("normalize", {{"v", "pair|vec", ""}}, "as v", "v at length 1; v must not be zero.",
                "normalize((3, 0, 4))"),
          other("reflect", {{"v", "vec", ""}, {"n", "vec", ""}}, "vec",
                "The direction v mirrored at a plane with the unit normal n.",
                "reflect((1, -1, 0), (0, 1, 0))"),
          other("remap",
                {{"x", numbers, ""},
                 {"from_low", numbers, ""},
                 {"from_high", numbers, ""},
                 {"to_low", numbers, ""},
                 {"to_high", numbers, ""}},
                "as the widest", "x carried linearly from one range to the other, without limits.",
                "remap(5, 0, 10, 20, 40)"),
          other("luminance", {{"color", "vec", ""}}, "number", "Rec. 709 luminance of a linear colour.",
                "luminance((1, 0.5, 0.2))"),
          other("blackbody", {{"temperature", "number", ""}}, "vec",
                "The colour of a black body, linear, with luminance 1; in kelvin, from 500K on.",
                "blackbody(3200K)"),
          row("checker", custom, Op::checker, {{"p", "pair", ""}}, "bool",
              "True on every second square of side 1.", "checker((0.5, 1.5))"),
          other("random", {{"values", "number|pair|vec, any number of them", ""}}, "number",
                "A pure hash of the arguments, in [0, 1): the same for the same arguments.", "random(1, 2)"),
          other("keys",
                {{"x", "number", ""},
                 {"points", "lists [x, value], in order", ""},
                 {"ease", "linear|smooth|hold", "linear", true}},
                "as the values",
                "Interpolates between the given points: numbers, angles, pairs, vecs, colours or transforms.",
                "keys(0.5, [0, 10], [1, 20])"),
      });
}

void add_fields(std::vector<Builtin>& rows) {
  constexpr bool named = true;
  const Parameters one = {{"p", "vec", ""}, {"time", "number", "", named}, {"seed", "number", "0", named}};
  const Parameters many = {{"p", "vec", ""},
                           {"time", "number", "", named},
                           {"octaves", "number", "5", named},
                           {"seed", "number", "0", named}};
  rows.insert(
      rows.end(),
      {
          row("noise", field, Op::noise3, one, "number",
              "Gradient noise with features of size 1: zero mean, within [-1.04, 1.04]. With a time it "
              "changes in place.",
              "noise((0.3, 1.2, 5))"),
          row("fbm", field, Op::fbm3, many, "number",
              "Octaves of noise, each twice as fine and half as strong, divided by their sum: zero mean, "
              "about -1 to 1.",
              "fbm((0.3, 1.2, 5), octaves: 4)"),
          row("turbulence", field, Op::turbulence3, many, "number",
              "Octaves of |noise|, shifted and scaled to zero mean: from -0.3 in the creases to about 1.",
              "turbulence((0.3, 1.2, 5), octaves: 4)"),
          row("ridged", field, Op::ridged3, many, "number",
              "Octaves of (1 - |noise|)^2, shifted and scaled to zero mean: from about -1 to 0.6 on the "
              "ridges.",
              "ridged((0.3, 1.2, 5), octaves: 4)"),
          row("cells", field, Op::cells3, one, "number",
              "Distance to the nearest of scattered points, about one to a unit of volume, shifted and "
              "scaled to zero mean: "
              "-1 at a point, at most 0.93 (0.7 with a time).",
              "cells((0.3, 1.2, 5))"),
          row("curl", vector_field, Op::curl3_x, one, "vec",
              "A flow without sources, made from noise: zero mean, components about -1 to 1.",
              "curl((0.3, 1.2, 5))"),
      });
}

void add_distances(std::vector<Builtin>& rows) {
  rows.insert(
      rows.end(),
      {
          other("sd_sphere", {{"p", "vec", ""}, {"radius", "number", ""}}, "number",
                "Distance of p to a sphere around the origin; negative inside.", "sd_sphere((1, 1, 1), 1)"),
          other("sd_box", {{"p", "vec", ""}, {"half", "number|vec", ""}}, "number",
                "Distance of p to a box around the origin with the given half edges; negative inside.",
                "sd_box((1, 1, 1), (0.5, 0.2, 0.5))"),
          other("sd_torus", {{"p", "vec", ""}, {"radius", "number", ""}, {"tube", "number", ""}}, "number",
                "Distance of p to a ring around the y axis with a tube of the given radius; negative inside.",
                "sd_torus((1, 0, 1), 1, 0.2)"),
          other("sd_capsule",
                {{"p", "vec", ""}, {"from", "vec", ""}, {"to", "vec", ""}, {"radius", "number", ""}},
                "number", "Distance of p to a rod with round ends; negative inside.",
                "sd_capsule((1, 0, 1), (0, 0, 0), (0, 1, 0), 0.2)"),
          other("smooth_union", {{"a", "number", ""}, {"b", "number", ""}, {"width", "number", ""}}, "number",
                "The smaller of two distances, rounded where they differ by less than `width`.",
                "smooth_union(0.2, 0.3, 0.1)"),
      });
}

void add_transforms(std::vector<Builtin>& rows) {
  const auto turn = [](std::string_view name, std::string_view documentation, std::string_view example) {
    return other(name, {{"p", "vec", ""}, {"angle", "angle", ""}}, "transform|vec", documentation, example);
  };
  rows.insert(
      rows.end(),
      {
          turn("rotate_x",
               "Turns about the x axis, counter-clockwise seen from its tip: a point, or as a transform.",
               "rotate_x(90deg)"),
          turn("rotate_y",
               "Turns about the y axis, counter-clockwise seen from its tip: a point, or as a transform.",
               "rotate_y((1, 0, 0), 90deg)"),
          turn("rotate_z",
               "Turns about the z axis, counter-clockwise seen from its tip: a point, or as a transform.",
               "rotate_z(90deg)"),
          scene_only("rotate", {{"axis", "vec", ""}, {"angle", "angle", ""}},
                     "Turns about any axis through the origin, counter-clockwise seen from its tip.",
                     "rotate((1, 1, 0), 30deg)"),
          scene_only("translate", {{"offset", "vec", ""}}, "Moves by the offset.", "translate((0, 1, 0))"),
          scene_only("scale", {{"factors", "number|vec", ""}}, "Scales about the origin, along the axes.",
                     "scale((1, 2, 1))"),
          scene_only("look_at", {{"from", "vec", ""}, {"to", "vec", ""}, {"up", "vec", "(0, 1, 0)"}},
                     "The space that stands at `from` and whose -z axis points to `to`.",
                     "look_at((0, 1, 6), (0, 1, 0))"),
          scene_only("matrix",
                     {{"x", "vec", ""}, {"y", "vec", ""}, {"z", "vec", ""}, {"origin", "vec", "(0, 0, 0)"}},
                     "The images of the three axes and of the origin.",
                     "matrix((1, 0, 0), (0.5, 1, 0), (0, 0, 1))"),
          other("direction", {{"t", "transform", ""}, {"v", "vec", ""}}, "vec",
                "The direction v after the transform: turned and scaled, not moved.",
                "direction(rotate_y(90deg), (1, 0, 0))"),
      });
}

void add_files(std::vector<Builtin>& rows) {
  Builtin image =
      other("image", {{"file", "string", ""}, {"channel", "string", "\"\""}}, "image",
            "A picture, looked up as image(uv): (0, 0) is its lower left corner, (1, 1) its upper "
            "right one, and it repeats. Gives a colour, or a number for one named channel.",
            "image(\"wood.exr\")");
  image.in_bodies = false;
  rows.push_back(std::move(image));
}

std::vector<Builtin> make_rows() {
  std::vector<Builtin> rows;
  for (const auto add :
       {add_arithmetic, add_angles, add_vectors, add_fields, add_distances, add_transforms, add_files})
    add(rows);
  std::sort(rows.begin(), rows.end(), [](const Builtin& a, const Builtin& b) { return a.name < b.name; });
  return rows;
}

}  // namespace

std::span<const Builtin> builtins() {
  static const std::vector<Builtin> rows = make_rows();
  return rows;
}

const Builtin* find_builtin(std::string_view name) {
  const std::span<const Builtin> rows = builtins();
  const auto found = std::lower_bound(rows.begin(), rows.end(), name,
                                      [](const Builtin& a, std::string_view b) { return a.name < b; });
  return found != rows.end() && found->name == name ? &*found : nullptr;
}

}  // namespace tyndall::vm
