// Parameters of things and outputs of bodies as other programs call them.
#include "syntax/foreign_tables.h"

namespace tyndall::syntax {

namespace {

constexpr std::string_view center = "write center: (x, y, z)";
constexpr std::string_view position = "write position: (x, y, z)";
constexpr std::string_view from = "write from: (x, y, z)";
constexpr std::string_view to = "write to: (x, y, z)";
constexpr std::string_view moved = "write transform: translate((x, y, z))";
constexpr std::string_view turned = "write transform: rotate_y(30deg)";
constexpr std::string_view scaled = "write transform: scale((x, y, z))";
constexpr std::string_view corners = "write min: (x, y, z)  max: (x, y, z)";
constexpr std::string_view resolution = "write resolution: (width, height)";
constexpr std::string_view samples = "write samples: …";
constexpr std::string_view bounces = "write bounces: …";
constexpr std::string_view fov = "write fov: 40deg, the angle from top to bottom";
constexpr std::string_view aperture = "write aperture: …, the radius of the lens, and focus: …";
constexpr std::string_view focus = "write focus: …, the distance that is sharp";
constexpr std::string_view up = "write up: (0, 1, 0)";
constexpr std::string_view color = "write material: { base_color = … }";
constexpr std::string_view no_material =
    "a light has no material: a shape that glows is one with emission = … in its material";
constexpr std::string_view power = "write power: … in watts, times a colour";
constexpr std::string_view radiance = "write radiance: …, a number or a colour";
constexpr std::string_view irradiance = "write irradiance: …, a number or a colour";
constexpr std::string_view glow = "write material: { emission = … }";
constexpr std::string_view direction = "write direction: (x, y, z), the direction in which its light travels";
constexpr std::string_view points = "write points: [(x, y, z), …]";
constexpr std::string_view triangles = "write triangles: [(0, 1, 2), …]";
constexpr std::string_view shape = "write in: sphere { … }, or another closed shape";
constexpr std::string_view step = "write step: …";
constexpr std::string_view no_shadow =
    "leave it out: what is there has a shadow; visible: false hides it from the camera";

constexpr ForeignWord parameters[] = {
    // volumes
    {"color", "write medium: { density = …  albedo = (r, g, b) }", "medium"},
    {"anisotropy", "write medium: { …  phase = hg(0.5) }", "medium"},
    {"domain", shape, "in"},
    // where it stands; the first row whose parameter the thing has
    {"position", direction, "direction"},
    {"position", center, "center"},
    {"position", from, "from"},
    {"position", moved, "transform"},
    {"location", center, "center"},
    {"location", position, "position"},
    {"location", from, "from"},
    {"location", moved, "transform"},
    {"pos", center, "center"},
    {"pos", position, "position"},
    {"pos", from, "from"},
    {"pos", moved, "transform"},
    {"origin", center, "center"},
    {"origin", position, "position"},
    {"origin", from, "from"},
    {"at", center, "center"},
    {"at", position, "position"},
    {"at", moved, "transform"},
    {"center", position, "position"},
    {"center", corners, "min"},
    {"center", moved, "transform"},
    {"eye", from, "from"},
    {"look_at", to, "to"},
    {"lookat", to, "to"},
    {"target", to, "to"},
    {"look", to, "to"},
    {"point_at", to, "to"},
    {"translate", moved, "transform"},
    {"translation", moved, "transform"},
    {"rotate", turned, "transform"},
    {"rotation", to, "to"},
    {"rotation", turned, "transform"},
    {"scale", scaled, "transform"},
    {"matrix", "write transform: matrix(x, y, z, origin)", "transform"},
    {"to_world", "write transform: …", "transform"},
    // how large it is
    {"r", "write radius: …", "radius"},
    {"diameter", "write radius: …, half of it", "radius"},
    {"width", resolution, "resolution"},
    {"height", resolution, "resolution"},
    {"size", corners, "min"},
    {"size", resolution, "resolution"},
    {"size", "write radius: …", "radius"},
    {"size", "write u: … v: …, its two half edges", "u"},
    {"size", scaled, "transform"},
    {"lower", corners, "min"},
    {"upper", corners, "max"},
    {"vertices", points, "points"},
    {"P", points, "points"},
    {"faces", triangles, "triangles"},
    {"indices", triangles, "triangles"},
    {"face_indices", triangles, "triangles"},
    {"uv", "write uvs: [(u, v), …]", "uvs"},
    // cameras and settings
    {"angle", fov, "fov"},
    {"fovy", fov, "fov"},
    {"field_of_view", fov, "fov"},
    {"focal_length", fov, "fov"},
    {"zoom", fov, "fov"},
    {"lens", fov, "fov"},
    {"lens_radius", aperture, "aperture"},
    {"lensradius", aperture, "aperture"},
    {"fstop", aperture, "aperture"},
    {"f_stop", aperture, "aperture"},
    {"focal_distance", focus, "focus"},
    {"focaldistance", focus, "focus"},
    {"focus_distance", focus, "focus"},
    {"focal_point", focus, "focus"},
    {"sky", up, "up"},
    {"iso", "write exposure: …, in stops", "exposure"},
    {"spp", samples, "samples"},
    {"pixelsamples", samples, "samples"},
    {"samples_per_pixel", samples, "samples"},
    {"max_depth", bounces, "bounces"},
    {"maxdepth", bounces, "bounces"},
    {"depth", bounces, "bounces"},
    {"max_bounces", bounces, "bounces"},
    {"max_trace_level", bounces, "bounces"},
    {"xresolution", resolution, "resolution"},
    {"yresolution", resolution, "resolution"},
    {"step_size", step, "step"},
    {"stepsize", step, "step"},
    {"frame_rate", "write fps: …", "fps"},
    {"length", "write frames: 1..48", "frames"},
    // looks
    {"color", color, "material"},
    {"colour", color, "material"},
    {"pigment", color, "material"},
    {"texture", color, "material"},
    {"diffuse", color, "material"},
    {"reflectance", color, "material"},
    {"albedo", color, "material"},
    {"shader", color, "material"},
    {"bsdf", color, "material"},
    {"emissive", glow, "material"},
    {"no_shadow", no_shadow, "visible"},
    {"hollow", "leave it out: what fills a shape is a volume { … } of its own", "material"},
    // lights
    {"color", power, "power"},
    {"color", radiance, "radiance"},
    {"color", irradiance, "irradiance"},
    {"colour", power, "power"},
    {"colour", radiance, "radiance"},
    {"colour", irradiance, "irradiance"},
    {"intensity", power, "power"},
    {"intensity", radiance, "radiance"},
    {"intensity", irradiance, "irradiance"},
    {"strength", power, "power"},
    {"strength", radiance, "radiance"},
    {"strength", irradiance, "irradiance"},
    {"brightness", power, "power"},
    {"brightness", radiance, "radiance"},
    {"brightness", irradiance, "irradiance"},
    {"energy", power, "power"},
    {"energy", radiance, "radiance"},
    {"energy", irradiance, "irradiance"},
    {"power", radiance, "radiance"},
    {"power", irradiance, "irradiance"},
    {"radiance", power, "power"},
    {"radiance", irradiance, "irradiance"},
    {"emission", power, "power"},
    {"emission", radiance, "radiance"},
    {"L", radiance, "radiance"},
    {"L", irradiance, "irradiance"},
    {"I", power, "power"},
    {"map", "write radiance: image(\"sky.hdr\")", "radiance"},
    {"file", "write radiance: image(\"sky.hdr\")", "radiance"},
    {"to", direction, "direction"},
    {"from", direction, "direction"},
    {"falloff", "write angle: … blend: …, the part of it that fades", "blend"},
    {"tightness", "write angle: … blend: …, the part of it that fades", "blend"},
    {"material", no_material, "power"},
    {"material", no_material, "radiance"},
    // volumes
    {"shape", shape, "in"},
    {"container", shape, "in"},
    {"bounds", shape, "in"},
    {"media", "write medium: { density = … albedo = … }", "medium"},
    {"interior", "write medium: { density = … albedo = … }", "medium"},
    {"contents", "write medium: { density = … albedo = … }", "medium"},
};

constexpr std::string_view base_color = "write base_color = …";
constexpr std::string_view phase = "write phase = hg(0.5), the mean cosine in its parentheses";
constexpr ForeignWord outputs[] = {
    // media
    {"g", phase},
    {"anisotropy", phase},
    {"eccentricity", phase},
    {"sigma_s", "write scattering = … per metre"},
    {"sigma_a", "write absorption = … per metre"},
    {"sigma_t", "write extinction = … per metre, with albedo = …"},
    {"Le", "write emission = …"},
    {"temperature", "write emission = blackbody(1500K), times how bright it is"},
    {"thickness", "write density = …, or extinction = …"},
    // materials
    {"color", base_color},
    {"colour", base_color},
    {"diffuse", base_color},
    {"reflectance", base_color},
    {"pigment", base_color},
    {"kd", base_color},
    {"Kd", base_color},
    {"rgb", base_color},
    {"reflection", "write metallic = 1, with roughness = …"},
    {"mirror", "write metallic = 1  roughness = 0"},
    {"metalness", "write metallic = …"},
    {"metal", "write metallic = …"},
    {"shininess", "write roughness = …, 0 for a mirror"},
    {"glossiness", "write roughness = …, one minus it"},
    {"smoothness", "write roughness = …, one minus it"},
    {"eta", "write ior = …"},
    {"index_of_refraction", "write ior = …"},
    {"refraction", "write transmission = 1  ior = …"},
    {"transparency", "write transmission = … for glass, or opacity = … for holes"},
    {"transmit", "write transmission = … for glass, or opacity = … for holes"},
    {"filter", "write transmission = … for glass, or opacity = … for holes"},
    {"alpha", "write opacity = …"},
    {"glass", "write transmission = 1  ior = 1.5"},
    {"emissive", "write emission = …"},
    {"glow", "write emission = …"},
    {"ambient", "leave it out: light comes from lights, from light environment { … } too"},
    {"bump", "write normal = n + 0.2 * curl(p * 9)"},
    {"clearcoat", "write coat = …"},
};

}  // namespace

std::span<const ForeignWord> foreign_parameters() { return parameters; }
std::span<const ForeignWord> foreign_outputs() { return outputs; }

}  // namespace tyndall::syntax
