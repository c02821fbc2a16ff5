// `tyndall compare` beyond its first numbers: FLIP, layers, maps, z-tests.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "image/image.h"

namespace tyndall::test {
namespace UNNAMED {

using image::Image;

class Compare : public CliTest {
 protected:
  std::string write(const std::string& name, const Image& image) const {
    EXPECT_EQ(image::write(path(name), image, {}), "");
    return path(name);
  }
  nlohmann::json compare(const std::string& a, const std::string& b,
                         const std::vector<std::string>& options = {}) const {
    std::vector<std::string> command{"compare", a, b, "--json"};
    command.insert(command.end(), options.begin(), options.end());
    const Outcome outcome = tyndall(command);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }
};

// All values of a channel alike.
Image flat(const std::vector<std::pair<std::string, float>>& channels, int width = 24, int height = 16) {
  Image image{width, height, {}, {}};
  for (const auto& [name, value] : channels) image.channels.push_back(name);
  for (int i = 0; i < width * height; ++i)
    for (const auto& [name, value] : channels) image.pixels.push_back(value);
  return image;
}
Image grey(float value) { return flat({{"R", value}, {"G", value}, {"B", value}}); }

TEST_F(Compare, NumbersOfKnownPictures) {
  const std::string a = write("a.exr", grey(0.5f)), b = write("b.exr", grey(1));
  const nlohmann::json numbers = compare(a, b);
  EXPECT_NEAR(numbers["mse"], 0.25, 1e-12);
  EXPECT_NEAR(numbers["relmse"], 0.25 / 1.01, 1e-12);
  EXPECT_NEAR(numbers["psnr"], 6.0206, 1e-4);
  EXPECT_EQ(numbers["flip_kind"], "hdr-flip");
  EXPECT_EQ(compare(a, a)["psnr"], nullptr) << "infinite";
  EXPECT_EQ(compare(a, a)["flip"], 0);
  EXPECT_FALSE(compare(a, b, {"--metric", "relmse"}).contains("flip")) << "it was not asked for";
  const nlohmann::json ldr = compare(write("a.png", grey(0.5f)), b);
  EXPECT_EQ(ldr["flip_kind"], "ldr-flip");
  EXPECT_EQ(tyndall({"compare", a, b, "--metric", "flip", "--max", "0.01"}).status, 3);
  EXPECT_EQ(tyndall({"compare", a, b, "--metric", "mse", "--max", "0.26"}).status, 0);
}

TEST_F(Compare, LayersThatBothHaveAreToldApart) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  const std::string a = write("a.exr", flat({{"R", 1},
                                             {"G", 1},
                                             {"B", 1},
                                             {"depth", infinite},
                                             {"albedo.R", 0.5f},
                                             {"albedo.G", 0.5f},
                                             {"albedo.B", 0.5f}})),
                    b = write("b.exr", flat({{"R", 1},
                                             {"G", 1},
                                             {"B", 1},
                                             {"cost", 3},
                                             {"depth", infinite},
                                             {"albedo.R", 0.25f},
                                             {"albedo.G", 0.5f},
                                             {"albedo.B", 0.5f}}));
  const nlohmann::json numbers = compare(a, b);
  EXPECT_EQ(numbers["relmse"], 0);
  EXPECT_EQ(numbers["layers"]["depth"]["relmse"], 0) << "nothing is met in either";
  EXPECT_EQ(numbers["layers"]["albedo"]["max_difference"], 0.25);
  EXPECT_EQ(numbers["layers"].size(), 2u);
  const Outcome none = tyndall({"compare", write("c.exr", flat({{"cost", 1}})), a});
  EXPECT_EQ(none.status, 1);
  EXPECT_NE(none.err.find("no channel in common"), std::string::npos) << none.err;
}

TEST_F(Compare, SizesAndValuesThatAreNoNumbersAreTold) {
  Image bad = grey(1);
  bad.at(5, 7, 1) = std::numeric_limits<float>::quiet_NaN();
  const std::string a = write("a.exr", bad), b = write("b.exr", grey(1));
  const Outcome outcome = tyndall({"compare", a, b, "--max", "1"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("NaN at pixel 5,7 in G"), std::string::npos) << outcome.err;
  const Outcome sizes = tyndall({"compare", write("c.exr", flat({{"R", 1}, {"G", 1}, {"B", 1}}, 8, 8)), b});
  EXPECT_EQ(sizes.status, 1);
  for (const char* told : {"8x8", "24x16", "--resolution"})
    EXPECT_NE(sizes.err.find(told), std::string::npos) << sizes.err;
}

TEST_F(Compare, MapsShowWhereTheErrorIs) {
  Image spot = grey(0.5f);
  for (std::size_t c = 0; c < 3; ++c) spot.at(12, 8, c) = 0.9f;
  const std::string a = write("a.exr", spot), b = write("b.exr", grey(0.5f));
  for (const char* of : {"flip", "ldr-flip", "relative"}) {
    ASSERT_EQ(tyndall({"compare", a, b, "--map", path("m.exr"), "--map-of", of}).status, 0);
    const image::ReadResult map = image::read(path("m.exr"));
    ASSERT_TRUE(map.image);
    EXPECT_GT(map.image->at(12, 8, 0), map.image->at(0, 0, 0)) << of;
    EXPECT_EQ(*std::max_element(map.image->pixels.begin(), map.image->pixels.end()), map.image->at(12, 8, 0))
        << of;
  }
  EXPECT_EQ(tyndall({"compare", a, b, "--map", path("m.png")}).status, 0);
  EXPECT_EQ(tyndall({"compare", a, b, "--map", a}).status, 1) << "it would overwrite the picture";
  EXPECT_EQ(tyndall({"compare", a, b, "--map", path("no/m.png")}).status, 1);
}

TEST_F(Compare, ZTestsTellNoiseFromChange) {
  const std::string scene = file("a.tyn", small_scene());
  const auto render = [&](const std::string& name, const std::vector<std::string>& options) {
    std::vector<std::string> command{"render", scene, "-o", path(name), "--samples", "64", "--quiet"};
    command.insert(command.end(), options.begin(), options.end());
    EXPECT_EQ(tyndall(command).status, 0);
    return path(name);
  };
  const std::string a = render("a.exr", {"--aov", "variance"}),
                    b = render("b.exr", {"--aov", "variance", "--seed", "1"}),
                    thicker = render("c.exr", {"--aov", "variance", "--seed", "2", "--set", "thickness=12"}),
                    plain = render("d.exr", {}), other = render("e.exr", {"--seed", "3"});
  EXPECT_EQ(tyndall({"compare", a, b, "--significance", "0.001"}).status, 0);
  const Outcome far = tyndall({"compare", thicker, a, "--significance", "0.001"});
  EXPECT_EQ(far.status, 3);
  EXPECT_NE(far.err.find("standard errors away"), std::string::npos) << far.err;
  const Outcome none = tyndall({"compare", plain, other, "--significance", "0.001"});
  EXPECT_EQ(none.status, 1);
  EXPECT_NE(none.err.find("--aov variance"), std::string::npos) << none.err;
  EXPECT_EQ(tyndall({"compare", a, b, "--significance", "1"}).status, 2);
}

TEST_F(Compare, GreyIsComparedWithColours) {
  const std::string y = write("y.png", flat({{"Y", 0.5f}})), rgb = write("rgb.png", grey(0.5f));
  for (const auto& [a, b] : {std::pair(y, rgb), {rgb, y}}) {
    EXPECT_EQ(compare(a, b)["mse"], 0);
    EXPECT_EQ(compare(a, b)["flip"], 0);
  }
  const std::string red = write("red.png", flat({{"R", 0.5f}, {"G", 0}, {"B", 0}}));
  EXPECT_GT(compare(red, y)["mse"], 0.05);
}

TEST_F(Compare, HdrFlipIsOfLight) {
  const std::string png = write("a.png", grey(0.5f)), exr = write("b.exr", grey(1));
  for (const std::string& other : {png, exr}) {
    const Outcome outcome = tyndall({"compare", png, other, "--metric", "hdr-flip"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("ldr-flip compares what a display shows"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(tyndall({"compare", png, exr, "--map-of", "hdr-flip", "--map", path("map.png")}).status, 1);
  EXPECT_EQ(tyndall({"compare", exr, exr, "--metric", "hdr-flip"}).status, 0);
}

TEST_F(Compare, NoiseThatIsNotIndependentIsNotTested) {
  const std::string scene = file("scene.tyn", small_scene());
  const auto rendered = [&](const std::string& name, std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"render", scene, "-o", path(name), "--aov", "variance", "--samples", "8", "--quiet"});
    EXPECT_EQ(tyndall(options).status, 0);
    return path(name);
  };
  const std::string a = rendered("a.exr", {}), b = rendered("b.exr", {"--samples", "16"}),
                    c = rendered("c.exr", {"--seed", "1"}),
                    smooth = rendered("d.exr", {"--seed", "2", "--denoise"});
  EXPECT_TRUE(compare(a, c).contains("z_test"));
  EXPECT_FALSE(compare(a, b).contains("z_test"));
  EXPECT_FALSE(compare(a, smooth).contains("z_test"));
  const Outcome same = tyndall({"compare", a, b, "--significance", "0.001"});
  EXPECT_EQ(same.status, 1);
  EXPECT_NE(same.err.find("random numbers of seed 0"), std::string::npos) << same.err;
  const Outcome denoised = tyndall({"compare", smooth, a, "--significance", "0.001"});
  EXPECT_EQ(denoised.status, 1);
  EXPECT_NE(denoised.err.find("denoised"), std::string::npos) << denoised.err;
}

}  // namespace UNNAMED
}  // namespace tyndall::test
