// `render --denoise`: what is written, and that it is the same however the picture came about.
#include <gtest/gtest.h>

#include <algorithm>

#include "cli/run_program.h"
#include "denoise/denoise.h"
#include "image/image.h"

namespace tyndall::test {
namespace UNNAMED {

using Words = std::vector<std::string>;

class DenoiseCommand : public CliTest {
 protected:
  void render(const Words& options) const {
    Words words{"render", file("a.tyn", small_scene()), "--quiet", "--resolution", "32x24", "--samples", "8"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = tyndall(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
  image::Image picture(const std::string& name) const {
    const image::ReadResult read = image::read(path(name));
    EXPECT_EQ(read.error, "");
    return read.image.value_or(image::Image{});
  }
};

// The values of these channels, pixel by pixel; fails where one is missing.
std::vector<float> channels_of(const image::Image& image, const Words& names) {
  std::vector<std::size_t> channels;
  for (const std::string& name : names) {
    const auto found = std::find(image.channels.begin(), image.channels.end(), name);
    if (found == image.channels.end()) {
      ADD_FAILURE() << name;
      return {};
    }
    channels.push_back(static_cast<std::size_t>(found - image.channels.begin()));
  }
  std::vector<float> values;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (const std::size_t channel : channels) values.push_back(image.at(x, y, channel));
  return values;
}
const Words rgb{"R", "G", "B"}, noisy{"noisy.R", "noisy.G", "noisy.B"};
const std::string all_outputs =
    "depth,normal,albedo,volume_direct,volume_indirect,volume_emission,transmittance,half";

TEST_F(DenoiseCommand, KeepsTheUndenoisedPictureInAnExr) {
  render({"-o", path("denoised.exr"), "--denoise"});
  render({"-o", path("plain.exr"), "--aov", all_outputs});
  const image::Image denoised = picture("denoised.exr"), plain = picture("plain.exr");
  EXPECT_EQ(channels_of(denoised, noisy), channels_of(plain, rgb));
  EXPECT_NE(channels_of(denoised, rgb), channels_of(plain, rgb));
  for (const char* name : {"half.R", "half.volume_direct.G", "depth", "half.normal.Z"})
    EXPECT_EQ(channels_of(denoised, {name}), channels_of(plain, {name})) << name;
}

// What was denoised while rendering is what the file gives.
TEST_F(DenoiseCommand, CanBeDoneLaterFromTheFile) {
  render({"-o", path("denoised.exr"), "--denoise"});
  render({"-o", path("plain.exr"), "--aov", all_outputs});
  const std::vector<float> expected = channels_of(picture("denoised.exr"), rgb);
  for (const char* name : {"denoised.exr", "plain.exr"}) {
    const denoise::Result result = denoise::denoise(picture(name));
    EXPECT_EQ(result.error, "");
    EXPECT_EQ(result.picture.pixels, expected) << name;
  }
}

// And `develop --denoise` is the picture that `render --denoise` develops.
TEST_F(DenoiseCommand, DevelopsFilesOfHalves) {
  render({"-o", path("denoised.png"), "--denoise"});
  render({"-o", path("plain.exr"), "--aov", all_outputs});
  render({"-o", path("without.exr")});
  const auto develop = [&](const char* from, const Words& options) {
    Words words{"develop", path(from), "-o", path("developed.png"), "--denoise"};
    words.insert(words.end(), options.begin(), options.end());
    return tyndall(words);
  };
  EXPECT_EQ(develop("plain.exr", {}).status, 0);
  EXPECT_EQ(picture("developed.png").pixels, picture("denoised.png").pixels);
  const Outcome refused = develop("without.exr", {});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("half.R"), std::string::npos) << refused.err;
  EXPECT_NE(develop("plain.exr", {"--layer", "albedo"}).status, 0);
}

TEST_F(DenoiseCommand, WritesPngsToo) {
  render({"-o", path("denoised.png"), "--denoise"});
  render({"-o", path("plain.png")});
  const image::Image denoised = picture("denoised.png");
  EXPECT_EQ(denoised.channels, rgb);
  EXPECT_NE(denoised.pixels, picture("plain.png").pixels);
}

TEST_F(DenoiseCommand, PartsAreDenoisedWhenTheyAreMerged) {
  render({"-o", path("whole.exr"), "--denoise"});
  for (const char* range : {"0..2", "3..7"})
    render({"-o", path(std::string(range) + ".tynpart"), "--denoise", "--sample-range", range});
  for (const char* format : {".exr", ".png"}) {
    const Outcome merged = tyndall({"merge", path("0..2.tynpart"), path("3..7.tynpart"), "--quiet", "-o",
                                    path(std::string("merged") + format)});
    EXPECT_EQ(merged.status, 0) << merged.err;
  }
  EXPECT_EQ(read_file(path("merged.exr")), read_file(path("whole.exr")));
  EXPECT_EQ(picture("merged.png").channels, rgb);
}

TEST_F(DenoiseCommand, IsPartOfWhatAPictureIsMadeOf) {
  render({"-o", path("a.exr")});
  const std::string plain = read_file(path("a.exr"));
  render({"-o", path("a.exr"), "--denoise", "--resume"});
  const std::string denoised = read_file(path("a.exr"));
  EXPECT_NE(denoised, plain);
  render({"-o", path("a.exr"), "--resume"});
  EXPECT_EQ(read_file(path("a.exr")), plain);
}

// Channels that only one of them has are left out.
TEST_F(DenoiseCommand, IsComparedByItsColors) {
  render({"-o", path("denoised.exr"), "--denoise"});
  render({"-o", path("plain.exr")});
  render({"-o", path("halves.exr"), "--aov", "half"});
  EXPECT_EQ(tyndall({"compare", path("denoised.exr"), path("plain.exr"), "--max", "0"}).status, 3);
  EXPECT_EQ(tyndall({"compare", path("denoised.exr"), path("plain.exr"), "--max", "1"}).status, 0);
  EXPECT_EQ(tyndall({"compare", path("denoised.exr"), path("halves.exr"), "--max", "0"}).status, 3);
}

TEST_F(DenoiseCommand, WantsFourSamples) {
  const Outcome outcome =
      tyndall({"render", file("a.tyn", small_scene()), "-o", path("a.exr"), "--denoise", "--samples", "3"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("at least 4 samples"), std::string::npos) << outcome.err;
}

}  // namespace UNNAMED
}  // namespace tyndall::test
