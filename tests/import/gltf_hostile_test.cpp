// Files that are not as glTF has it: each is told with its element and the reason, and nothing else happens.
#include <fmt/format.h>

#include "opened.h"
#include "support/test_folder.h"

namespace tyndall {
namespace UNNAMED {

// A file with all that an importer follows, which is sound.
GltfWriter sound() {
  GltfWriter w;
  json p = w.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0});
  p["indices"] = w.accessor(std::vector<std::uint16_t>{0, 1, 2}, "SCALAR");
  p["attributes"]["NORMAL"] = w.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  p["attributes"]["JOINTS_0"] = w.accessor(std::vector<std::uint8_t>(12, 0), "VEC4");
  p["attributes"]["WEIGHTS_0"] = w.accessor(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  p["targets"] = {{{"POSITION", w.accessor(std::vector<float>(9, 0), "VEC3")}}};
  p["material"] =
      w.add("materials", {{"name", "Paint"}, {"pbrMetallicRoughness", {{"metallicFactor", 0.5}}}});
  w.add("skins", {{"joints", {1}}});
  w.node({{"mesh", w.mesh(p)}, {"skin", 0}, {"children", {1}}});
  w.node({{"translation", {0, 1, 0}}});
  w.root["scenes"] = {{{"nodes", {0}}}};
  w.add("animations", {{"samplers",
                        {{{"input", w.accessor(std::vector<float>{0, 1}, "SCALAR")},
                          {"output", w.accessor(std::vector<float>{0, 0, 0, 1, 1, 1}, "VEC3")}}}},
                       {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}});
  return w;
}

// What is said after a change to the JSON at a place.
std::string after(const char* place, json value) {
  GltfWriter w = sound();
  w.root = w.finished();
  w.root[json::json_pointer(place)] = std::move(value);
  return problem_of(w);
}

TEST(HostileGltf, IsSoundBefore) { EXPECT_EQ(problem_of(sound()), ""); }

TEST(HostileGltf, NamesTheElementAndTheReason) {
  EXPECT_EQ(after("/nodes/0/mesh", 7), "'test.glb': nodes[0].mesh is 7, but the file has 1 meshes");
  EXPECT_EQ(after("/nodes/0/mesh", -1), "'test.glb': nodes[0].mesh must be a whole number from 0, found -1");
  EXPECT_EQ(after("/nodes/0/mesh", "door"), "'test.glb': nodes[0].mesh is no number but string");
  EXPECT_EQ(after("/nodes/0/mesh", 0.5),
            "'test.glb': nodes[0].mesh must be a whole number from 0, found 0.5");
  EXPECT_EQ(after("/nodes/1/children", {0}),
            "'test.glb': nodes[0] is below itself: its children lead back to it");
  EXPECT_EQ(after("/nodes/0/children", {1, 1}),
            "'test.glb': nodes[0].children[1] is 1, which is a child of nodes[0] already");
  EXPECT_EQ(after("/nodes/1/rotation", {0, 0, 0, 0}),
            "'test.glb': nodes[1].rotation is no rotation: all of it is 0");
  EXPECT_EQ(after("/nodes/1/scale", {1, 1}), "'test.glb': nodes[1].scale must have 3 numbers, found 2");
  EXPECT_EQ(after("/meshes/0/primitives/0/mode", 9),
            "'test.glb': meshes[0].primitives[0].mode is 9: 0 to 6 are known");
  EXPECT_EQ(after("/accessors/0/count", 4611686018427387904),
            "'test.glb': accessors[0].count must be a whole number from 0, found 4.611686018427388e+18");
  EXPECT_EQ(after("/accessors/0/count", 4503599627370496),
            "'test.glb': accessors[0] takes 4503599627370496 elements of 12 bytes from byte 0 on of "
            "bufferViews[0], which has 36");
  EXPECT_EQ(after("/accessors/0/byteOffset", 9007199254740991),
            "'test.glb': accessors[0] takes 3 elements of 12 bytes from byte 9007199254740991 on of "
            "bufferViews[0], which has 36");
  EXPECT_EQ(after("/accessors/0/componentType", 5124),
            "'test.glb': accessors[0].componentType is 5124, which is none of glTF's");
  EXPECT_EQ(after("/accessors/0/type", "VEC2"),
            "'test.glb': accessors[0].type has 2 numbers where 3 are wanted");
  EXPECT_EQ(
      after("/accessors/1/componentType", 5125),
      "'test.glb': accessors[1] takes 3 elements of 4 bytes from byte 0 on of bufferViews[1], which has 6");
  EXPECT_EQ(after("/bufferViews/0/byteStride", 4),
            "'test.glb': bufferViews[0].byteStride is 4 where elements have 12 bytes");
  EXPECT_EQ(after("/bufferViews/0/byteLength", 9007199254740991),
            "'test.glb': bufferViews[0] is bytes 0 to 9007199254740991 of buffers[0], which has 208");
  EXPECT_EQ(after("/accessors/1/componentType", 5126),
            "'test.glb': accessors[1].componentType is no type of indices");
  EXPECT_EQ(after("/buffers/0/byteLength", 99999),
            "'test.glb': buffers[0].byteLength is 99999, but there are 208 bytes");
  EXPECT_EQ(after("/skins/0/joints", {9}), "'test.glb': skins[0].joints[0] is 9, but the file has 2 nodes");
  EXPECT_EQ(after("/animations/0/samplers/0/interpolation", "CUBICSPLINE"),
            "'test.glb': animations[0].samplers[0].output holds 2 values for 2 times");
  EXPECT_EQ(after("/materials/0/pbrMetallicRoughness/metallicFactor", 2),
            "'test.glb': materials[0].pbrMetallicRoughness.metallicFactor must be in [0, 1], found 2");
  EXPECT_EQ(after("/asset/version", "1.0"), "'test.glb': asset.version is 1.0: 2.0 is read");
  EXPECT_EQ(after("/extensionsRequired", {"EXT_unknown"}),
            "'test.glb': extensionsRequired[0] is EXT_unknown, which is not supported");
}

TEST(HostileGltf, TellsOfIndicesBeyondThePoints) {
  GltfWriter w = sound();
  w.root["meshes"][0]["primitives"][0]["indices"] = w.accessor(std::vector<std::uint16_t>{0, 1, 3}, "SCALAR");
  EXPECT_EQ(problem_of(w), "'test.glb': meshes[0].primitives[0].indices names point 3 at 2, and there are 3");
}

TEST(HostileGltf, TellsOfNumbersThatAreNone) {
  for (const float bad : {NAN, INFINITY}) {
    GltfWriter w = sound();
    w.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
        w.accessor(std::vector<float>{0, 0, 0, 1, bad, 0, 0, 1, 0}, "VEC3");
    EXPECT_EQ(problem_of(w), fmt::format("'test.glb': accessors[8] holds {} in element 1", bad));
  }
}

TEST(HostileGltf, TellsOfJointsThatAreNotThere) {
  GltfWriter w = sound();
  w.root["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] =
      w.accessor(std::vector<std::uint8_t>{0, 0, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
  EXPECT_EQ(
      problem_of(w),
      "'test.glb': meshes[0].primitives[0].attributes.JOINTS_0 names joint 5 at point 1, but the skin has 1");
}

TEST(HostileGltf, TellsOfOptionalExtensionsOnce) {
  GltfWriter w = sound();
  w.root["extensionsUsed"] = {"EXT_unknown", "KHR_materials_ior", "EXT_unknown"};
  const gltf::File file = open_gltf(w.save(test_folder()));
  EXPECT_EQ(file.warnings(),
            std::vector<std::string>{"uses EXT_unknown, which is not supported and ignored"});
}

// A file cut anywhere is an error, or (in the padding of its end) none; and never anything else.
TEST(HostileGltf, MayBeCutAnywhere) {
  const auto folder = test_folder();
  const std::string whole = sound().glb();
  for (std::size_t part = 0; part < 50; ++part) {
    const auto path = write_bytes(folder / "cut.glb", whole.substr(0, whole.size() * part / 50));
    EXPECT_NE(problem_of(path), "") << part;
  }
  // The same with honest lengths in the header: the JSON or the binary chunk itself is short.
  for (std::size_t length = 12; length < whole.size(); length += whole.size() / 50) {
    std::string cut = whole.substr(0, length);
    const auto claimed = static_cast<std::uint32_t>(length);
    std::memcpy(&cut[8], &claimed, 4);
    EXPECT_NE(problem_of(write_bytes(folder / "cut.glb", cut)), "") << length;
  }
}

// Every byte changed in its turn: sound or an error.
TEST(HostileGltf, MayHaveAnyByteChanged) {
  const auto folder = test_folder();
  const std::string whole = sound().glb();
  std::size_t errors = 0;
  for (std::size_t i = 0; i < whole.size(); i += 3) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ (i % 2 == 0 ? 0x11 : 0x80));
    errors += problem_of(write_bytes(folder / "changed.glb", changed)).empty() ? 0 : 1;
  }
  EXPECT_GT(errors, 100u);
}

// A file whose mesh is moved by a skin and by morph targets while the shutter is open, with lines beside.
GltfWriter moving() {
  GltfWriter w = sound();
  json& first = w.root["meshes"][0]["primitives"][0];
  first["targets"] = {{{"POSITION", w.accessor(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3")}}};
  json line = w.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0});
  line["mode"] = 3;
  w.root["meshes"][0]["primitives"].push_back(line);
  json& animation = w.root["animations"][0];
  animation["samplers"].push_back({{"input", w.accessor(std::vector<float>{0, 0.5, 1}, "SCALAR")},
                                   {"output", w.accessor(std::vector<float>{0, 1, 0}, "SCALAR")}});
  animation["channels"].push_back({{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}});
  return w;
}

// Reads all of it as it is while the shutter is open for a second.
std::string problem_while_moving(const std::filesystem::path& path) {
  try {
    gltf::File file = open_gltf(path);
    const gltf::Play play{{}, 0, true, 1};
    const auto parts = file.parts({}, play);
    for (const gltf::Surface& surface : parts->surfaces)
      if (surface.drawn == gltf::Drawn::triangles)
        file.mesh(surface, play);
      else
        file.lines(surface, play);
    return {};
  } catch (const Malformed& m) {
    return describe(m, path.filename().string());
  }
}

TEST(HostileGltf, MayHaveAnyByteOfWhatMovesChanged) {
  const auto folder = test_folder();
  const std::string whole = moving().glb();
  EXPECT_EQ(problem_while_moving(write_bytes(folder / "whole.glb", whole)), "");
  std::size_t errors = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ (i % 2 == 0 ? 0x12 : 0xc0));
    errors += problem_while_moving(write_bytes(folder / "changed.glb", changed)).empty() ? 0 : 1;
  }
  EXPECT_GT(errors, 300u);
  for (std::size_t part = 0; part < 50; ++part)
    EXPECT_NE(
        problem_while_moving(write_bytes(folder / "cut.glb", whole.substr(0, whole.size() * part / 50))), "")
        << part;
}

TEST(HostileGltf, TellsOfWhatMovesWrongly) {
  const auto told = [](const char* place, json value) {
    GltfWriter w = moving();
    w.root = w.finished();
    w.root[json::json_pointer(place)] = std::move(value);
    return problem_while_moving(w.save(test_folder()));
  };
  EXPECT_EQ(told("/meshes/0/primitives/0/targets/0/POSITION", 0), "");  // another's points will do
  EXPECT_EQ(told("/meshes/0/primitives/0/targets/0/POSITION", 6),
            "'test.glb': accessors[6].type has 1 numbers where 3 are wanted");
  EXPECT_EQ(told("/meshes/0/primitives/0/targets/0/POSITION", 7),
            "'test.glb': meshes[0].primitives[0].targets[0].POSITION is of 2 points of 3");
  EXPECT_EQ(told("/animations/0/samplers/1/output", 7),
            "'test.glb': accessors[7].type has 3 numbers where 1 are wanted");
  EXPECT_EQ(told("/meshes/0/primitives/1/mode", 1),
            "'test.glb': meshes[0].primitives[1] has 3 ends of lines");
}

// Ten joints, each 1e38 times as large as the one that it hangs on.
TEST(HostileGltf, TellsOfJointsThatLeaveTheNumbers) {
  GltfWriter w = sound();
  json& nodes = w.root["nodes"];
  for (std::size_t i = 1; i <= 10; ++i) {
    nodes[i]["scale"] = {1e38, 1e38, 1e38};
    nodes[i]["translation"] = {1, 0, 0};
    if (i < 10) nodes[i]["children"] = {i + 1};
  }
  w.root["skins"][0]["joints"] = {10};
  w.root.erase("animations");
  const std::string problem = problem_of(w);
  EXPECT_EQ(problem, "'test.glb': nodes[9] stands nowhere: its transform is not finite");
  w.root["scenes"] = {{{"nodes", {11}}}};
  w.node({{"mesh", 0}, {"skin", 0}});
  EXPECT_EQ(problem_of(w),
            "'test.glb': meshes[0].primitives[0] has points that its morph targets or its skin "
            "take to where no numbers are");
}

TEST(HostileGltf, RefusesDataThatIsCutShort) {
  GltfWriter w;
  w.root["buffers"] = {{{"byteLength", 36}, {"uri", "data:application/octet-stream;base64,AAAAAAA"}}};
  w.add("bufferViews", {{"buffer", 0}, {"byteLength", 36}});
  w.add("accessors", {{"bufferView", 0}, {"componentType", float32}, {"count", 3}, {"type", "VEC3"}});
  w.node({{"mesh", w.mesh({{"attributes", {{"POSITION", 0}}}})}});
  EXPECT_EQ(problem_of(w), "'test.glb': buffers[0].byteLength is 36, but there are 5 bytes");
  w.root["buffers"][0]["uri"] = "data:application/octet-stream;base64,AAAAA";
  EXPECT_EQ(problem_of(w), "'test.glb': buffers[0].uri is cut short: its base64 text ends within a byte");
  w.root["buffers"][0]["uri"] = "data:application/octet-stream;base64,AA*A";
  EXPECT_EQ(problem_of(w), "'test.glb': buffers[0].uri holds a byte of value 42 in its base64 text");
  w.root["buffers"][0]["uri"] = "http://example.org/a.bin";
  EXPECT_EQ(problem_of(w),
            "'test.glb': buffers[0].uri is a http address: only files beside this one are read");
}

// Many meshes made of the same bytes would fill the memory.
TEST(HostileGltf, MakesNoMoreThanItsSizeAllows) {
  GltfWriter w;
  const std::size_t zeros = w.accessor(std::vector<float>{0}, "SCALAR");
  w.root["accessors"][zeros] = {{"componentType", float32}, {"count", (1 << 22) - 1}, {"type", "VEC3"}};
  for (int i = 0; i < 100; ++i) w.node({{"mesh", w.mesh({{"attributes", {{"POSITION", zeros}}}})}});
  EXPECT_EQ(problem_of(w),
            "'test.glb': meshes[2].primitives[0] would take more memory than a file of this size may");
}

TEST(HostileGltf, MayNestDeeply) {
  const auto folder = test_folder();
  const std::string deep(1 << 20, '[');
  EXPECT_NE(problem_of(write_bytes(folder / "deep.gltf", deep)), "");
  const std::string closed = deep + std::string(1 << 20, ']');
  EXPECT_NE(problem_of(write_bytes(folder / "deep.gltf",
                                   R"({"asset":{"version":"2.0","extras":)" + closed + "},\"nodes\":7}")),
            "");
  // A chain of a hundred thousand nodes.
  GltfWriter w;
  constexpr int count = 100000;
  for (int i = 0; i < count; ++i) w.node(i + 1 < count ? json{{"children", {i + 1}}} : json::object());
  EXPECT_EQ(problem_of(w), "");
}

}  // namespace UNNAMED
}  // namespace tyndall
