// The laws of denoising, on pictures whose truth and noise are known.
#include "denoise/denoise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "denoise/noisy_picture.h"

namespace tyndall::denoise {
namespace UNNAMED {

std::function<double(int, int)> everywhere(double deviation) {
  return [deviation](int, int) { return deviation; };
}
ColorAt grey(const std::function<double(int x, int y)>& value) {
  return [value](int x, int y) { return std::array{value(x, y), value(x, y), value(x, y)}; };
}
// Light that falls off smoothly, with an edge at x = 60 and fine stripes below y = 60.
double scene_at(int x, int y) {
  const double smooth = 0.5 + 0.4 * std::sin(x / 25.0) * std::cos(y / 31.0);
  return smooth * (x < 60 ? 1 : 0.2) * (y < 60 ? 1 : (x / 2 + y / 3) % 2 ? 1.5 : 0.7);
}

image::Image denoised(const image::Image& image, int threads = 0) {
  Result result = denoise(image, threads);
  EXPECT_EQ(result.error, "");
  return std::move(result.picture);
}

TEST(Denoise, WithoutNoiseNothingChanges) {
  NoisyPicture picture(90, 70, 1);
  picture.add_light(grey(scene_at), everywhere(0), "volume_direct");
  picture.add_light(grey([](int x, int y) { return x % 7 == 3 ? -0.25 : 1e6 * (y % 3); }), everywhere(0));
  const image::Image noisy = picture.image(), result = denoised(noisy);
  for (int y = 0; y < 70; ++y)
    for (int x = 0; x < 90; ++x)
      for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(result.at(x, y, c), noisy.at(x, y, c)) << x << ' ' << y;
}

// The change is of the noise's size, however small the noise is: over edges and stripes that no feature
// knows.
TEST(Denoise, GoesToTheUndenoisedPictureAsTheNoiseGoesToZero) {
  for (const double deviation : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    NoisyPicture picture(120, 100, 2);
    picture.add_light(grey(scene_at), everywhere(deviation));
    const image::Image noisy = picture.image(), result = denoised(noisy);
    double sum = 0;
    for (int y = 0; y < 100; ++y)
      for (int x = 0; x < 120; ++x)
        sum += std::pow(double(result.at(x, y, 1)) - double(noisy.at(x, y, 1)), 2);
    EXPECT_LT(std::sqrt(sum / (120 * 100)), deviation) << deviation;
  }
}

TEST(Denoise, NeverWorsensThePicture) {
  for (const double deviation : {1.0, 0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4}) {
    NoisyPicture picture(120, 100, 3);
    picture.add_light(grey(scene_at), everywhere(deviation));
    const image::Image noisy = picture.image();
    EXPECT_LT(relative_error(denoised(noisy), grey(scene_at)), relative_error(noisy, grey(scene_at)))
        << deviation;
  }
}

TEST(Denoise, RemovesTheNoiseOfSmoothLight) {
  const auto truth = grey([](int x, int y) { return 0.5 + 0.4 * std::sin(x / 40.0) * std::cos(y / 50.0); });
  NoisyPicture picture(120, 100, 4);
  picture.add_light(truth, everywhere(0.2));
  const image::Image noisy = picture.image();
  EXPECT_LT(relative_error(denoised(noisy), truth), relative_error(noisy, truth) / 20);
}

// Fine stripes of a texture under strong noise: no patch tells them, the albedo does.
TEST(Denoise, KeepsATextureThatFollowsTheAlbedo) {
  const auto albedo = [](int x, int y) { return (x / 2 + y / 3) % 2 ? 0.8 : 0.3; };
  const auto truth = grey([&](int x, int y) { return albedo(x, y) * (1 + 0.5 * std::sin(x / 30.0)); });
  NoisyPicture picture(120, 100, 5);
  picture.add_light(truth, everywhere(0.4));
  const double without = relative_error(denoised(picture.image()), truth);
  picture.add_feature("albedo", "RGB", grey(albedo));
  const double with = relative_error(denoised(picture.image()), truth);
  EXPECT_LT(with, relative_error(picture.image(), truth) / 20);
  EXPECT_LT(with, without / 3);
}

// Blurred by depth of field or motion, features are noisy themselves: their noise is not taken for the
// light's.
TEST(Denoise, DoesNotFollowTheNoiseOfFeatures) {
  const auto truth = grey([](int x, int y) { return 0.5 + 0.4 * std::sin(x / 40.0) * std::cos(y / 50.0); });
  NoisyPicture picture(120, 100, 14);
  picture.add_light(truth, everywhere(0.2));
  const double without = relative_error(denoised(picture.image()), truth);
  picture.add_feature("albedo", "RGB", truth, 0.3);
  picture.add_feature("normal", "XYZ", truth, 0.3);
  EXPECT_LT(relative_error(denoised(picture.image()), truth), 1.2 * without);
}

// An edge that no feature knows, ten times the noise: the pixels on its sides keep their means.
TEST(Denoise, KeepsEdgesOfLight) {
  const auto truth = grey([](int x, int) { return x < 50 ? 1.0 : 0.2; });
  NoisyPicture picture(100, 100, 6);
  picture.add_light(truth, everywhere(0.08));
  const image::Image result = denoised(picture.image());
  for (const int x : {48, 49, 50, 51}) {
    double mean = 0;
    for (int y = 0; y < 100; ++y) mean += double(result.at(x, y, 0)) / 100;
    EXPECT_NEAR(mean, truth(x, 0)[0], 0.02) << x;
  }
}

// Light of media has its own edges: those of the surface behind it are not printed into it, nor the reverse.
TEST(Denoise, FiltersLayersApart) {
  const auto surface = grey([](int x, int) { return x / 10 % 2 ? 1.0 : 0.1; });
  const auto shaft = grey([](int x, int y) { return (x + y) / 15 % 2 ? 0.6 : 0.2; });
  const auto both = [&](int x, int y) {
    const double sum = surface(x, y)[0] + shaft(x, y)[0];
    return std::array{sum, sum, sum};
  };
  const auto picture_of = [&](bool apart) {
    NoisyPicture picture(120, 100, 7);
    picture.add_light(surface, everywhere(0.02));
    picture.add_light(shaft, everywhere(0.2), apart ? "volume_direct" : "");
    return picture.image();
  };
  EXPECT_LT(relative_error(denoised(picture_of(true)), both),
            relative_error(denoised(picture_of(false)), both));
}

TEST(Denoise, RemovesFireflies) {
  const auto truth = grey([](int, int) { return 0.5; });
  NoisyPicture picture(100, 100, 8);
  picture.add_light(truth, everywhere(0.05));
  for (int i = 0; i < 20; ++i) picture.add_firefly(5 * i, (37 * i) % 100, 50);
  const image::Image noisy = picture.image();
  EXPECT_LT(relative_error(denoised(noisy), truth), relative_error(noisy, truth) / 100);
}

TEST(Denoise, KeepsTheMean) {
  NoisyPicture picture(120, 100, 9);
  picture.add_light(grey(scene_at), [](int x, int y) { return 0.3 * scene_at(x, y); });
  const image::Image noisy = picture.image(), result = denoised(noisy);
  const auto mean_of = [](const image::Image& image) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) sum += double(image.at(x, y, 1));
    return sum / (image.width * image.height);
  };
  EXPECT_NEAR(mean_of(result) / mean_of(noisy), 1, 0.01);
}

