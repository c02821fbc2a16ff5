#include "syntax/foreign_words.h"

#include <algorithm>
#include <iterator>

namespace tyndall::syntax {

std::string_view help_for_foreign_word(std::string_view word) {
  struct Row {
    std::string_view word, help;
  };
  static constexpr std::string_view no_cutting =
      "solids are not cut from each other: shapes stand side by side, or a "
      "medium's density is cut by a function";
  static constexpr std::string_view material = "write material: { base_color = … } in the shape";
  static constexpr std::string_view look = "write camera perspective { from: … to: … fov: … }";
  static constexpr std::string_view volume =
      "write volume { in: sphere { … } medium: { density = … albedo = … } }";
  static constexpr std::string_view nothing_to_begin = "leave it out: the whole file is the scene";
  static constexpr std::string_view transform =
      "write transform: translate(…) in the thing, or in a group { … } around";
  static constexpr Row rows[] = {
      // POV-Ray
      {"light_source", "write light point { position: … power: … }"},
      {"area_light", "write light quad { … } or light sphere { … }"},
      {"union", "write group { … }"},
      {"merge", "write group { … }"},
      {"difference", no_cutting},
      {"intersection", no_cutting},
      {"global_settings", "write render { … }"},
      {"background", "write light environment { radiance: … }"},
      {"sky_sphere", "write light environment { radiance: … }"},
      {"texture", material},
      {"pigment", material},
      {"finish", material},
      {"media", volume},
      {"interior", volume},
      {"fog", volume},
      {"triangle", "write mesh { points: [ … ] triangles: [ … ] }"},
      {"mesh2", "write mesh { points: [ … ] triangles: [ … ] }"},
      {"look_at", look},
      {"location", look},
      // PBRT
      {"LookAt", look},
      {"Camera", look},
      {"Shape", "write the shape's own name: sphere { … }, mesh { … }"},
      {"Material", material},
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
      {"Film", "write render { resolution: (width, height) }"},
      {"Sampler", "write render { samples: … }"},
      {"Integrator", "write render { bounces: … }"},
      {"ObjectBegin", "write object name { … }"},
      {"ObjectInstance", "write place name { transform: … }"},
  };
  const auto row =
      std::find_if(std::begin(rows), std::end(rows), [&](const Row& r) { return r.word == word; });
  return row == std::end(rows) ? std::string_view{} : row->help;
}

}  // namespace tyndall::syntax
