// Materials: what their programs give at a place, against textures of known texels.
#include "image/image.h"
#include "opened.h"
#include "support/test_folder.h"
#include "vm/run/machine.h"

namespace tyndall {
namespace UNNAMED {

// A picture of 4 x 4 pixels: red falls along x, green along y downwards (sRGB 8-bit).
std::filesystem::path write_picture(const std::filesystem::path& folder) {
  image::Image picture{4, 4, {"R", "G", "B"}, std::vector<float>(48)};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      float* const p = &picture.pixels[static_cast<std::size_t>(3 * (4 * y + x))];
      p[0] = 0.2f * static_cast<float>(x + 1);
      p[1] = 0.2f * static_cast<float>(y + 1);
      p[2] = 0.5f;
    }
  const auto path = folder / "picture.png";
  EXPECT_EQ(image::write(path.string(), picture, {}), "");
  return path;
}

struct At {
  double u = 0, v = 0;  // v down, as in the file
  Vec3f n{0, 0, 1}, t{1, 0, 0};
  float sign = 1;
  std::array<float, 4> color{1, 1, 1, 1};
};

// Every output of a material's program there.
std::vector<float> run(const scene::Material& material, const At& at) {
  std::array<float, vm::input_count> values{};
  const auto set = [&](vm::Input input, double value) {
    values[static_cast<std::size_t>(input)] = static_cast<float>(value);
  };
  set(vm::Input::u, at.u);
  set(vm::Input::v, 1 - at.v);
  for (std::size_t k = 0; k < 3; ++k) {
    set(static_cast<vm::Input>(static_cast<std::size_t>(vm::Input::n_x) + k), double{at.n[k]});
    set(static_cast<vm::Input>(static_cast<std::size_t>(vm::Input::t_x) + k), double{at.t[k]});
  }
  set(vm::Input::t_sign, double{at.sign});
  for (std::size_t k = 0; k < 4; ++k)
    set(static_cast<vm::Input>(static_cast<std::size_t>(vm::Input::red) + k), double{at.color[k]});
  vm::BatchInputs inputs;
  for (std::size_t i = 0; i < values.size(); ++i) inputs.lanes[i] = &values[i];
  std::vector<float> out(material.program.outputs.size());
  std::vector<float*> rows;
  for (float& f : out) rows.push_back(&f);
  vm::run_reference(material.program, inputs, 1, rows);
  return out;
}
Rgb color(const scene::Material& material, const scene::RgbOutputs& which, const At& at) {
  const std::vector<float> out = run(material, at);
  return {out[which[0]], out[which[1]], out[which[2]]};
}

// The only material of a file with the picture as its first texture.
scene::Material compiled(json material, json sampler = json::object(), bool colors = false) {
  const auto folder = test_folder();
  write_picture(folder);
  GltfWriter w;
  w.add("images", {{"uri", "picture.png"}});
  w.add("samplers", std::move(sampler));
  w.add("textures", {{"source", 0}, {"sampler", 0}});
  w.add("materials", std::move(material));
  gltf::File file = open_gltf(w.save(folder));
  return file.compiled_material(0, colors, {});
}

void expect_color(const Rgb& found, const Rgb& wanted) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k], wanted[k], 0.004) << k;  // a step of 8 bits
}

const json textured = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}};

TEST(GltfMaterials, LookUpTexelsWithVDown) {
  const scene::Material m = compiled(textured);
  expect_color(color(m, m.base_color, {0.125, 0.125}), {0.2f, 0.2f, 0.5f});
  expect_color(color(m, m.base_color, {0.875, 0.125}), {0.8f, 0.2f, 0.5f});
  expect_color(color(m, m.base_color, {0.125, 0.875}), {0.2f, 0.8f, 0.5f});
  expect_color(color(m, m.base_color, {0.25, 0.875}), {0.3f, 0.8f, 0.5f});
  expect_color(color(m, m.base_color, {2.125, -0.125}), {0.2f, 0.8f, 0.5f});  // repeats
}

TEST(GltfMaterials, ClampMirrorAndTakeTheNearest) {
  const scene::Material clamped = compiled(textured, {{"wrapS", 33071}, {"wrapT", 33648}});
  expect_color(color(clamped, clamped.base_color, {-3, 0.125}), {0.2f, 0.2f, 0.5f});
  expect_color(color(clamped, clamped.base_color, {9, 0.125}), {0.8f, 0.2f, 0.5f});
  expect_color(color(clamped, clamped.base_color, {0.125, 1.125}), {0.2f, 0.8f, 0.5f});
  expect_color(color(clamped, clamped.base_color, {0.125, -0.375}), {0.2f, 0.4f, 0.5f});
  const scene::Material nearest = compiled(textured, {{"magFilter", 9728}});
  expect_color(color(nearest, nearest.base_color, {0.24, 0.26}), {0.2f, 0.4f, 0.5f});
}