TEST(Denoise, IsTheSameForAnyNumberOfThreads) {
  NoisyPicture picture(200, 150, 10);
  picture.add_light(grey(scene_at), everywhere(0.1));
  const image::Image noisy = picture.image();
  EXPECT_EQ(denoised(noisy, 1).pixels, denoised(noisy, 3).pixels);
}

TEST(Denoise, TakesPicturesOfAnySize) {
  for (const auto& [width, height] :
       {std::pair(1, 1), std::pair(3, 150), std::pair(150, 2), std::pair(65, 64)}) {
    NoisyPicture picture(width, height, 11);
    picture.add_light(grey(scene_at), everywhere(0.1));
    const image::Image result = denoised(picture.image());
    EXPECT_EQ(result.pixels.size(), static_cast<std::size_t>(3 * width * height));
    for (const float value : result.pixels) EXPECT_TRUE(std::isfinite(value));
  }
}

// An image of others may have anything in it; and depth is infinite where nothing is met.
TEST(Denoise, GivesFiniteValues) {
  NoisyPicture picture(80, 60, 12);
  picture.add_light(grey(scene_at), everywhere(0.1));
  picture.add_feature("albedo", "RGB", grey(scene_at));
  image::Image noisy = picture.image();
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 3e38f,
                       -3e38f};
  for (std::size_t i = 0; i < 40; ++i)
    noisy.at(static_cast<int>(7 * i % 80), static_cast<int>(11 * i % 60), i % noisy.channels.size()) =
        bad[i % 4];
  for (const float value : denoised(noisy).pixels) ASSERT_TRUE(std::isfinite(value));
}

TEST(Denoise, TellsWhatIsMissing) {
  const image::Image plain{2, 1, {"R", "G", "B"}, std::vector<float>(6)};
  EXPECT_NE(denoise(plain).error.find("half.R"), std::string::npos);
  const image::Image grey_one{2, 1, {"Y"}, std::vector<float>(2)};
  EXPECT_NE(denoise(grey_one).error.find("R, G and B"), std::string::npos);
}

// A picture that is denoised already keeps what it was as noisy.R, …: the result is the same.
TEST(Denoise, BeginsFromTheUndenoisedPicture) {
  NoisyPicture picture(60, 50, 13);
  picture.add_light(grey(scene_at), everywhere(0.1));
  image::Image noisy = picture.image();
  const image::Image result = denoised(noisy);
  image::Image both = noisy;
  for (const char* name : {"noisy.R", "noisy.G", "noisy.B"}) both.channels.emplace_back(name);
  both.pixels.clear();
  for (std::size_t i = 0; i < noisy.pixels.size(); i += 6) {
    both.pixels.insert(both.pixels.end(), 3, 7.0f);
    for (std::size_t c = 3; c < 6; ++c) both.pixels.push_back(noisy.pixels[i + c]);
    for (std::size_t c = 0; c < 3; ++c) both.pixels.push_back(noisy.pixels[i + c]);
  }
  EXPECT_EQ(denoised(both).pixels, result.pixels);
}

}  // namespace UNNAMED
}  // namespace tyndall::denoise
