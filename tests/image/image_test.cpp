// Pictures: what is written is read back; files appear whole or not at all.
#include "image/image.h"
#include "support/test_folder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>

namespace tyndall::image {
namespace UNNAMED {

namespace fs = std::filesystem;

// A directory of the test's own, removed at its end.
class ImageFiles : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  std::size_t file_count() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(directory_), fs::directory_iterator()));
  }

 private:
  fs::path directory_ = test_folder();
};

Image ramp(int width, int height) {
  Image image{width, height, {"R", "G", "B"}, {}};
  for (int i = 0; i < width * height * 3; ++i) image.pixels.push_back(static_cast<float>(i) * 0.37f - 5);
  return image;
}

std::string text_of(const Metadata& metadata, const std::string& name) {
  for (const auto& [key, value] : metadata)
    if (key == name) return value;
  return {};
}

TEST_F(ImageFiles, ExrKeepsEveryFloatAndTheMetadata) {
  Image image = ramp(7, 5);
  image.pixels[4] = std::numeric_limits<float>::quiet_NaN();
  image.pixels[5] = std::numeric_limits<float>::infinity();
  ASSERT_EQ(write(path("a.exr"), image, {{"tyndall:seed", "17"}, {"Software", "Tyndall"}}), "");
  const ReadResult back = read(path("a.exr"));
  ASSERT_TRUE(back.image) << back.error;
  EXPECT_EQ(back.image->width, 7);
  EXPECT_EQ(back.image->height, 5);
  EXPECT_EQ(back.image->channels, image.channels);
  ASSERT_EQ(back.image->pixels.size(), image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (i == 4) {
      EXPECT_TRUE(std::isnan(back.image->pixels[i]));
    } else {
      EXPECT_EQ(back.image->pixels[i], image.pixels[i]) << i;
    }
  }
  EXPECT_EQ(text_of(back.metadata, "tyndall:seed"), "17");
  EXPECT_EQ(text_of(back.metadata, "Software"), "Tyndall");
}

TEST_F(ImageFiles, PngIsExposedClampedSrgb) {
  const Image image{6,
                    1,
                    {"R", "G", "B"},
                    {0, 0, 0, 0.25f, 0.25f, 0.25f, 0.5f, 0.5f, 0.5f, 9, 9, 9, -1, -1, -1,
                     std::numeric_limits<float>::quiet_NaN(), 0.0015625f, 0.1f}};
  ASSERT_EQ(
      write(path("a.png"), image, {{"tyndall:seed", "17"}}, {.exposure = {1}, .tonemap = Tonemap::none}), "");
  const ReadResult back = read(path("a.png"));
  ASSERT_TRUE(back.image) << back.error;
  EXPECT_EQ(back.image->at(0, 0, 0), 0);
  // 0.5 linear is 187.5 of 255 in sRGB: one 8-bit step there is 0.0071 of linear light.
  EXPECT_NEAR(back.image->at(1, 0, 0), 0.5f, 0.0036f);
  EXPECT_EQ(back.image->at(2, 0, 1), 1);
  EXPECT_EQ(back.image->at(3, 0, 2), 1);
  EXPECT_EQ(back.image->at(4, 0, 0), 0);
  EXPECT_EQ(back.image->at(5, 0, 0), 0);
  EXPECT_NEAR(back.image->at(5, 0, 1), 0.003125f, 0.5f / 255 / 12.92f);
  EXPECT_NE(text_of(back.metadata, "ImageDescription").find("tyndall:seed: 17"), std::string::npos);
}

// A part of a picture comes back as the whole, black around it.
TEST_F(ImageFiles, APartStandsInTheWhole) {
  Image part = ramp(2, 3);
  for (float& value : part.pixels) value = 1;
  part.place = {4, 5, 9, 10};
  for (const std::string name : {"a.exr", "a.png", "a.tif", "a.jpg"}) {
    ASSERT_EQ(write(path(name), part, {}), "");
    const ReadResult back = read(path(name));
    ASSERT_TRUE(back.image) << back.error;
    EXPECT_EQ(back.image->width, 9);
    EXPECT_EQ(back.image->height, 10);
    for (int y = 0; y < 10; ++y)
      for (int x = 0; x < 9; ++x)
        EXPECT_NEAR(back.image->at(x, y, 1), x >= 4 && x < 6 && y >= 5 && y < 8 ? 1 : 0,
                    name == "a.jpg" ? 0.06 : 0)
            << name << x << "," << y;
  }
}

