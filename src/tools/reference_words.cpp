// The words of the language that no table of the code explains.
#include "tools/reference.h"

#include <algorithm>
#include <iterator>

namespace tyndall::tools {

namespace {

constexpr ReferenceWord words[] = {
    {"let", "names a value", "let size = 1.5"},
    {"var", "names a value that may be set again", "var n = 0  n = n + 1"},
    {"def", "defines a function, or a template that places things", "def wave(x) = 0.3 * sin(2 * x)"},
    {"return", "gives the value of a function with statements", "def f(x) = { let y = x * x  return y + 1 }"},
    {"medium", "defines what fills a volume", "medium fog(amount = 1) { density = amount * fbm(p) }"},
    {"material", "defines what a surface is", "material red() { base_color = (1, 0, 0) }"},
    {"object", "defines things that are kept once and placed many times", "object tree(seed) { sphere {} }"},
    {"place", "places an object", "place tree(seed: 1) { transform: translate((1, 0, 0)) }"},
    {"include", "reads the definitions of another file", "include \"lamps.tyn\""},
    {"if", "chooses: statements, or values with then and else",
     "if n > 1 { sphere {} } else { box { min: (0, 0, 0)  max: (1, 1, 1) } }"},
    {"then", "in a choice of values", "let a = if n > 1 then 2 else 3"},
    {"else", "the other branch of `if`", "let a = if n > 1 then 2 else 3"},
    {"for", "repeats statements, or makes a list", "let squares = [i * i for i in 0..<10]"},
    {"in", "what `for` goes over; as a parameter, the shape that a volume or light has",
     "for i in 0..<3 { sphere {} }"},
    {"and", "true if both are", "a > 1 and b > 1"},
    {"or", "true if one is", "a > 1 or b > 1"},
    {"not", "true if the other is false", "not (a > 1)"},
    {"true", "a boolean", "visible: true"},
    {"false", "a boolean", "visible: false"},
    {"time", "seconds since frame 0; in bodies, as the shutter goes", "rotate_y(90deg * time)"},
    {"frame", "the number of the frame", "\"smoke.{frame:04}.vdb\""},
    {"pi", "3.14159…", "sin(2 * pi * x)"},
    {"p", "in bodies: the position in the space of the volume or shape, a vec", "density = fbm(p * 2)"},
    {"P", "in bodies: the position in the world, a vec", "density = exp(-P.y)"},
    {"n", "in materials: the unit normal in the space of the shape", "normal = n + 0.2 * curl(p * 9)"},
    {"N", "in materials: the unit normal in the world",
     "base_color = if N.y > 0.7 then #ffffff else #604020"},
    {"uv", "in materials: where on the shape, a pair; each shape says how it lies",
     "base_color = picture(uv)"},
};

// Functions that are pictures.
constexpr std::string_view pictured[] = {
    "noise",     "fbm",    "turbulence", "ridged",       "cells",        "worley",          "curl",
    "vnoise",    "warp",   "noise01",    "fbm01",        "turbulence01", "ridged01",        "checker",
    "sd_sphere", "sd_box", "sd_torus",   "sd_capsule",   "sd_cylinder",  "sd_cone",         "sd_ellipsoid",
    "sd_plane",  "sky",    "hsv",        "smooth_union", "smooth_max",   "smooth_subtract", "blackbody"};

}  // namespace

std::string picture_of(const ReferenceFunction& function) {
  return std::find(std::begin(pictured), std::end(pictured), function.name) == std::end(pictured)
             ? std::string{}
             : "docs/images/built-ins/" + function.name + ".png";
}

std::span<const ReferenceWord> reference_words() { return words; }

}  // namespace tyndall::tools
