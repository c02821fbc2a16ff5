// Statements, kinds of lights and cameras, and units of other programs.
#include "syntax/foreign_words.h"

#include <algorithm>
#include <iterator>

#include "syntax/foreign_tables.h"

namespace tyndall::syntax {

namespace {

constexpr std::string_view material = "write material: { base_color = … } in the shape";
constexpr std::string_view look = "write camera perspective { from: … to: … fov: … }";
constexpr std::string_view volume = "write volume { in: sphere { … } medium: { density = … albedo = … } }";
constexpr std::string_view nothing_to_begin = "leave it out: the whole file is the scene";
constexpr std::string_view transform =
    "write transform: translate((x, y, z)) in the thing, or in a group { … } around";
constexpr std::string_view mesh = "write mesh { points: [ … ] triangles: [ … ] }";
constexpr std::string_view no_files =
    "meshes are not read from files: write mesh { points: [ … ] triangles: [ … ] }";
constexpr std::string_view sky = "write light environment { radiance: … }";
constexpr std::string_view clear_sky =
    "write light sky { sun: (1, 0.5, 0) }, or light environment { radiance: … }";
constexpr std::string_view sun = "write light distant { direction: … irradiance: … }";
constexpr std::string_view lamp = "write light point { position: … power: … }, or light sphere { … }";
constexpr std::string_view spot = "write light spot { position: … to: … angle: … power: … }";
constexpr std::string_view panel = "write light quad { center: … u: … v: … power: … }, or light disk { … }";
constexpr std::string_view render = "write render { resolution: (width, height) samples: … }";
constexpr std::string_view loop = "write for i in 0..<10 { … }";
constexpr std::string_view include = "write include \"file.tyn\"";
constexpr std::string_view no_printing = "write print(\"radius\", radius)";
constexpr std::string_view no_break =
    "a loop runs to its end: put what may be left out in if condition { … }";
constexpr std::string_view else_if = "write else if condition { … }";
constexpr std::string_view choice = "write if condition { … } else { … }";
constexpr std::string_view definition = "write let name = value, or def name(x) = value";
constexpr std::string_view function = "write def name(x) = value, or def name(x) = { … return value }";
constexpr std::string_view object = "write object name { … }, then place name { transform: … }";
constexpr std::string_view hills = "write heightfield { size: (x, z) height: … }";
constexpr std::string_view outline = "write prism { outline: [(x, z), …] height: … }";
constexpr std::string_view profile = "write lathe { profile: [(radius, y), …] }";
constexpr std::string_view swept = "write sweep { path: [(x, y, z), …] radius: … }";
constexpr std::string_view round_tube = "write curves { points: [ … ] radius: … }";

constexpr ForeignWord statements[] = {
    // shapes
    {"height_field", hills},
    {"terrain", hills},
    {"triangle", mesh},
    {"mesh2", mesh},
    {"trianglemesh", mesh},
    {"polygon", outline},
    {"extrude", outline},
    {"linear_extrude", outline},
    {"sor", profile},
    {"revolve", profile},
    {"rotate_extrude", profile},
    {"letters", "write text { text: \"…\" size: … depth: … }"},
    {"bicubic_patch", mesh},
    {"superellipsoid", mesh},
    {"isosurface", "its inside is a volume: cut density by the function"},
    {"blob", "its inside is a volume: join densities with smooth_union(a, b, width)"},
    {"obj", no_files},
    {"ply", no_files},
    {"stl", no_files},
    {"fbx", no_files},
    {"model", no_files},
    {"cube", "write box { min: … max: … }"},
    {"cuboid", "write box { min: … max: … }"},
    {"ball", "write sphere { center: … radius: … }"},
    {"ellipsoid", "write sphere { transform: scale((x, y, z)) }"},
    {"rectangle", "write quad { center: … u: … v: … }"},
    {"rect", "write quad { center: … u: … v: … }"},
    {"frustum", "write cone { from: … to: … radius: … tip_radius: … }"},
    {"donut", "write torus { center: … normal: … radius: … tube: … }"},
    {"circle", "write disk { center: … normal: … radius: … }"},
    {"sphere_sweep", swept},
    {"capsule", swept},
    {"tube", swept},
    {"hair", round_tube},
    {"floor", "write plane { point: (0, 0, 0) normal: (0, 1, 0) }"},
    {"ground", "write plane { point: (0, 0, 0) normal: (0, 1, 0) }"},
    // light and looks
    {"light_source", "write light point { position: … power: … }"},
    {"area_light", panel},
    {"spotlight", spot},
    {"spot_light", spot},
    {"point_light", lamp},
    {"lamp", lamp},
    {"directional_light", sun},
    {"sun", sun},
    {"sky", clear_sky},
    {"background", sky},
    {"sky_sphere", sky},
    {"environment", sky},
    {"world", sky},
    {"texture", material},
    {"pigment", material},
    {"finish", material},
    {"color", material},
    {"shader", material},
    {"bsdf", material},
    {"media", volume},
    {"interior", volume},
    {"fog", volume},
    {"smoke", volume},
    {"cloud", volume},
    {"fire", volume},
    {"atmosphere", volume},
    // putting together
    {"merge", "write union { … }"},
    {"subtract", "write difference { … }: the first shape without the others"},
    {"intersect", "write intersection { … }"},
    {"translate", transform},
    {"rotate", transform},
    {"scale", transform},
    {"transform", transform},
    {"instance", object},
    {"look_at", look},
    {"location", look},
    {"global_settings", render},
    {"settings", render},
    {"film", render},
    {"output", render},
    {"scene", nothing_to_begin},
    // steps
    {"while", loop},
    {"until", loop},
    {"do", loop},
    {"foreach", loop},
    {"repeat", loop},
    {"elif", else_if},
    {"elseif", else_if},
    {"elsif", else_if},
    {"switch", choice},
    {"case", choice},
    {"unless", choice},
    {"end", "a block ends with '}'"},
    {"endif", "a block ends with '}'"},
    {"import", include},
    {"from", include},
    {"use", include},
    {"using", include},
    {"require", include},
    {"echo", no_printing},
    {"break", no_break},
    {"continue", no_break},
    {"console", no_printing},
    {"printf", no_printing},
    {"debug", no_printing},
    {"assert", no_printing},
    {"const", definition},
    {"float", definition},
    {"int", definition},
    {"uint", definition},
    {"double", definition},
    {"half", definition},
    {"number", definition},
    {"bool", definition},
    {"boolean", definition},
    {"str", definition},
    {"string", definition},
    {"list", definition},
    {"auto", definition},
    {"static", definition},
    {"final", definition},
    {"local", definition},
    {"global", definition},
    {"uniform", definition},
    {"varying", definition},
    {"vec2", definition},
    {"vec3", definition},
    {"vec4", definition},
    {"mat3", definition},
    {"mat4", definition},
    {"vector", definition},
    {"param", definition},
    {"set", definition},
    {"define", definition},
    {"void", function},
    {"function", function},
    {"func", function},
    {"fn", function},
    {"fun", function},
    {"macro", "write def name(parameters) { … }"},
    {"class", object},
    {"struct", object},
    {"new", "leave it out: a thing is there where it is written, as in sphere { … }"},
    {"REM", "a comment begins with '//'"},
    {"rem", "a comment begins with '//'"},
    {"Rem", "a comment begins with '//'"},
    {"begin", "a block begins with '{'"},
    {"pass", "leave it out: a block may be empty"},
    // PBRT
    {"LookAt", look},
    {"Camera", look},
    {"Shape", "write the shape's own name: sphere { … }, mesh { … }"},
    {"Texture", material},
    {"Material", material},
    {"NamedMaterial", "write material: name in the shape, or in a group { … } around"},
    {"MakeNamedMaterial", "write material name() { base_color = … }"},
    {"MakeNamedMedium", "write medium name() { density = … albedo = … }"},
    {"MediumInterface", volume},
    {"LightSource", "write light point { … }, or another kind of light"},
    {"AreaLightSource", "write emission = … in the shape's material"},
    {"WorldBegin", nothing_to_begin},
    {"WorldEnd", nothing_to_begin},
    {"AttributeBegin", "write group { … }"},
    {"AttributeEnd", "a group ends with '}'"},
    {"TransformBegin", "write group { … }"},
    {"TransformEnd", "a group ends with '}'"},
    {"Translate", transform},
    {"Rotate", transform},
    {"Scale", transform},
    {"Transform", transform},
    {"ConcatTransform", transform},
    {"CoordinateSystem", "write let name = translate(…) * …, used as transform: name"},
    {"ReverseOrientation", "leave it out: the order of its points says where a face looks"},
    {"Film", "write render { resolution: (width, height) }"},
    {"PixelFilter", "leave it out: there is one filter"},
    {"ColorSpace", "leave it out: colours are linear Rec. 709"},
    {"Sampler", "write render { samples: … }"},
    {"Integrator", "write render { bounces: … }"},
    {"Accelerator", "leave it out: the renderer builds its own"},
    {"Include", include},
    {"Import", include},
    {"ObjectBegin", "write object name { … }"},
    {"ObjectEnd", "an object ends with '}'"},
    {"ObjectInstance", "write place name { transform: … }"},
};

constexpr ForeignWord lights[] = {
    {"sun", sun},
    {"sunlight", sun},
    {"directional", sun},
    {"direction", sun},
    {"parallel", sun},
    {"area", panel},
    {"rect", panel},
    {"rectangle", panel},
    {"plane", panel},
    {"panel", panel},
    {"ambient", sky},
    {"skydome", clear_sky},
    {"atmosphere", clear_sky},
    {"dome", sky},
    {"hdri", sky},
    {"hdr", sky},
    {"env", sky},
    {"envmap", sky},
    {"infinite", sky},
    {"constant", sky},
    {"hemisphere", sky},
    {"hemi", sky},
    {"world", sky},
    {"background", sky},
    {"omni", lamp},
    {"lamp", lamp},
    {"bulb", lamp},
    {"spotlight", spot},
    {"cone", spot},
    {"goniometric", spot},
    {"projection", spot},
    {"laser", spot},
    {"tube", "write light cylinder { from: … to: … radius: … power: … }"},
    {"torus", "write light mesh { in: torus { … } power: … }"},
    {"box", "write light mesh { in: box { … } power: … }"},
    {"shape", "write light mesh { in: … power: … }"},
    {"diffuse", "write light mesh { in: … power: … }"},
};

constexpr std::string_view all_around = "write camera spherical { from: … to: … }";
constexpr ForeignWord cameras[] = {
    {"pinhole", look},
    {"persp", look},
    {"thinlens", "write camera perspective { from: … to: … aperture: … focus: … }"},
    {"thin_lens", "write camera perspective { from: … to: … aperture: … focus: … }"},
    {"realistic", "write camera perspective { from: … to: … aperture: … focus: … }"},
    {"parallel", "write camera orthographic { from: … to: … }"},
    {"environment", all_around},
    {"panorama", all_around},
    {"panoramic", all_around},
    {"equirectangular", all_around},
    {"fisheye", all_around},
    {"omni", all_around},
};

constexpr std::string_view degrees = "write 30deg";
constexpr std::string_view metres = "write 3m, or 3";
constexpr std::string_view no_feet = "lengths are mm, cm, m or km: 1in is 2.54cm, 1ft is 0.3048m";
constexpr std::string_view no_unit = "leave it out: this has no unit here";
constexpr ForeignWord units[] = {
    {"d", degrees},
    {"degs", degrees},
    {"degree", degrees},
    {"degrees", degrees},
    {"radian", "write 0.5rad"},
    {"radians", "write 0.5rad"},
    {"meter", metres},
    {"meters", metres},
    {"metre", metres},
    {"metres", metres},
    {"in", no_feet},
    {"inch", no_feet},
    {"inches", no_feet},
    {"ft", no_feet},
    {"feet", no_feet},
    {"um", "write 0.001mm"},
    {"nm", "write 0.000001mm"},
    {"sec", "write 3s"},
    {"secs", "write 3s"},
    {"seconds", "write 3s"},
    {"min", "write 60s"},
    {"h", "write 3600s"},
    {"kelvin", "write 3200K"},
    {"C", "write kelvins: 20 degrees Celsius are 293K"},
    {"W", no_unit},
    {"kW", no_unit},
    {"lm", no_unit},
    {"cd", no_unit},
    {"nits", no_unit},
    {"Hz", no_unit},
    {"fps", no_unit},
    {"px", no_unit},
    {"spp", no_unit},
    {"ev", no_unit},
    {"e", "digits follow the e: write 1e3"},
    {"k", "write 1000 times it, or 1e3"},
    {"M", "write 1e6 times it"},
    {"f", "leave it out: numbers have no suffix"},
    {"F", "leave it out: numbers have no suffix"},
    {"L", "leave it out: numbers have no suffix"},
    {"u", "leave it out: numbers have no suffix"},
};

}  // namespace

std::span<const ForeignWord> foreign_words(ForeignUse use) {
  switch (use) {
    case ForeignUse::statement:
      return statements;
    case ForeignUse::value:
      return foreign_values();
    case ForeignUse::light:
      return lights;
    case ForeignUse::camera:
      return cameras;
    case ForeignUse::parameter:
      return foreign_parameters();
    case ForeignUse::output:
      return foreign_outputs();
    case ForeignUse::unit:
      return units;
    case ForeignUse::between:
      return foreign_operators();
  }
  return {};
}

std::string_view help_for_foreign_word(ForeignUse use, std::string_view word) {
  const auto rows = foreign_words(use);
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const ForeignWord& r) { return r.word == word; });
  return row == rows.end() ? std::string_view{} : row->help;
}

const ForeignWord* find_foreign_parameter(std::string_view word, std::span<const std::string_view> known) {
  for (const ForeignWord& row : foreign_words(ForeignUse::parameter))
    if (row.word == word && std::find(known.begin(), known.end(), row.needs) != known.end()) return &row;
  return nullptr;
}

}  // namespace tyndall::syntax
