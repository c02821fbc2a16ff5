// What scenes keep of files: told by --stats, limited by --texture-memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "image/image.h"

namespace tyndall::test {
namespace UNNAMED {

using Assets = CliTest;

// A sky that has no two pixels alike, 12 bytes a pixel once read.
void write_sky(const std::string& path, int width, int height) {
  image::Image sky{width, height, {"R", "G", "B"}, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        sky.pixels.push_back(
            0.5f + 0.4f * static_cast<float>((x * 7 + y * 13 + c * 5) % 31) / 31 +
            (x > width / 3 && x < width / 3 + 20 && y > height / 3 && y < height / 3 + 20 ? 50.0f : 0.0f));
  ASSERT_EQ(image::write(path, sky, {}), "");
}

const std::string scene = R"(
render { resolution: (24, 16)  samples: 4  bounces: 3 }
camera perspective { from: (0, 1, 5)  to: (0, 0.5, 0)  fov: 50deg }
light environment { radiance: image("sky.exr") }
let smoke = grid("plume.vdb")
volume { medium: { density = 4 * smoke(p)  albedo = 0.9 } }
material floor() { base_color = clamp(image("sky.exr", "G")(p.xz), 0, 1) }
plane { point: (0, -0.5, 0)  normal: (0, 1, 0)  material: floor }
mesh "rock.ply" { transform: translate((1, 0, 0)) }
)";

nlohmann::json rendered(const std::vector<std::string>& arguments, const std::string& statistics) {
  const Outcome outcome = tyndall(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return nlohmann::json::parse(read_file(statistics))["assets"];
}

std::uint64_t bytes_of(const nlohmann::json& assets, const std::string& name, const std::string& kind) {
  std::uint64_t bytes = 0;
  for (const nlohmann::json& asset : assets)
    if (asset["path"].get<std::string>().ends_with(name) && asset["kind"] == kind)
      bytes += asset["bytes"].get<std::uint64_t>();
  return bytes;
}

TEST_F(Assets, AreToldAndLimited) {
  const std::filesystem::path scenes = TYNDALL_SOURCE_DIR "/scenes";
  std::filesystem::copy_file(scenes / "grids/plume.vdb", path("plume.vdb"));
  std::filesystem::copy_file(scenes / "models/rock.ply", path("rock.ply"));
  constexpr int width = 1024, height = 512;
  write_sky(path("sky.exr"), width, height);
  const std::string name = file("a.tyn", scene);
  const auto render = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"render",           name,      "-o",
                                       path(out + ".exr"), "--stats", path(out + ".json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return rendered(arguments, path(out + ".json"));
  };
  const nlohmann::json plenty = render("plenty", {}), little = render("little", {"--texture-memory", "16MB"});
  const std::uint64_t of_sky = std::uint64_t{width} * height * 4;
  EXPECT_EQ(bytes_of(plenty, "sky.exr", "image"), 4 * of_sky);
  EXPECT_GT(bytes_of(plenty, "plume.vdb", "grid"), 10000u);
  EXPECT_GT(bytes_of(plenty, "rock.ply", "mesh"), 1000u);
  EXPECT_TRUE(std::is_sorted(plenty.begin(), plenty.end(),
                             [](const auto& a, const auto& b) { return a["bytes"] > b["bytes"]; }));
  // A colour of 6 MB is more than an eighth of 16 MB; of one channel, 2 MB are not.
  EXPECT_EQ(bytes_of(little, "sky.exr", "image in a temporary file"), 3 * of_sky);
  EXPECT_EQ(bytes_of(little, "sky.exr", "image"), of_sky);
  EXPECT_EQ(image::read(path("plenty.exr")).image->pixels, image::read(path("little.exr")).image->pixels);
}

TEST_F(Assets, MemoryIsASize) {
  const std::string name = file("a.tyn", small_scene());
  for (const char* good : {"16MB", "1.5GB", "65536kB", "1TB"})
    EXPECT_EQ(tyndall({"check", name, "--texture-memory", good}).status, 0) << good;
  for (const char* bad : {"15MB", "2TB", "512", "MB", "-1GB", "4 GB", "4gb", "nanGB"}) {
    const Outcome outcome = tyndall({"check", name, "--texture-memory", bad});
    EXPECT_EQ(outcome.status, 2) << bad;
    EXPECT_NE(outcome.err.find("a size from 16MB to 1TB"), std::string::npos) << outcome.err;
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::test
