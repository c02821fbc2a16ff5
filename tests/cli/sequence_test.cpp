// Sequences: a frame is the same whether others came before it or not, a bad one keeps none from being
// rendered, and what is missing is told.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/run_program.h"
#include "image/image.h"
#include "tools/frame_list.h"
#include "tools/load.h"

namespace tyndall::test {
namespace UNNAMED {

namespace fs = std::filesystem;
using nlohmann::json;

TEST(FrameList, IsReadAsItIsWritten) {
  const struct {
    const char* text;
    std::vector<int> frames;
  } rows[] = {{"7", {7}},
              {"1..4", {1, 2, 3, 4}},
              {"1..10..4", {1, 5, 9}},
              {"3..1", {3, 2, 1}},
              {"9..1..4", {9, 5, 1}},
              {"9..1..-4", {9, 5, 1}},
              {"-2..2", {-2, -1, 0, 1, 2}},
              {"-1..-3", {-1, -2, -3}},
              {"1..3,20,30..31", {1, 2, 3, 20, 30, 31}},
              {"5,1..6..2", {5, 1, 3}},
              {"0007..0008", {7, 8}},
              {"1000000000", {1000000000}}};
  for (const auto& row : rows) {
    const auto frames = tools::read_frames(row.text);
    ASSERT_TRUE(frames) << row.text;
    EXPECT_EQ(*frames, row.frames) << row.text;
    std::vector<int> rising = *frames;
    std::sort(rising.begin(), rising.end());
    EXPECT_EQ(tools::read_frames(tools::frames_text(*frames)), rising) << row.text;
  }
  for (const char* text : {"", "a", "1.", "1...4", "1..", "..4", "1,", ",1", "1..4..0", "1..4..-1", "1.5",
                           "1 ..4", "1..4..1..1", "1000000001", "1..1000001", "0x10", "1-4"})
    EXPECT_FALSE(tools::read_frames(text)) << text;
  EXPECT_EQ(tools::read_frames("1..1000000")->size(), tools::most_frames);
  EXPECT_EQ(tools::frames_text({1, 2, 4, 5, 6, 9}), "1,2,4..6,9");
}

TEST(FrameList, NumbersTakeThePlaceOfTheMark) {
  const struct {
    const char* name;
    int frame;
    const char* numbered;
  } rows[] = {{"out.####.exr", 7, "out.0007.exr"},
              {"out.####.exr", 12345, "out.12345.exr"},
              {"out.####.exr", -5, "out.-005.exr"},
              {"out.####.exr", -12345, "out.-12345.exr"},
              {"a##b.png", 0, "a00b.png"},
              {"f###/a_######.png", 12, "f###/a_000012.png"},
              {"take#3.####.png", 2, "take#3.0002.png"},
              {"out.exr", 7, "out.exr"},
              {"take#3.png", 7, "take#3.png"}};
  for (const auto& row : rows) {
    EXPECT_EQ(tools::numbered(row.name, row.frame), row.numbered);
    EXPECT_EQ(tools::has_frame_mark(row.name), tools::numbered(row.name, row.frame) != row.name);
  }
  EXPECT_EQ(tools::with_frame_mark("a/b.c.exr"), "a/b.c.####.exr");
}

// Nine pixels, one sample.
std::string tiny(const std::string& rest, const std::string& camera = "from: (0, 0, 5)  to: (0, 0, 0)") {
  return "render { resolution: (3, 3)  samples: 1 }\nanimation { fps: 24  frames: 1..3 }\n"
         "camera perspective { " +
         camera + "  fov: 40deg }\nlight environment { radiance: 1 }\n" + rest;
}

class Sequence : public CliTest {
 protected:
  Outcome render(const std::string& scene, std::vector<std::string> options,
                 const RunOptions& how = {}) const {
    std::vector<std::string> arguments{"render", path(scene)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return tyndall(arguments, how);
  }
  bool has(const std::string& name) const { return fs::exists(path(name)); }
};

std::vector<json> lines_of(const std::string& text) {
  std::vector<json> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(json::parse(line));
  return lines;
}

// What happened to each frame, and "end".
std::vector<json> done_in(const std::string& text) {
  std::vector<json> done;
  for (const json& line : lines_of(text))
    if (line["event"] == "done" || line["event"] == "end") done.push_back(line);
  return done;
}

const std::string square =
    "object thing {\n  mesh \"square.ply\" {}\n}\nplace thing {}\nplace thing { transform: translate((1, 0, "
    "0)) }\n"
    "volume { in: mesh { points: [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]  triangles: [(0, 2, 1), (0, 1, "
    "3), "
    "(0, 3, 2), (1, 2, 3)] }  medium: { density = 1 + p.x  albedo = 0.5 } }\n";
const std::string square_file =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement "
    "face 1\n"
    "property list uchar int vertex_indices\nend_header\n-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n4 0 1 2 3\n";

// The law of sequences: whatever is kept between frames, each is byte for byte what it is alone. The later
// one is rendered first.
TEST_F(Sequence, FramesAreThoseThatAreRenderedAlone) {
  const struct {
    const char* name;
    std::string text;
    json reuse;  // of the second frame
  } rows[] = {
      {"still", tiny(square), {{"scene", "kept"}}},
      {"camera",
       tiny(square, "from: (time, 0, 5)  to: (0, 0, 0)"),
       {{"scene", "rebuilt"},
        {"files", {{"kept", 1}, {"rebuilt", 0}}},
        {"meshes", {{"kept", 2}, {"rebuilt", 0}}},
        {"bounds", {{"kept", 1}, {"rebuilt", 0}}}}},
      {"body",
       tiny("volume { in: sphere {}  medium: { density = 1 + fbm(p + (time, 0, 0))  albedo = 0.5 } }\n"),
       {{"scene", "rebuilt"},
        {"files", {{"kept", 0}, {"rebuilt", 0}}},
        {"meshes", {{"kept", 0}, {"rebuilt", 0}}},
        {"bounds", {{"kept", 0}, {"rebuilt", 1}}}}},
      {"text",
       tiny("if frame == 1 { sphere {} } else { mesh \"square.ply\" {} }\n"
            "sphere { material: { base_color = image(\"p{frame}.png\")(uv) } }\n"),
       {{"scene", "rebuilt"},
        {"files", {{"kept", 0}, {"rebuilt", 1}}},
        {"meshes", {{"kept", 0}, {"rebuilt", 0}}},
        {"bounds", {{"kept", 0}, {"rebuilt", 0}}}}},
  };
  file("square.ply", square_file);
  for (const float value : {1.0f, 3.0f})
    ASSERT_EQ(image::write(path("p" + std::to_string(int(value)) + ".png"),
                           {2, 1, {"R", "G", "B"}, {0, 0, 0, value / 4, value / 4, value / 4}}, {}),
              "");
  for (const auto& row : rows) {
    SCOPED_TRACE(row.name);
    const std::string scene = std::string(row.name) + ".tyn";
    file(scene, row.text);
    const Outcome all = render(scene, {"-o", path("s.####.exr"), "--frames", "3,1", "--overwrite", "--json"});
    ASSERT_EQ(all.status, 0) << all.err;
    const std::vector<json> done = done_in(all.out);
    ASSERT_EQ(done.size(), 3u) << all.out;
    EXPECT_EQ(done[0]["frame"], 3);
    EXPECT_EQ(done[1]["frame"], 1);
    EXPECT_EQ(done[1]["statistics"]["reuse"], row.reuse) << done[1]["statistics"]["reuse"];
    for (const char* frame : {"1", "3"}) {
      const Outcome alone = render(scene, {"-o", path("a.exr"), "--frame", frame});
      ASSERT_EQ(alone.status, 0) << alone.err;
      EXPECT_TRUE(read_file(path("a.exr")) == read_file(path(std::string("s.000") + frame + ".exr")))
          << frame;
    }
  }
}

// The same for the scenes of the gallery, without rendering: text, files and what is told of them.
TEST(KeptFrames, AreReadAsTheyAreAlone) {
  std::size_t scenes = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(TYNDALL_SOURCE_DIR) / "scenes")) {
    if (entry.path().extension() != ".tyn") continue;
    SCOPED_TRACE(entry.path());
    ++scenes;
    tools::SceneRequest request;
    request.path = entry.path().string();
    request.warns_of_frame = false;
    const auto kept = tools::load(request, tools::Stage::tree);
    for (const int frame : {9, 2}) {
      request.frame = frame;
      tools::load_scene(request, *kept, tools::Keeps::for_other_frames);
      const auto alone = tools::load(request);
      constexpr auto as_light = scene::Printed::as_light;
      EXPECT_TRUE(scene::print(kept->scene, as_light) == scene::print(alone->scene, as_light)) << frame;
      EXPECT_EQ(kept->files_read, alone->files_read) << frame;
      EXPECT_TRUE(kept->assets == alone->assets) << frame;
      EXPECT_FALSE(kept->diagnostics.has_errors()) << frame;
    }
    EXPECT_EQ(kept->kept.files.rebuilt, 0u);
  }
  EXPECT_GT(scenes, 20u);
}

TEST_F(Sequence, ABadFrameKeepsNoneFromBeingRendered) {
  file("a.tyn", tiny("sphere { radius: if frame == 2 then -1 else 1 }\n"));
  const Outcome first = render("a.tyn", {"-o", path("s.####.png"), "--stats", path("s.####.json"), "--json"});
  EXPECT_EQ(first.status, 1);
  EXPECT_NE(first.err.find("lacks a frame: 2\n"), std::string::npos) << first.err;
  for (const int frame : {1, 2, 3})
    for (const char* kind : {".png", ".json"})
      EXPECT_EQ(has("s.000" + std::to_string(frame) + kind), frame != 2) << frame << kind;
  const std::vector<json> done = done_in(first.out);
  ASSERT_EQ(done.size(), 4u) << first.out;
  EXPECT_EQ(done[0]["outcome"], "rendered");
  EXPECT_EQ(done[1]["outcome"], "failed");
  EXPECT_NE(done[1]["diagnostics"][0]["message"].get<std::string>().find("radius"), std::string::npos);
  EXPECT_EQ(done[2]["outcome"], "rendered");
  EXPECT_EQ(done[2]["number"], 3);
  EXPECT_EQ(done[2]["count"], 3);
  EXPECT_EQ(done[3]["missing"], json({2}));
  EXPECT_EQ(done[3]["rendered"], 2);

  // What is there stays; what is stale is told and made anew.
  fs::remove(path("s.0003.json"));
  file("a.tyn", tiny("sphere { radius: if frame == 2 then 2 else 1 }  // mended\n"));
  file("b.tyn", tiny("sphere { radius: if frame == 2 then -1 else 1 }\n"));
  const std::string before = read_file(path("s.0001.png"));
  const Outcome same = render("b.tyn", {"-o", path("s.####.png"), "--frames", "1..3..2", "--json"});
  EXPECT_EQ(same.status, 0) << same.err;
  for (const json& line : done_in(same.out))
    if (line["event"] == "done") {
      EXPECT_EQ(line["outcome"], "skipped");
    }
  const Outcome again = render("a.tyn", {"-o", path("s.####.png"), "--stats", path("s.####.json")});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("s.0001.png' is rendered again: the scene's text has changed"), std::string::npos)
      << again.err;
  EXPECT_NE(again.err.find("3 frames rendered"), std::string::npos) << again.err;
}