TEST(GltfMaterials, MoveTextureCoordinates) {
  json m = textured;
  // u' = 0.25 + 0.5 u, v' = 0.5 + v.
  m["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
      {"KHR_texture_transform", {{"offset", {0.25, 0.5}}, {"scale", {0.5, 1}}}}};
  scene::Material moved = compiled(m);
  expect_color(color(moved, moved.base_color, {0.25, 0.125}), {0.4f, 0.6f, 0.5f});
  m["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
      {"KHR_texture_transform", {{"rotation", 1.5707963267948966}}}};  // (u, v) becomes (v, -u)
  moved = compiled(m);
  expect_color(color(moved, moved.base_color, {0.125, 0.625}), {0.6f, 0.8f, 0.5f});  // at (0.625, -0.125)
}

TEST(GltfMaterials, MultiplyFactorsTexturesAndColors) {
  json m = textured;
  m["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.25, 1, 1};
  const scene::Material out = compiled(m, json::object(), true);
  At at{0.875, 0.875};
  at.color = {0.5f, 1, 0.5f, 1};
  expect_color(color(out, out.base_color, at), {0.2f, 0.2f, 0.25f});
}

// Green is roughness and blue metal, as they are stored: 8-bit sRGB of 0.5 is 0.735.
TEST(GltfMaterials, TakeRoughnessAndMetalAsStored) {
  const scene::Material m = compiled(
      {{"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 0}}}, {"roughnessFactor", 0.5}}}});
  ASSERT_TRUE(m.metallic && m.roughness);
  const std::vector<float> out = run(m, {0.125, 0.875});
  EXPECT_NEAR(out[*m.metallic], 0.735, 0.004);
  EXPECT_NEAR(out[*m.roughness], 0.5 * 0.906, 0.004);  // of 0.8
}

// Of a texel (r, g, b) the normal is (2r - 1) t + (2g - 1) b + (2b - 1) n.
TEST(GltfMaterials, TurnNormalsBySlopes) {
  const scene::Material m = compiled({{"normalTexture", {{"index", 0}, {"scale", 0.5}}}});
  ASSERT_TRUE(m.normal);
  At at{0.125, 0.875, {0, 0, 1}, {0, 1, 0}, -1};    // t along y: n × t is -x, turned again by the sign
  const double r = 0.4845, g = 0.9063, b = 0.7354;  // sRGB of 0.2, 0.8, 0.5
  const Rgb n = color(m, *m.normal, at);
  EXPECT_NEAR(n.x, 0.5 * (2 * g - 1), 0.01);
  EXPECT_NEAR(n.y, 0.5 * (2 * r - 1), 0.01);
  EXPECT_NEAR(n.z, 2 * b - 1, 0.01);
}

TEST(GltfMaterials, HaveTheirExtensions) {
  const json m = {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0.25}}},
                  {"emissiveFactor", {1, 0.5, 0}},
                  {"alphaMode", "MASK"},
                  {"extensions",
                   {{"KHR_materials_emissive_strength", {{"emissiveStrength", 20}}},
                    {"KHR_materials_ior", {{"ior", 1.33}}},
                    {"KHR_materials_specular", {{"specularFactor", 0.5}}},
                    {"KHR_materials_transmission", {{"transmissionFactor", 0.75}}},
                    {"KHR_materials_clearcoat", {{"clearcoatFactor", 0.4}}},
                    {"KHR_materials_sheen", {{"sheenColorFactor", {0.1, 0.2, 0.3}}}}}}};
  const scene::Material out = compiled(m);
  const std::vector<float> v = run(out, {});
  EXPECT_FALSE(out.metallic);
  EXPECT_EQ(v[*out.roughness], 0.25f);
  EXPECT_EQ(v[*out.ior], 1.33f);
  EXPECT_EQ(v[*out.specular], 0.5f);
  EXPECT_EQ(v[*out.transmission], 0.75f);
  EXPECT_EQ(v[*out.coat], 0.4f);
  EXPECT_EQ(color(out, *out.sheen, {}), (Rgb{0.1f, 0.2f, 0.3f}));
  EXPECT_EQ(color(out, *out.emission, {}), (Rgb{20, 10, 0}));
  EXPECT_FALSE(out.opacity);  // its alpha, 1, is above the cut-off
}

TEST(GltfMaterials, ColourTheirSpecularAndRoughenTheirCoat) {
  const json coated = {{"extensions",
                        {{"KHR_materials_specular", {{"specularColorFactor", {1, 0.5, 0.25}}}},
                         {"KHR_materials_clearcoat",
                          {{"clearcoatFactor", 1},
                           {"clearcoatRoughnessFactor", 0.5},
                           {"clearcoatRoughnessTexture", {{"index", 0}}}}}}}};
  const scene::Material m = compiled(coated);
  ASSERT_TRUE(m.specular_color && m.coat_roughness);
  EXPECT_EQ(color(m, *m.specular_color, {}), (Rgb{1, 0.5f, 0.25f}));
  EXPECT_NEAR(run(m, {0.125, 0.875})[*m.coat_roughness], 0.5 * 0.906, 0.004);  // green is 0.8, as stored
  // Its texture is of sRGB.
  json textured_color = coated;
  textured_color["extensions"]["KHR_materials_specular"]["specularColorTexture"] = {{"index", 0}};
  const scene::Material t = compiled(textured_color);
  expect_color(color(t, *t.specular_color, {0.125, 0.875}), {0.2f, 0.4f, 0.125f});
  // A polished coat is nearly polished.
  EXPECT_FALSE(
      compiled({{"extensions", {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}}}}).coat_roughness);
  EXPECT_FALSE(compiled({{"name", "plain"}}).specular_color);
}

