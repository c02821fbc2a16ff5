// Functions and names of other programs, as they stand in expressions.
#include "syntax/foreign_tables.h"

namespace tyndall::syntax {

namespace {

constexpr std::string_view color = "a colour is (r, g, b), linear, or #ff8800";
constexpr std::string_view vec = "a vec is written (x, y, z), a pair (x, y)";
constexpr std::string_view noise = "write noise(p), or fbm(p, octaves: 5) with finer detail";
constexpr std::string_view fbm = "write fbm(p, octaves: 5)";
constexpr std::string_view cells = "write cells(p)";
constexpr std::string_view phase = "write hg(0.8), or droplets(0.02mm) for fog and clouds";
constexpr std::string_view mix = "write mix(a, b, w)";
constexpr std::string_view remap = "write remap(x, from_low, from_high, to_low, to_high)";
constexpr std::string_view sign = "write sign(x)";
constexpr std::string_view round = "write round(x)";
constexpr std::string_view random = "write random(i): the same for the same arguments, there is no state";
constexpr std::string_view smooth_union = "write smooth_union(a, b, width)";
constexpr std::string_view blackbody = "write blackbody(3200K)";
constexpr std::string_view image = "write image(\"wood.png\"), looked up as wood(uv)";
constexpr std::string_view keys = "write keys(x, [0, a], [1, b])";
constexpr std::string_view range = "write 0..<n";
constexpr std::string_view turn = "write rotate((x, y, z), angle), or rotate_y(angle)";
constexpr std::string_view log = "write log(x), divided by log of the base";

constexpr ForeignWord values[] = {
    // colours and vectors
    {"rgb", color},
    {"srgb", color},
    {"rgba", color},
    {"rgbf", color},
    {"rgbt", color},
    {"rgbft", color},
    {"hsv", color},
    {"hsl", color},
    {"color", color},
    {"colour", color},
    {"Color", color},
    {"red", "write #f00, or (1, 0, 0)"},
    {"green", "write #0f0, or (0, 1, 0)"},
    {"blue", "write #00f, or (0, 0, 1)"},
    {"white", "write #fff, or 1"},
    {"black", "write #000, or 0"},
    {"gray", "write #808080, or 0.2"},
    {"grey", "write #808080, or 0.2"},
    {"yellow", "write #ff0, or (1, 1, 0)"},
    {"orange", "write #ff8000"},
    {"brown", "write #804020"},
    {"purple", "write #800080"},
    {"pink", "write #ffc0cb"},
    {"cyan", "write #0ff, or (0, 1, 1)"},
    {"magenta", "write #f0f, or (1, 0, 1)"},
    {"vec", vec},
    {"vec2", vec},
    {"vec3", vec},
    {"Vec3", vec},
    {"float3", vec},
    {"vector", vec},
    {"Vector", vec},
    {"point", vec},
    // noises
    {"perlin", noise},
    {"simplex", noise},
    {"snoise", noise},
    {"pnoise", noise},
    {"gnoise", noise},
    {"bozo", noise},
    {"f_noise3d", noise},
    {"fractal", fbm},
    {"fBm", fbm},
    {"fBM", fbm},
    {"musgrave", fbm},
    {"granite", fbm},
    {"wrinkles", "write turbulence(p)"},
    {"ridged_mf", "write ridged(p)"},
    {"worley", cells},
    {"voronoi", cells},
    {"cellular", cells},
    {"crackle", cells},
    {"cellnoise", cells},
    {"curl_noise", "write curl(p)"},
    {"curlnoise", "write curl(p)"},
    // phase functions
    {"mie", phase},
    {"Mie", phase},
    {"henyey_greenstein", phase},
    {"HenyeyGreenstein", phase},
    {"schlick", phase},
    // numbers
    {"lerp", mix},
    {"blend", mix},
    {"clamp01", "write saturate(x)"},
    {"clip", "write clamp(x, low, high)"},
    {"linstep", "write clamp(remap(x, a, b, 0, 1), 0, 1)"},
    {"linearstep", "write clamp(remap(x, a, b, 0, 1), 0, 1)"},
    {"smootherstep", "write smoothstep(from, to, x)"},
    {"inverse_lerp", remap},
    {"map_range", remap},
    {"fit", remap},
    {"sgn", sign},
    {"rint", round},
    {"trunc", "write floor(x)"},
    {"int", "write floor(x)"},
    {"rand", random},
    {"rnd", random},
    {"seed", random},
    {"function", "write def f(x) = value"},
    {"hash", random},
    {"drand48", random},
    {"uniform", random},
    {"radians", "write x * 1deg: an angle has a unit"},
    {"deg2rad", "write x * 1deg: an angle has a unit"},
    {"degrees", "write x / 1deg: an angle in degrees"},
    {"rad2deg", "write x / 1deg: an angle in degrees"},
    {"ln", "write log(x)"},
    {"log2", log},
    {"log10", log},
    {"exp2", "write 2^x"},
    {"sqr", "write x^2"},
    {"square", "write x^2"},
    {"rsqrt", "write 1 / sqrt(x)"},
    {"cbrt", "write x^(1 / 3)"},
    {"tau", "write 2 * pi"},
    {"modulo", "write mod(a, b)"},
    {"arcsin", "write asin(x)"},
    {"arccos", "write acos(x)"},
    {"arctan", "write atan(x), or atan2(y, x)"},
    {"len", "write length(l)"},
    {"vlength", "write length(v)"},
    {"magnitude", "write length(v)"},
    {"norm", "write length(v), or normalize(v)"},
    {"vnormalize", "write normalize(v)"},
    {"vdot", "write dot(a, b)"},
    {"vcross", "write cross(a, b)"},
    {"vrotate", "write rotate_y(p, angle)"},
    {"None", "there is no empty value: leave the parameter out"},
    {"null", "there is no empty value: leave the parameter out"},
    {"True", "write true"},
    {"False", "write false"},
    {"clock", "write time, in seconds, or frame"},
    {"range", range},
    {"xrange", range},
    {"arange", range},
    {"linspace", range},
    {"str", "write \"{x}\": braces in a string hold a value"},
    {"format", "write \"{x}\": braces in a string hold a value"},
    // shapes and looks
    {"smin", smooth_union},
    {"smoothmin", smooth_union},
    {"smooth_min", smooth_union},
    {"opSmoothUnion", smooth_union},
    {"union", "write min(a, b) of distances"},
    {"intersection", "write max(a, b) of distances"},
    {"difference", "write max(a, -b) of distances"},
    {"kelvin", blackbody},
    {"planck", blackbody},
    {"temperature", blackbody},
    {"texture", image},
    {"image_map", image},
    {"imagemap", image},
    {"checkerboard", "write checker(uv)"},
    {"spline", keys},
    {"gradient", keys},
    {"color_ramp", keys},
    {"ramp", keys},
    {"colormap", keys},
    {"rotation", turn},
    {"quaternion", turn},
    {"euler", turn},
    {"translation", "write translate((x, y, z))"},
    {"print", "nothing is printed: `tyndall inspect` shows what a scene became"},
};

}  // namespace

std::span<const ForeignWord> foreign_values() { return values; }

}  // namespace tyndall::syntax