// Errors that are those of every frame are told once, and no other frame is tried.
TEST_F(Sequence, ASceneThatIsBadAtAllTimesIsToldOnce) {
  file("a.tyn", tiny("sphere { radius: -1 }\n"));
  const Outcome outcome = render("a.tyn", {"-o", path("s.####.png")});
  EXPECT_EQ(outcome.status, 1);
  const std::size_t told = outcome.err.find("radius");
  ASSERT_NE(told, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("error: 'radius'", told), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("lacks 3 frames: 1..3"), std::string::npos) << outcome.err;
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(Sequence, AFullDiskEndsIt) {
  file("a.tyn", tiny("sphere {}\n"));
  fs::create_symlink("/dev/full", path("s.0002.exr"));
  const Outcome outcome = render("a.tyn", {"-o", path("s.####.exr"), "--frames", "1..5"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("No space left on device"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("lacks 4 frames: 2..5"), std::string::npos) << outcome.err;
  EXPECT_TRUE(has("s.0001.exr"));
  EXPECT_FALSE(has("s.0003.exr"));
}

TEST_F(Sequence, AnInterruptionEndsItAndSavesItsFrame) {
  file("a.tyn", tiny("sphere {}\n"));
  ASSERT_EQ(render("a.tyn", {"-o", path("s.####.exr"), "--frame", "1"}).status, 0);
  file("b.tyn", tiny("sphere { radius: 2 }\n"));
  const Outcome outcome =
      render("b.tyn",
             {"-o", path("s.####.exr"), "--frames", "-1..3", "--samples", "100000000",
              "--checkpoint-interval", "0.1"},
             {.interrupt_after_seconds = 1e-3, .wait_for = appears("s.-001.exr.checkpoint")});
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_NE(outcome.err.find("lacks 5 frames: -1..3"), std::string::npos) << outcome.err;
  EXPECT_TRUE(image::read(path("s.-001.exr")).image);
  EXPECT_FALSE(has("s.0000.exr"));
}

TEST_F(Sequence, WhatCannotBeOneIsRefused) {
  file("a.tyn", tiny("sphere {}\n"));
  const struct {
    std::vector<std::string> options;
    int status;
    const char* told;
  } rows[] = {
      {{"-o", path("a.exr"), "--frames", "1..3"}, 2, "a.####.exr', where #### stands for the frame's number"},
      {{"-o", path("a.####.exr"), "--stats", path("a.json")}, 2, "write --stats '"},
      {{"-o", path("a.##.exr"), "--frames", "1...3"}, 2, "--frames: wants frames from"},
      {{"-o", path("a.##.exr"), "--frames", "1", "--frame", "1"}, 2, "--frame"},
      {{"-o", path("a.exr"), "--movie", path("a.mp4")}, 2, "--movie wants a sequence"},
      {{"-o", path("a.##.exr"), "--movie", path("a.gif")}, 1, "ends in .mp4, .mov or .mkv"},
      {{"-o", path("a.##.exr"), "--movie", path("no/a.mp4")}, 1, "ffmpeg"},
      {{"-o", path("a.##.exr"), "--crop", "0,0,9,9"}, 2, "--crop 0,0,9,9 reaches outside"},
  };
  for (const auto& row : rows) {
    const Outcome outcome = render("a.tyn", row.options, {.environment = {"PATH=/nowhere"}});
    EXPECT_EQ(outcome.status, row.status) << outcome.err;
    EXPECT_NE(outcome.err.find(row.told), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(file_count(), 1u);
}

// What is wrong with the folder or the kind of every frame is told once.
TEST_F(Sequence, NamesThatNoFrameCanHaveEndItAtOnce) {
  file("a.tyn", tiny("sphere {}\n"));
  const struct {
    std::vector<std::string> options;
    std::string told;
  } rows[] = {
      {{"-o", path("no/a.##.exr")}, "there is no directory '" + path("no") + "'"},
      {{"-o", path("a.##")}, "unknown extension"},
      {{"-o", path("a.##.exr"), "--stats", path("no/a.##.json")}, "there is no directory"},
      {{"-o", path("a.##.exr"), "--stats", path("a.##.txt")}, "--stats wants a name that ends in .json"}};
  for (const auto& row : rows) {
    const Outcome outcome = render("a.tyn", row.options);
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    const std::size_t told = outcome.err.find(row.told);
    ASSERT_NE(told, std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find(row.told, told + 1), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(file_count(), 1u);
}

// One frame needs no mark; a name with one is numbered for --frame, too. Frames that the scene does not have
// are warned of together.
TEST_F(Sequence, OneFrameMayHaveAnyName) {
  file("a.tyn", tiny("sphere {}\n"));
  const Outcome one = render("a.tyn", {"-o", path("a.png"), "--frames", "2"});
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(one.err.find("warning"), std::string::npos) << one.err;
  EXPECT_TRUE(has("a.png"));
  EXPECT_EQ(render("a.tyn", {"-o", path("b.###.png"), "--frame", "0"}).status, 0);
  EXPECT_TRUE(has("b.000.png"));
  const Outcome outside = render("a.tyn", {"-o", path("c.##.png"), "--frames", "3..5,9"});
  EXPECT_EQ(outside.status, 0);
  EXPECT_NE(outside.err.find("warning: frames 4,5,9 are outside of the scene's frames, 1 to 3"),
            std::string::npos)
      << outside.err;
}

// Each frame has a picture of its own: what the frames before read is not kept for ever.
TEST_F(Sequence, MemoryDoesNotGrowOverFrames) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer keeps what is freed for a while";
#endif
  constexpr int frames = 12, side = 1024;
  const image::Image picture{
      side, side, {"R", "G", "B"}, std::vector<float>(std::size_t{side} * side * 3, 0.5f)};
  ASSERT_EQ(image::write(path("p1.png"), picture, {}), "");
  for (int frame = 2; frame <= frames; ++frame)
    fs::create_hard_link(path("p1.png"), path("p" + std::to_string(frame) + ".png"));
  file("a.tyn", tiny("sphere { material: { base_color = image(\"p{frame}.png\")(uv) } }\n"));
  const Outcome outcome = render("a.tyn", {"-o", path("s.##.png"), "--frames", "1..12", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::vector<json> done = done_in(outcome.out);
  const auto peak = [&](std::size_t i) {
    return done.at(i)["statistics"]["peak_memory_bytes"].get<double>();
  };
  constexpr double bytes_of_a_picture = 4.0 * side * side * 3;
  EXPECT_LT(peak(frames - 1) - peak(3), 2 * bytes_of_a_picture);
}

TEST_F(Sequence, BecomesAMovie) {
  if (run("/bin/sh", {"-c", "command -v ffmpeg && command -v ffprobe"}).status != 0)
    GTEST_SKIP() << "ffmpeg is not installed";
  file("a.tyn", tiny("sphere { radius: if frame == 2 then -1 else 1 }\n"));
  // Three by three pixels, of which 4:2:0 makes four by four; a frame is missing.
  const Outcome outcome =
      render("a.tyn", {"-o", path("s.##.exr"), "--frames", "4..1", "--movie", path("a.mp4")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("lacks a frame: 2"), std::string::npos) << outcome.err;
  const Outcome probed =
      run("/bin/sh", {"-c",
                      "ffprobe -v error -count_frames -show_entries stream=nb_read_frames,width,height,"
                      "codec_name,pix_fmt,r_frame_rate -of default=nw=1 '" +
                          path("a.mp4") + "'"});
  for (const char* fact :
       {"codec_name=h264", "width=4", "height=4", "pix_fmt=yuv420p", "r_frame_rate=24/1", "nb_read_frames=3"})
    EXPECT_NE(probed.out.find(fact), std::string::npos) << fact << "\n" << probed.out << probed.err;
  // Pictures that are there are shown without being rendered again; sizes that differ are told.
  ASSERT_EQ(image::write(path("s.03.exr"), {1, 1, {"R", "G", "B"}, {0, 0, 0}}, {}), "");
  const Outcome other = render(
      "a.tyn", {"-o", path("s.##.exr"), "--frames", "1,4", "--movie", path("b.mp4"), "--resolution", "5x3"});
  EXPECT_EQ(other.status, 0) << other.err;
  EXPECT_TRUE(has("b.mp4"));
  // A name that could be an address, or an option.
  for (const std::string name : {"take:1.mp4", "-t.mov", "%d.mkv"}) {
    const Outcome named =
        run("/bin/sh",
            {"-c", "cd '" + path("") +
                       "' && '" TYNDALL_PROGRAM "' render a.tyn -o s.##.exr --frames 1,4 --resolution 5x3 "
                       "--movie='" +
                       name + "'"});
    EXPECT_EQ(named.status, 0) << named.err;
    EXPECT_TRUE(has(name));
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::test