TEST(GltfMaterials, TellWhatIsNotReadOnceByName) {
  GltfWriter w;
  w.add("images", {{"uri", "none.png"}});
  w.add("textures", {{"source", 0}});
  const json texture = {{"index", 0}};
  for (const char* name : {"Leather", "Velvet"})
    w.add("materials",
          {{"name", name},
           {"occlusionTexture", texture},
           {"extensions",
            {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}, {"clearcoatNormalTexture", texture}}},
             {"KHR_materials_sheen", {{"sheenColorFactor", {1, 1, 1}}, {"sheenRoughnessFactor", 0.5}}},
             {"KHR_materials_volume", {{"thicknessFactor", 1}, {"thicknessTexture", texture}}}}}});
  gltf::File file = open_gltf(w.save(test_folder()));
  for (std::uint32_t i = 0; i < 2; ++i) file.material(i);
  EXPECT_EQ(
      file.warnings(),
      (std::vector<std::string>{
          "has an occlusionTexture in 'Leather', which is ignored: what occludes is computed here",
          "has a clearcoatNormalTexture in 'Leather', which is ignored: its coat has the normal of what is "
          "below",
          "has a sheen roughness in 'Leather', which is ignored: all sheen is of one roughness here",
          "has a thicknessTexture in 'Leather', which is ignored: the way through the mesh itself counts"}));
}

TEST(GltfMaterials, MaskBlendOrAreOpaque) {
  const auto opacity = [](const char* mode, double alpha) {
    const scene::Material m =
        compiled({{"alphaMode", mode}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, alpha}}}}});
    return m.opacity ? run(m, {})[*m.opacity] : 1.0f;
  };
  EXPECT_EQ(opacity("OPAQUE", 0.25), 1);
  EXPECT_EQ(opacity("BLEND", 0.25), 0.25f);
  EXPECT_EQ(opacity("MASK", 0.25), 0);
  EXPECT_EQ(opacity("MASK", 0.5), 1);
}

TEST(GltfMaterials, WithoutLightGlow) {
  json m = textured;
  m["extensions"] = {{"KHR_materials_unlit", json::object()}};
  const scene::Material out = compiled(m);
  EXPECT_EQ(color(out, out.base_color, {}), Rgb(0.0f));
  expect_color(color(out, *out.emission, {0.125, 0.125}), {0.2f, 0.2f, 0.5f});
  EXPECT_TRUE(out.matte());
}

TEST(GltfMaterials, TellOfPicturesThatCannotBeRead) {
  const auto folder = test_folder();
  write_bytes(folder / "picture.png", "no picture");
  GltfWriter w;
  w.add("images", {{"uri", "picture.png"}});
  w.add("textures", {{"source", 0}});
  json p = w.primitive({0, 0, 0, 1, 0, 0, 0, 1, 0});
  p["material"] = w.add("materials", textured);
  w.node({{"mesh", w.mesh(p)}});
  EXPECT_EQ(problem_of(w.save(folder)), "'test.glb': images[0] is no PNG, JPEG or WebP picture");
}

}  // namespace UNNAMED
}  // namespace tyndall
