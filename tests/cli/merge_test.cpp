// `tyndall merge`: parts of a picture are the whole, byte for byte, or are refused with the reason.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "image/image.h"

namespace tyndall::test {
namespace UNNAMED {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

class Merge : public CliTest {
 protected:
  std::string scene() const { return file("a.tyn", small_scene()); }
  // Renders with these options; the path of the output.
  std::string rendered(const std::string& name, const Words& options) const {
    const Outcome outcome = tyndall(Words{"render", scene(), "-o", path(name), "--quiet"} + options);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return path(name);
  }
  Words parts(const std::vector<Words>& splits, const Words& options) const {
    Words paths;
    for (const Words& split : splits)
      paths.push_back(rendered("p" + std::to_string(paths.size()) + ".tynpart", options + split));
    return paths;
  }
  Outcome merged(const Words& paths, const std::string& name, const Words& options = {}) const {
    return tyndall(Words{"merge"} + paths + Words{"-o", path(name)} + options);
  }
};

const Words six{"--samples", "6"};
const Words all_outputs{"--aov",
                        "depth,normal,albedo,volume_direct,volume_indirect,volume_emission,transmittance,"
                        "optical_depth,samples,variance,cost"};

TEST_F(Merge, PartsAreTheWholeByteForByte) {
  const std::vector<Words> splits[] = {
      {{"--sample-range", "0..5"}},
      {{"--sample-range", "3..5"}, {"--sample-range", "0..0"}, {"--sample-range", "1..2"}},
      {{"--crop", "0,0,16,5"}, {"--crop", "0,5,7,12"}, {"--crop", "7,5,16,12"}},
      {{"--crop", "0,0,9,12", "--sample-range", "0..1"},
       {"--crop", "9,0,16,12"},
       {"--crop", "0,0,9,12", "--sample-range", "2..5"}},
  };
  for (const auto& [name, options] :
       {std::pair(std::string("whole.exr"), six), std::pair(std::string("outputs.exr"), six + all_outputs),
        std::pair(std::string("whole.png"), six), std::pair(std::string("whole.tynpart"), six)}) {
    const std::string whole = read_file(rendered(name, options));
    for (const std::vector<Words>& split : splits) {
      const Outcome outcome = merged(parts(split, options), "merged-" + name);
      ASSERT_EQ(outcome.status, 0) << outcome.err;
      EXPECT_TRUE(read_file(path("merged-" + name)) == whole) << name << " of " << split.size();
    }
  }
}

// What a clamp removed of the parts is what it removed of the whole: it is in the metadata.
TEST_F(Merge, WhatAClampRemovedAddsUp) {
  const Words clamped = six + Words{"--clamp", "off,0.01"};
  const std::vector<Words> split{{"--sample-range", "0..3"}, {"--sample-range", "4..5"}};
  for (const std::string name : {"whole.exr", "whole.tynpart"}) {
    const std::string whole = read_file(rendered(name, clamped));
    const Outcome outcome = merged(parts(split, clamped), "merged-" + name);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("clamp removed "), std::string::npos) << outcome.err;
    EXPECT_TRUE(read_file(path("merged-" + name)) == whole) << name;
  }
}

// Ranges beyond the scene's samples make a picture of as many as they have; parts of parts are parts.
TEST_F(Merge, PartsOfPartsAreParts) {
  const std::string whole = read_file(rendered("whole.exr", {"--samples", "5"}));
  const Words paths =
      parts({{"--sample-range", "0..1"}, {"--sample-range", "2..3"}, {"--sample-range", "4..4"}}, {});
  ASSERT_EQ(merged({paths[2], paths[1]}, "half.tynpart", {"--incomplete"}).status, 0);
  ASSERT_EQ(merged({path("half.tynpart"), paths[0]}, "a.exr").status, 0);
  EXPECT_TRUE(read_file(path("a.exr")) == whole);
}

TEST_F(Merge, WhatIsMissingIsTold) {
  const Words paths = parts({{"--crop", "0,0,16,5", "--sample-range", "0..1"}, {"--crop", "0,5,16,12"}}, six);
  const Outcome outcome = merged(paths, "a.exr");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(
      outcome.err.find("the picture is not whole: samples 2..5 of the pixels from (0, 0) up to, but not "
                       "including, (16, 5) are missing"),
      std::string::npos)
      << outcome.err;
  EXPECT_NE(merged({paths[1]}, "a.exr")
                .err.find("samples 0..5 of the pixels from (0, 0) up to, but not including, (16, 5)"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(path("a.exr")));
  ASSERT_EQ(merged(paths, "a.exr", {"--incomplete"}).status, 0);
  const auto json = nlohmann::json::parse(tyndall({"inspect", path("a.exr"), "--json"}).out);
  EXPECT_EQ(json["unfinished"], "parts are missing");
  // A crop of which nothing is missing is that crop.
  ASSERT_EQ(merged({paths[1]}, "crop.exr", {"--incomplete"}).status, 0);
  EXPECT_TRUE(read_file(path("crop.exr")) ==
              read_file(rendered("b.exr", six + Words{"--crop", "0,5,16,12"})));
}

TEST_F(Merge, PartsThatDoNotBelongTogetherAreRefused) {
  const std::string first = rendered("first.tynpart", six + Words{"--sample-range", "0..2"});
  const auto second = [&](const Words& options) {
    return rendered("second.tynpart", Words{"--sample-range", "3..5"} + options);
  };
  const auto refused = [&](const std::string& other, const std::string& words) {
    const Outcome outcome = merged({first, other}, "a.exr");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find(words), std::string::npos) << words << "\n" << outcome.err;
    EXPECT_FALSE(fs::exists(path("a.exr")));
  };
  refused(second(six + Words{"--seed", "4"}), "'" + path("second.tynpart") +
                                                  "' is no part of the picture that '" + first +
                                                  "' is of: --seed was 0, is 4");
  refused(second(six + Words{"--set", "thickness=2"}), "--set thickness 2 is new");
  refused(second(six + Words{"--aov", "depth"}), "--aov depth is new");
  refused(second(six + Words{"--resolution", "8x6"}), "--resolution was 16x12, is 8x6");
  refused(rendered("o.tynpart", six + Words{"--sample-range", "2..5"}),
          "' both have samples 2..2 of all pixels");
  refused(first, "' both have samples 0..2 of all pixels");
  file("a.tyn", small_scene());
  refused(file("text.tynpart", "let a = 1\n"), "text.tynpart': it is no part of a picture");
  refused(path("nowhere.tynpart"), "nowhere.tynpart': no such file");
  const std::string bytes = read_file(second(six));
  refused(file("cut.tynpart", bytes.substr(0, bytes.size() - 100)), "it is damaged or cut short");
  EXPECT_EQ(tyndall({"merge", first, "-o", first}).status, 1);
  EXPECT_EQ(tyndall({"merge", "-o", path("a.exr")}).status, 2);
  EXPECT_EQ(tyndall({"merge", first}).status, 2);
  ASSERT_EQ(merged({first, path("second.tynpart")}, "a.exr").status, 0);
  const Words outputs = parts({{"--sample-range", "0..5"}}, six + Words{"--aov", "depth"});
  EXPECT_NE(merged(outputs, "a.png").err.find("output channels (depth), which only an .exr takes"),
            std::string::npos);
}

}  // namespace UNNAMED
}  // namespace tyndall::test
