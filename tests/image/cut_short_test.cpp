// Picture files that end too early are errors, in each format, wherever they end.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "image/image.h"
#include "support/test_folder.h"

namespace tyndall::image {
namespace UNNAMED {

namespace fs = std::filesystem;

// What follows the header of formats that are plain enough to be written here.
std::string filling(std::size_t bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i) text += static_cast<char>(i * 37 % 61);
  return text;
}

struct Row {
  std::string name;
  std::string bytes{};  // none: of tests/image/pictures
};

const std::vector<Row>& rows() {
  static const std::vector<Row> table{
      {"small.jpg"},
      {"small.hdr"},
      {"strips.tif"},
      {"tiles.tif"},
      {"lines.exr"},
      {"tiles.exr"},
      {"small.bmp"},
      {"small.iff"},
      {"small.gif"},
      {"colour.pfm", "PF\n16 12\n-1.0\n" + filling(16 * 12 * 12)},
      {"grey.pfm", "Pf\n16 12\n-1.0\n" + filling(16 * 12 * 4)},
      {"colour.ppm", "P6\n16 12\n255\n" + filling(16 * 12 * 3)},
      {"deep.ppm", "P6\n16 12\n65535\n" + filling(16 * 12 * 6)},
      {"grey.pgm", "P5\n16 12\n255\n" + filling(16 * 12)},
      {"bits.pbm", "P4\n16 12\n" + filling(2 * 12)},
      {"colour.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\x10\0\x0c\0\x18\0", 18) + filling(16 * 12 * 3)},
  };
  return table;
}

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class CutShort : public testing::Test {
 protected:
  std::string file(const std::string& name, std::string_view bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return (folder_ / name).string();
  }

 private:
  fs::path folder_ = test_folder();
};

constexpr std::uint64_t plenty = std::uint64_t{1} << 30;

void expect_error(const PlanesResult& result, const std::string& what) {
  EXPECT_NE(result.error.find("cannot read '"), std::string::npos) << what;
  EXPECT_EQ(result.error.find('\n'), std::string::npos) << what << result.error;
  EXPECT_TRUE(result.planes.empty()) << what;
}

TEST_F(CutShort, LookedUpPicturesAreErrors) {
  for (const Row& row : rows()) {
    const std::string whole = row.bytes.empty()
                                  ? contents(fs::path(TYNDALL_SOURCE_DIR "/tests/image/pictures") / row.name)
                                  : row.bytes;
    ASSERT_FALSE(whole.empty()) << row.name;
    const PlanesResult good = read_planes(file(row.name, whole), "", plenty);
    EXPECT_EQ(good.error, "") << row.name;
    EXPECT_FALSE(good.planes.empty()) << row.name;
    for (std::size_t tenths = 1; tenths < 10; ++tenths)
      expect_error(read_planes(file(row.name, std::string_view(whole).substr(0, whole.size() * tenths / 10)),
                               "", plenty),
                   fmt::format("{} at {}/10", row.name, tenths));
  }
}

TEST_F(CutShort, ComparedPicturesAreErrors) {
  Image image{16, 12, {"R", "G", "B"}, {}};
  for (int i = 0; i < 16 * 12 * 3; ++i) image.pixels.push_back(static_cast<float>(i * 37 % 61) / 61);
  for (const std::string name : {"a.exr", "a.png"}) {
    const std::string path = file(name, "");
    ASSERT_EQ(write(path, image, {}), "");
    const std::string whole = contents(path);
    for (std::size_t tenths = 1; tenths < 10; ++tenths) {
      const std::string part = file(name, std::string_view(whole).substr(0, whole.size() * tenths / 10));
      const ReadResult result = read(part);
      EXPECT_FALSE(result.image) << name << tenths;
      EXPECT_NE(result.error, "") << name << tenths;
      expect_error(read_planes(part, "", plenty), fmt::format("{} at {}/10", name, tenths));
    }
  }
}

// Cameras add to the end of a JPEG, and a preview inside of it ends before it does.
TEST_F(CutShort, JpegsEndWhereTheyEnd) {
  const std::string whole = contents(TYNDALL_SOURCE_DIR "/tests/image/pictures/small.jpg");
  EXPECT_EQ(read_planes(file("more.jpg", whole + "a film"), "", plenty).error, "");
  const std::string preview = std::string("\xff\xe5\x00\x06", 4) + "\xff\xd9zz";
  const std::string with_preview = whole.substr(0, 2) + preview + whole.substr(2);
  EXPECT_EQ(read_planes(file("preview.jpg", with_preview), "", plenty).error, "");
  expect_error(read_planes(file("cut.jpg", with_preview.substr(0, with_preview.size() / 2)), "", plenty),
               "preview");
}

}  // namespace UNNAMED
}  // namespace tyndall::image