// libpng says so on standard error by itself: the words of libraries are not ours.
TEST_F(ImageFiles, LibrariesSayNothingThemselves) {
  ASSERT_EQ(write(path("a.png"), ramp(8, 8), {}), "");
  std::fstream file(path("a.png"), std::ios::in | std::ios::out | std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  for (std::size_t i = 40; i < bytes.size(); i += 7) bytes[i] = static_cast<char>(bytes[i] ^ 0x55);
  file.clear();
  file.seekp(0);
  file << bytes;
  file.close();
  testing::internal::CaptureStderr();
  const ReadResult result = read(path("a.png"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_FALSE(result.image);
  EXPECT_NE(result.error, "");
}

TEST_F(ImageFiles, TheSamePictureIsTheSameBytes) {
  const auto bytes = [&](const std::string& name) {
    EXPECT_EQ(write(path(name), ramp(33, 20), {{"tyndall:seed", "1"}}), "");
    std::ifstream file(path(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(bytes("a.exr"), bytes("b.exr"));
  EXPECT_EQ(bytes("a.png"), bytes("b.png"));
  EXPECT_EQ(bytes("a.jpg"), bytes("b.jpg"));
  EXPECT_EQ(bytes("a.tif"), bytes("b.tif"));
  // Also at another time of day.
  EXPECT_EQ(text_of(read(path("a.exr")).metadata, "DateTime"), "");
  for (const std::string name : {"a.png", "a.jpg", "a.tif"})
    EXPECT_EQ(text_of(read(path(name)).metadata, "DateTime"), "") << name;
}

// 16 bits of a TIFF keep what 8 would not; 8 of a JPEG are near.
TEST_F(ImageFiles, TiffHasSixteenBitsAndJpegIsNear) {
  Image image{64, 1, {"R", "G", "B"}, {}};
  for (int x = 0; x < 64; ++x) image.pixels.insert(image.pixels.end(), 3, static_cast<float>(x) / 6300);
  for (const std::string name : {"a.tif", "a.tiff", "a.jpg", "a.jpeg"}) {
    ASSERT_EQ(write(path(name), image, {{"tyndall:seed", "17"}}), "");
    const ReadResult back = read(path(name));
    ASSERT_TRUE(back.image) << back.error;
    const float most = name.starts_with("a.t") ? 1.0f / 65535 : 0.003f;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      EXPECT_NEAR(back.image->pixels[i], image.pixels[i], most) << name << i;
    EXPECT_NE(text_of(back.metadata, "ImageDescription").find("tyndall:seed: 17"), std::string::npos) << name;
    EXPECT_EQ(back.view, View::of_numbers());
  }
}

// A JPEG and a TIFF have room for 64 kB: what is longer is left out, and the rest told.
TEST_F(ImageFiles, LongMetadataAreNoProblem) {
  for (const std::string name : {"a.exr", "a.png", "a.tif", "a.jpg"}) {
    ASSERT_EQ(write(path(name), ramp(2, 2),
                    {{"tyndall:long", std::string(200'000, 'x')},
                     {"tyndall:middle", std::string(50'000, 'y')},
                     {"tyndall:seed", "17"}}),
              "");
    std::string told;
    for (const auto& [key, value] : read_metadata(path(name)).metadata) told += key + ": " + value + "\n";
    EXPECT_NE(told.find("tyndall:seed: 17"), std::string::npos) << name;
    EXPECT_NE(told.find("yyy"), std::string::npos) << name;
    EXPECT_EQ(told.find("xxx") != std::string::npos, name == "a.exr" || name == "a.png") << name;
  }
}

// A view is told by an EXR and changes nothing of it; another one can be told later.
TEST_F(ImageFiles, AnExrTellsItsView) {
  Image part = ramp(3, 2);
  part.place = {4, 5, 9, 10};
  const View view{.exposure = {-0.5, true}, .tonemap = Tonemap::neutral}, later{.exposure = {2}};
  ASSERT_EQ(write(path("a.exr"), part, {{"tyndall:seed", "17"}}, view), "");
  const ReadResult first = read(path("a.exr"));
  ASSERT_TRUE(first.image);
  EXPECT_EQ(first.view, view);
  EXPECT_EQ(first.image->at(4, 5, 0), part.at(0, 0, 0));
  const auto size = fs::file_size(path("a.exr"));
  ASSERT_EQ(retell(path("a.exr"), {{"tyndall:seed", "18"}}, later), "");
  const ReadResult second = read(path("a.exr"));
  ASSERT_TRUE(second.image) << second.error;
  EXPECT_EQ(second.view, later);
  EXPECT_EQ(second.image->pixels, first.image->pixels);
  EXPECT_EQ(text_of(second.metadata, "tyndall:seed"), "18");
  EXPECT_LT(fs::file_size(path("a.exr")), size + 100) << "it still has no pixels but its own";
}

TEST_F(ImageFiles, OverwritesAndLeavesNothingBeside) {
  ASSERT_EQ(write(path("a.exr"), ramp(2, 2), {}), "");
  ASSERT_EQ(write(path("a.exr"), ramp(3, 2), {}), "");
  EXPECT_EQ(read(path("a.exr")).image->width, 3);
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(ImageFiles, BadPathsAreToldBeforeAndAtWriting) {
  fs::create_directory(path("folder.exr"));
  const struct {
    std::string path, wanted;
  } cases[] = {
      {path("a.bmp"), "unknown extension '.bmp'"},      {path("a"), "no extension"},
      {path("no/such/a.exr"), "there is no directory"}, {path("folder.exr"), "it is a directory"},
      {"/proc/a.exr", "cannot write '/proc/a.exr'"},  // a directory in which not even root can make files
  };
  for (const auto& c : cases) {
    EXPECT_NE(check_writable(c.path).find(c.wanted), std::string::npos)
        << c.path << ": " << check_writable(c.path);
    EXPECT_NE(write(c.path, ramp(2, 2), {}).find(c.wanted), std::string::npos) << c.path;
  }
  EXPECT_EQ(check_writable(path("A.PNG")), "");
  EXPECT_EQ(file_count(), 1u) << "checking leaves nothing behind";
}

// A file-size limit stands for the full disk: the system refuses the bytes half-way.
TEST_F(ImageFiles, AFullDiskLeavesTheOldPicture) {
  ASSERT_EQ(write(path("a.exr"), ramp(2, 2), {}), "");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit tiny{4096, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &tiny);
  const std::string message = write(path("a.exr"), ramp(200, 200), {});
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);
  EXPECT_NE(message.find("cannot write"), std::string::npos) << message;
  EXPECT_EQ(file_count(), 1u);
  EXPECT_EQ(read(path("a.exr")).image->width, 2);
}

TEST_F(ImageFiles, UnreadableFilesAreErrors) {
  std::ofstream(path("rubbish.exr")) << "this is no picture";
  std::ofstream(path("empty.png")).flush();
  for (const std::string name : {"rubbish.exr", "empty.png", "missing.exr", "a.txt"}) {
    const ReadResult result = read(path(name));
    EXPECT_FALSE(result.image) << name;
    EXPECT_NE(result.error.find(name), std::string::npos) << result.error;
  }
}

TEST_F(ImageFiles, ATruncatedPictureIsAnError) {
  ASSERT_EQ(write(path("a.exr"), ramp(64, 64), {}), "");
  fs::resize_file(path("a.exr"), fs::file_size(path("a.exr")) / 2);
  EXPECT_FALSE(read(path("a.exr")).image);
}

}  // namespace UNNAMED
}  // namespace tyndall::image
