// gltf "file" { … } and mesh "file" { … } in scenes: what they place.
#include "opened.h"
#include "resolve/resolve.h"
#include "support/test_folder.h"
#include "syntax/parser.h"

namespace tyndall {
namespace UNNAMED {

struct Resolved {
  Sources sources;
  Diagnostics diagnostics;
  syntax::Symbols symbols;
  scene::Scene scene;
  std::string messages() const { return render_text(diagnostics, sources, false); }
};

Resolved resolve_in(const std::filesystem::path& folder, const std::string& text,
                    const resolve::Options& options = {}) {
  Resolved r;
  const SourceId source = r.sources.add((folder / "scene.tyn").string(),
                                        "camera perspective { from: (0, 0, 5) to: (0, 0, 0) }\n"
                                        "light environment { radiance: 1 }\n" +
                                            text);
  const syntax::TokenList tokens = syntax::lex(r.sources, source, r.diagnostics);
  const syntax::SyntaxTree tree = syntax::parse(r.sources, source, tokens, r.symbols, r.diagnostics);
  r.scene = resolve::resolve(tree, r.sources, r.symbols, options, r.diagnostics);
  return r;
}

// Two nodes with one mesh, of a material; the second to the right.
GltfWriter pair_of_triangles() {
  GltfWriter w;
  json p = w.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0});
  p["material"] =
      w.add("materials", {{"name", "Paint [1]"}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
  const std::size_t mesh = w.mesh(p);
  w.node({{"mesh", mesh}, {"name", "left"}});
  w.node({{"mesh", mesh}, {"name", "right"}, {"translation", {10, 0, 0}}});
  return w;
}

TEST(GltfStatement, PlacesAllOfAFileWithOneMesh) {
  const auto folder = test_folder();
  pair_of_triangles().save(folder);
  const Resolved r =
      resolve_in(folder, "for i in 0..<100 { gltf \"test.glb\" { transform: translate((0, i, 0)) } }");
  EXPECT_EQ(r.messages(), "");
  EXPECT_EQ(r.scene.meshes.size(), 1u);
  EXPECT_EQ(r.scene.materials.size(), 1u);
  EXPECT_EQ(r.scene.prototypes.size(), 1u);
  EXPECT_EQ(r.scene.instances.size(), 100u);
  const scene::Scene out = scene::expanded(r.scene);
  ASSERT_EQ(out.shapes.size(), 200u);
  expect_near(out.shapes[7].world_from_object.t, {10, 3, 0});
}

// glTF 2.0, 3.9.6: what names no material is of the default one, unless something here is around it.
TEST(GltfStatement, GivesWhatHasNoMaterialThatOfGltf) {
  const auto folder = test_folder();
  GltfWriter w;
  w.node({{"mesh", w.triangle()}});
  w.save(folder);
  const auto material = [&](const std::string& text) {
    const Resolved r = resolve_in(folder, text);
    EXPECT_EQ(r.messages(), "");
    return r.scene.materials.at(r.scene.instances.at(0).material.index);
  };
  const scene::Material of_gltf = material("gltf \"test.glb\" {}");
  ASSERT_TRUE(of_gltf.metallic && of_gltf.roughness);
  EXPECT_EQ(of_gltf.program.constants.at(of_gltf.program.outputs.at(*of_gltf.metallic)), 1);
  EXPECT_EQ(of_gltf.program.constants.at(of_gltf.program.outputs.at(*of_gltf.roughness)), 1);
  EXPECT_FALSE(material("group { material: { base_color = 0.2 }  gltf \"test.glb\" {} }").metallic);
}

TEST(GltfStatement, TellsOfNamesThatSeveralHave) {
  const auto folder = test_folder();
  GltfWriter w = pair_of_triangles();
  w.root["nodes"][1]["name"] = "left";
  w.add("materials", {{"name", "Paint [1]"}});
  w.save(folder);
  EXPECT_NE(resolve_in(folder, "gltf \"test.glb\" { node: \"left\" }")
                .messages()
                .find("'test.glb' has several nodes called 'left': the first is taken, nodes[0]"),
            std::string::npos);
  EXPECT_NE(resolve_in(folder, "gltf \"test.glb\" { materials: [[\"Paint [1]\", { base_color = 0 }]] }")
                .messages()
                .find("'test.glb' has 2 materials called 'Paint [1]': all of them are replaced"),
            std::string::npos);
}

// A file is read once, also when the scene is read again at later times, and its mesh is in the scene once.
TEST(MeshStatement, HoldsAMeshOnceWhateverMoves) {
  const auto folder = test_folder();
  write_bytes(
      folder / "one.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const Resolved r = resolve_in(folder,
                                "animation { fps: 1  frames: 0..1  shutter: 360deg }\n"
                                "mesh \"one.ply\" { transform: translate((sin(9 * time), 0, 0)) }\n"
                                "mesh \"one.ply\" { material: { base_color = 0.1 } }\n"
                                "light mesh { in: mesh \"one.ply\" {}  radiance: 1 }");
  EXPECT_EQ(r.messages(), "");
  ASSERT_EQ(r.scene.meshes.size(), 1u);
  EXPECT_EQ(r.scene.meshes[0]->points.size(), 3u);
  EXPECT_EQ(r.scene.motion.instances.size(), 1u);
}

TEST(GltfStatement, TakesANodeAndOtherMaterials) {
  const auto folder = test_folder();
  pair_of_triangles().save(folder);
  const Resolved r =
      resolve_in(folder,
                 "material tiles(size = 1) { base_color = if checker(uv / size) then 0.8 else 0.2 }\n"
                 "gltf \"test.glb\" { node: \"right\"  materials: [[\"Paint [1]\", tiles(size: 2)]] }\n"
                 "gltf \"test.glb\" { node: \"left\"  material: { base_color = 0.5 } }");
  EXPECT_EQ(r.messages(), "");
  const scene::Scene out = scene::expanded(r.scene);
  ASSERT_EQ(out.shapes.size(), 2u);
  EXPECT_EQ(out.materials[out.shapes[0].material.index].name, "tiles");
  EXPECT_EQ(out.materials[out.shapes[1].material.index].name, "material");
}

TEST(GltfStatement, TellsOfNamesThatAreNotThere) {
  const auto folder = test_folder();
  pair_of_triangles().save(folder);
  const auto messages = [&](const std::string& text) { return resolve_in(folder, text).messages(); };
  EXPECT_NE(messages("gltf \"test.glb\" { node: \"rigth\" }").find("'test.glb' has no node called 'rigth'"),
            std::string::npos);
  EXPECT_NE(messages("gltf \"test.glb\" { node: \"rigth\" }").find("did you mean 'right'?"),
            std::string::npos);
  EXPECT_NE(messages("gltf \"test.glb\" { materials: [[\"Pant\", { base_color = 1 }]] }")
                .find("has no material called 'Pant'"),
            std::string::npos);
  EXPECT_NE(messages("gltf \"test.glb\" { animation: \"walk\" }").find("has no animation called 'walk'"),
            std::string::npos);
  EXPECT_NE(messages("gltf \"none.glb\" {}").find("no file 'none.glb'"), std::string::npos);
  EXPECT_NE(messages("gltf {}").find("'gltf' needs a file"), std::string::npos);
}

// A closed body: a tetrahedron with its faces outwards.
std::size_t tetrahedron(GltfWriter& w) {
  json p = w.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  p["indices"] = w.accessor(std::vector<std::uint8_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}, "SCALAR");
  return w.mesh(p);
}

// Mirrored by its node, it is still closed and faces outwards.
TEST(GltfStatement, BoundsAVolume) {
  const auto folder = test_folder();
  GltfWriter w;
  w.node({{"mesh", tetrahedron(w)}, {"name", "Milk"}, {"scale", {-2, 1, 1}}, {"translation", {3, 0, 0}}});
  w.node({{"mesh", w.triangle()}, {"name", "Jar"}});
  w.save(folder);
  const Resolved r = resolve_in(folder,
                                R"(
volume {
  in: gltf "test.glb" { node: "Milk"  transform: translate((0, 1, 0)) }
  medium: { density = 1  albedo = 0.9 }
}
)");
  EXPECT_EQ(r.messages(), "");
  ASSERT_EQ(r.scene.volumes.size(), 1u);
  const scene::TriangleMesh& mesh =
      *r.scene.meshes.at(std::get<scene::Mesh>(r.scene.volumes[0].shape).mesh.index);
  EXPECT_EQ(scene::open_edges(mesh), 0u);
  double volume = 0;
  for (const auto& t : mesh.triangles)
    volume += dot(mesh.points[t[0]], cross(mesh.points[t[1]], mesh.points[t[2]])) / 6;
  EXPECT_NEAR(volume, 2.0 / 6, 1e-12);
  expect_near(r.scene.volumes[0].world_from_shape.point(mesh.points[1]), {1, 1, 0});
  const Resolved open =
      resolve_in(folder, "volume { in: gltf \"test.glb\" { node: \"Jar\" } medium: { density = 1 } }");
  EXPECT_NE(open.messages().find("the mesh is open or badly wound at 3 edges"), std::string::npos)
      << open.messages();
}

TEST(GltfStatement, FillsGlassByItsVolume) {
  const auto folder = test_folder();
  GltfWriter w;
  const std::size_t mesh = tetrahedron(w);
  w.root["meshes"][mesh]["primitives"][0]["material"] = w.add(
      "materials",
      {{"extensions",
        {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
         {"KHR_materials_volume",
          {{"thicknessFactor", 1}, {"attenuationDistance", 2}, {"attenuationColor", {1, 0.25, 0.5}}}}}}});
  w.node({{"mesh", mesh}, {"scale", {3, 3, 3}}});
  w.save(folder);
  const Resolved r = resolve_in(folder, "gltf \"test.glb\" {}");
  EXPECT_EQ(r.messages(), "");
  ASSERT_EQ(r.scene.media.size(), 1u);
  const scene::Medium& medium = r.scene.media[0];
  // Of the world's metres, whatever the node's scale: after 2 m a quarter of green is left.
  const auto sigma = [&](std::size_t k) {
    return medium.full.constants[medium.full.outputs[medium.sigma_t[k]]];
  };
  EXPECT_EQ(sigma(0), 0);
  EXPECT_NEAR(sigma(1), std::log(4) / 2, 1e-6);
  EXPECT_NEAR(sigma(2), std::log(2) / 2, 1e-6);
  EXPECT_EQ(r.scene.prototypes[0].volumes[0].boundary, 0u);
}

TEST(GltfStatement, HasLightsAndCameras) {
  const auto folder = test_folder();
  GltfWriter w;
  w.root["extensionsUsed"] = {"KHR_lights_punctual"};
  w.root["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"intensity", 683}, {"color", {1, 0.5, 0}}},
      {{"type", "spot"}, {"intensity", 68.3}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
      {{"type", "directional"}, {"intensity", 1366}}};
  const auto light = [](int i) { return json{{"KHR_lights_punctual", {{"light", i}}}}; };
  w.node({{"translation", {1, 2, 3}}, {"scale", {4, 5, 6}}, {"extensions", light(0)}});
  w.node({{"rotation", {0, 0.7071067811865475, 0, 0.7071067811865475}}, {"extensions", light(1)}});
  w.node({{"extensions", light(2)}});
  w.add("cameras",
        {{"type", "perspective"}, {"name", "wide"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}});
  w.add("cameras", {{"type", "orthographic"},
                    {"name", "side"},
                    {"orthographic", {{"ymag", 3}, {"xmag", 3}, {"znear", 0}, {"zfar", 9}}}});
  w.node({{"camera", 0}, {"translation", {0, 1, 7}}});
  w.node({{"camera", 1}, {"translation", {0, 1, 8}}});
  w.save(folder);
  Resolved r = resolve_in(folder, "gltf \"test.glb\" { transform: translate((10, 0, 0)) }");
  EXPECT_EQ(r.messages(), "");
  ASSERT_EQ(r.scene.lights.size(), 4u);
  const auto& point = std::get<scene::PointLight>(r.scene.lights[1].light);
  expect_near(point.position, {11, 2, 3});
  EXPECT_EQ(*point.intensity, (Rgb{1, 0.5f, 0}));
  const auto& spot = std::get<scene::SpotLight>(r.scene.lights[2].light);
  expect_near(spot.to - spot.position, {-1, 0, 0});  // -z turned by 90° about y
  EXPECT_EQ(spot.angle.radians, 0.5);
  EXPECT_EQ(spot.blend, 0.5);
  const auto& sun = std::get<scene::DistantLight>(r.scene.lights[3].light);
  expect_near(sun.direction, {0, 0, -1});
  EXPECT_EQ(*sun.irradiance, Rgb(2.0f));

  Resolved seen;
  const SourceId source = seen.sources.add((folder / "scene.tyn").string(),
                                           R"(
camera gltf "test.glb" { name: "side"  exposure: 1 }
light environment { radiance: 1 }
sphere {}
)");
  const syntax::TokenList tokens = syntax::lex(seen.sources, source, seen.diagnostics);
  const syntax::SyntaxTree tree = syntax::parse(seen.sources, source, tokens, seen.symbols, seen.diagnostics);
  seen.scene = resolve::resolve(tree, seen.sources, seen.symbols, {}, seen.diagnostics);
  EXPECT_EQ(seen.messages(), "");
  const auto& camera = std::get<scene::OrthographicCamera>(seen.scene.camera);
  EXPECT_EQ(camera.height, 6);
  expect_near(camera.from, {0, 1, 8});
  expect_near(normalize(camera.to - camera.from), {0, 0, -1});
}

// A node that goes 8 m in 2 s moves while the shutter is open; an animation has its own pace.
TEST(GltfStatement, MovesWithTime) {
  const auto folder = test_folder();
  GltfWriter w;
  w.node({{"mesh", w.triangle()}});
  w.add("animations", {{"name", "go"},
                       {"samplers",
                        {{{"input", w.accessor(std::vector<float>{0, 2}, "SCALAR")},
                          {"output", w.accessor(std::vector<float>{0, 0, 0, 8, 0, 0}, "VEC3")}}}},
                       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
  w.save(folder);
  resolve::Options options;
  options.frame = 5;  // 0.5 s
  const std::string animation = "animation { fps: 10 frames: 0..20 shutter: 180deg }\n";
  const Resolved r = resolve_in(folder, animation + "gltf \"test.glb\" {}", options);
  EXPECT_EQ(r.messages(), "");
  const scene::Prototype& object = r.scene.prototypes.at(0);
  EXPECT_NEAR(object.shapes.at(0).world_from_object.t.x, 2, 1e-12);
  ASSERT_EQ(object.moving_shapes.size(), 1u);
  EXPECT_NEAR(object.moving_shapes[0].keys.back().world_from_object.t.x, 2.2, 1e-12);
  const Resolved slow = resolve_in(
      folder, animation + "gltf \"test.glb\" { animation: \"go\" start: 0.25s speed: 0.5 }", options);
  EXPECT_NEAR(slow.scene.prototypes.at(0).shapes.at(0).world_from_object.t.x, 0.5, 1e-12);
  const Resolved still = resolve_in(folder, animation + "gltf \"test.glb\" { animation: \"\" }", options);
  EXPECT_EQ(still.scene.prototypes.at(0).shapes.at(0).world_from_object.t.x, 0);
}

TEST(GltfStatement, KeepsToTheFoldersOfItsFiles) {
  const auto folder = test_folder();
  std::filesystem::create_directories(folder / "models");
  write_bytes(folder / "outside.bin", std::string(36, '\0'));
  GltfWriter w;
  w.root["buffers"] = {{{"byteLength", 36}, {"uri", "../outside.bin"}}};
  w.add("bufferViews", {{"buffer", 0}, {"byteLength", 36}});
  w.add("accessors", {{"bufferView", 0}, {"componentType", float32}, {"count", 3}, {"type", "VEC3"}});
  w.node({{"mesh", w.mesh({{"attributes", {{"POSITION", 0}}}})}});
  const auto expect = [&](const std::string& uri, const std::string& message) {
    w.root["buffers"][0]["uri"] = uri;
    write_bytes(folder / "models/test.gltf", w.root.dump());
    const Resolved r = resolve_in(folder, "gltf \"models/test.gltf\" {}");
    EXPECT_NE(r.messages().find(message), std::string::npos) << r.messages();
  };
  expect("../outside.bin", "buffers[0].uri names '../outside.bin', outside of the file's folder");
  expect("%2e%2e/outside.bin", "outside of the file's folder");
  expect((folder / "outside.bin").string(), "outside of the file's folder");
  std::filesystem::create_symlink(folder / "outside.bin", folder / "models/link.bin");
  expect("link.bin", "outside of the file's folder");
  resolve::Options open;
  open.allow_outside = true;
  EXPECT_EQ(resolve_in(folder, "gltf \"models/test.gltf\" {}", open).messages(), "");
}

TEST(MeshStatement, PlacesFiles) {
  const auto folder = test_folder();
  write_bytes(folder / "paint.mtl", "newmtl Red\nKd 0.8 0.1 0.1\nnewmtl Blue\nKd 0 0 1\n");
  write_bytes(folder / "two.obj",
              "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
              "usemtl Red\nf 1 2 3\nusemtl Blue\nf 1 3 4\n");
  const Resolved r = resolve_in(folder,
                                "for i in 0..<5 { mesh \"two.obj\" { transform: translate((i, 0, 0)) } }\n"
                                "mesh \"two.obj\" { materials: [[\"Blue\", { base_color = 0.5 }]] }");
  EXPECT_EQ(r.messages(), "");
  EXPECT_EQ(r.scene.prototypes.size(), 2u);
  const scene::Scene out = scene::expanded(r.scene);
  ASSERT_EQ(out.shapes.size(), 12u);
  EXPECT_EQ(out.materials[out.shapes[0].material.index].name, "Red");
  EXPECT_EQ(out.materials[out.shapes[1].material.index].name, "Blue");
  EXPECT_EQ(out.materials[out.shapes[11].material.index].name, "material");
}

}  // namespace UNNAMED
}  // namespace tyndall
