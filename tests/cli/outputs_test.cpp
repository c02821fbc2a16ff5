// What outputs may be written to: never an input or another output; through links, with their permissions;
// and devices and pipes are not replaced.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "image/image.h"

namespace tyndall::test {
namespace UNNAMED {

namespace fs = std::filesystem;

class Outputs : public CliTest {
 protected:
  std::string scene() const { return file("a.tyn", small_scene()); }
  // Nothing is rendered when this is refused: it would take hours.
  Outcome render(const std::string& scene, std::vector<std::string> options) const {
    options.insert(options.begin(), {"render", scene, "--samples", "100000000", "--quiet"});
    return tyndall(options);
  }
  void expect_refused(const std::string& scene, const std::vector<std::string>& options,
                      const std::string& words) const {
    const Outcome outcome = render(scene, options);
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << words << "\n" << outcome.err;
  }
};

TEST_F(Outputs, StatisticsAreJson) {
  for (const std::string name : {"a.tyn", "a.png", "stats", "stats.jsn"})
    expect_refused(scene(), {"-o", path("a.png"), "--stats", path(name)}, "ends in .json");
  EXPECT_EQ(read_file(path("a.tyn")), small_scene());
  EXPECT_EQ(file_count(), 1u);
}

// The same file by another path: spelt otherwise, through a link to it or to its folder, as a hard link.
TEST_F(Outputs, NoneIsTheScene) {
  const std::string scene = file("a.json", small_scene());
  fs::create_symlink("a.json", path("link.json"));
  fs::create_symlink("link.json", path("second.json"));
  fs::create_hard_link(scene, path("hard.json"));
  fs::create_directory_symlink(path("."), path("folder"));
  fs::create_symlink("a.json", path("link.exr"));
  fs::create_hard_link(scene, path("hard.png"));
  for (const std::string name :
       {"a.json", "./a.json", "link.json", "second.json", "hard.json", "folder/a.json"})
    expect_refused(scene, {"-o", path("a.png"), "--stats", path(name)}, "would overwrite the scene");
  for (const std::string name : {"link.exr", "hard.png", "folder/link.exr"}) {
    expect_refused(scene, {"-o", path(name)}, "would overwrite the scene");
    const Outcome slice =
        tyndall({"inspect", scene, "--medium", "cloud", "--slice", "z=0", "-o", path(name)});
    EXPECT_EQ(slice.status, 1);
    EXPECT_NE(slice.err.find("would overwrite the scene"), std::string::npos) << slice.err;
  }
  EXPECT_EQ(read_file(scene), small_scene());
}

TEST_F(Outputs, NoneIsAFileThatTheSceneReads) {
  const image::Image white{1, 1, {"R", "G", "B"}, {1, 1, 1}};
  ASSERT_EQ(image::write(path("white.exr"), white, {}), "");
  file("part.json", "let radius = 0.5\n");
  const std::string scene =
      file("a.tyn", small_scene() + "include \"part.json\"\nlet white = image(\"white.exr\")\n" +
                        "material wall() { base_color = white(uv) }\n" +
                        "sphere { radius: radius  material: wall() }\n");
  const std::string before = read_file(path("white.exr"));
  expect_refused(scene, {"-o", path("white.exr")}, "would overwrite a file of the scene");
  expect_refused(scene, {"-o", path("./white.exr")}, "would overwrite a file of the scene");
  expect_refused(scene, {"-o", path("a.png"), "--stats", path("part.json")},
                 "would overwrite a file of the scene");
  const Outcome slice =
      tyndall({"inspect", scene, "--medium", "cloud", "--slice", "z=0", "-o", path("white.exr")});
  EXPECT_EQ(slice.status, 1);
  EXPECT_EQ(read_file(path("white.exr")), before);
}

TEST_F(Outputs, NoneIsAnother) {
  fs::create_symlink("a.exr", path("a.json"));  // neither is there yet
  expect_refused(scene(), {"-o", path("a.exr"), "--stats", path("a.json")}, "would overwrite -o");
  ASSERT_EQ(tyndall({"render", scene(), "-o", path("a.exr")}).status, 0);
  expect_refused(scene(), {"-o", path("a.exr"), "--stats", path("a.json")}, "would overwrite -o");
}

TEST_F(Outputs, LinksAreWrittenThrough) {
  fs::create_directory(path("big"));
  fs::create_symlink("big/latest.png", path("latest.png"));
  fs::create_symlink("big/latest.json", path("latest.json"));
  for (int run = 0; run < 2; ++run) {  // the target is made, then replaced
    ASSERT_EQ(tyndall({"render", scene(), "-o", path("latest.png"), "--stats", path("latest.json")}).status,
              0);
    EXPECT_TRUE(fs::is_symlink(path("latest.png")));
    EXPECT_TRUE(fs::is_symlink(path("latest.json")));
    EXPECT_TRUE(image::read(path("big/latest.png")).image);
    EXPECT_TRUE(nlohmann::json::accept(read_file(path("big/latest.json"))));
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(path("big")), fs::directory_iterator()), 2);
  const std::string slice = path("slice.exr");
  fs::create_symlink("big/slice.exr", slice);
  ASSERT_EQ(tyndall({"inspect", scene(), "--medium", "cloud", "--slice", "z=0", "-o", slice}).status, 0);
  EXPECT_TRUE(fs::is_symlink(slice));
  EXPECT_TRUE(fs::exists(path("big/slice.exr")));
}

TEST_F(Outputs, LinksInACircleAreTold) {
  fs::create_symlink("b.exr", path("a.exr"));
  fs::create_symlink("a.exr", path("b.exr"));
  fs::create_symlink("self.json", path("self.json"));
  expect_refused(scene(), {"-o", path("a.exr")}, "a.exr': its symbolic links lead in a circle");
  expect_refused(scene(), {"-o", path("c.exr"), "--stats", path("self.json")}, "lead in a circle");
  EXPECT_TRUE(fs::is_symlink(path("a.exr")));
  EXPECT_TRUE(fs::is_symlink(path("self.json")));
}

TEST_F(Outputs, PermissionsStay) {
  const auto mode_of = [](const std::string& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 07777 : 0u;
  };
  ASSERT_EQ(tyndall({"render", scene(), "-o", path("a.png")}).status, 0);
  for (const mode_t mode : {0600u, 0664u}) {
    ASSERT_EQ(::chmod(path("a.png").c_str(), mode), 0);
    ASSERT_EQ(tyndall({"render", scene(), "-o", path("a.png"), "--seed", std::to_string(mode)}).status, 0);
    EXPECT_EQ(mode_of(path("a.png")), mode);
  }
  const std::string before = read_file(path("a.png"));
  ASSERT_EQ(::chmod(path("a.png").c_str(), 0444), 0);
  expect_refused(scene(), {"-o", path("a.png")}, "it is read-only");
  EXPECT_EQ(read_file(path("a.png")), before);
}

TEST_F(Outputs, LongNamesAreWritten) {
  const std::string name = path(std::string(250, 'x') + ".png");  // names end at 255 bytes
  EXPECT_EQ(tyndall({"render", scene(), "-o", name}).status, 0);
  EXPECT_TRUE(fs::exists(name));
}

TEST_F(Outputs, PipesAreWrittenThrough) {
  for (const std::string name : {"pipe.json", "pipe.exr"}) ASSERT_EQ(::mkfifo(path(name).c_str(), 0600), 0);
  const Outcome outcome =
      run("/bin/sh",
          {"-c", "cat '" + path("pipe.json") + "' >'" + path("got.json") + "' & cat '" + path("pipe.exr") +
                     "' >'" + path("got.exr") + "' & '" TYNDALL_PROGRAM "' render '" + scene() + "' -o '" +
                     path("pipe.exr") + "' --stats '" + path("pipe.json") + "'; wait"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(fs::is_fifo(path("pipe.json")));
  EXPECT_TRUE(fs::is_fifo(path("pipe.exr")));
  EXPECT_TRUE(nlohmann::json::accept(read_file(path("got.json"))));
  EXPECT_TRUE(image::read(path("got.exr")).image);
}

TEST_F(Outputs, APipeThatNothingReadsIsTold) {
  ASSERT_EQ(::mkfifo(path("pipe.json").c_str(), 0600), 0);
  const Outcome outcome = tyndall({"render", scene(), "-o", path("a.png"), "--stats", path("pipe.json")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("pipe.json': nothing reads this pipe"), std::string::npos) << outcome.err;
  EXPECT_TRUE(fs::is_fifo(path("pipe.json")));
}

TEST_F(Outputs, AReaderThatGoesAwayIsTold) {
  ASSERT_EQ(::mkfifo(path("pipe.exr").c_str(), 0600), 0);
  // More than a pipe holds.
  const Outcome outcome = run(
      "/bin/sh", {"-c", "head -c 1 '" + path("pipe.exr") + "' >/dev/null & '" TYNDALL_PROGRAM "' render '" +
                            scene() + "' -o '" + path("pipe.exr") + "' --resolution 400x300 --samples 1"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("Broken pipe"), std::string::npos) << outcome.err;
}

TEST_F(Outputs, DevicesAreWrittenThrough) {
  fs::create_symlink("/dev/full", path("full.exr"));
  fs::create_symlink("/dev/null", path("null.exr"));
  EXPECT_EQ(tyndall({"render", scene(), "-o", path("null.exr"), "--stats", "/dev/null"}).status, 0);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"-o", path("full.exr")}, {"-o", path("a.exr"), "--stats", "/dev/full"}}) {
    std::vector<std::string> command{"render", scene()};
    command.insert(command.end(), options.begin(), options.end());
    const Outcome outcome = tyndall(command);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("No space left"), std::string::npos) << outcome.err;
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
  }
  const Outcome outcome = tyndall({"render", scene(), "-o", path("a.exr"), "--stats", "/dev/stdout"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(nlohmann::json::accept(outcome.out)) << outcome.out;
  EXPECT_TRUE(fs::is_symlink("/dev/stdout"));
}

// Whether it has bad values is known at the end only: no picture is written before, and none is replaced.
TEST_F(Outputs, AFailureOfStrictWritesNoPicture) {
  const std::string bad = file("bad.tyn", R"(render { resolution: (4, 4)  samples: 1  step: 0.2 }
camera perspective { from: (0, 0, 5)  to: (0, 0, 0) }
sphere { material: { base_color = 0.5  roughness = 2 * abs(p.x) } }
light environment { radiance: 1 }
)");
  const Outcome outcome =
      tyndall({"render", bad, "-o", path("a.png"), "--strict", "--stats", path("a.json")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("a.png' was not written"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("samples per pixel"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(path("a.png")));
  EXPECT_FALSE(nlohmann::json::parse(read_file(path("a.json")))["bad_values"].empty());
  EXPECT_EQ(tyndall({"render", bad, "-o", path("a.png")}).status, 0);
}

}  // namespace UNNAMED
}  // namespace tyndall::test
