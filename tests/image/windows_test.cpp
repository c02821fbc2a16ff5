// Pictures whose stored pixels are not those that are shown, and files that claim more than they hold.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>

#include "image/image.h"
#include "support/test_folder.h"

namespace tyndall::image {
namespace UNNAMED {

namespace fs = std::filesystem;

// Pixels from (x0, y0) to (x1, y1), both included.
struct Window {
  int x0, y0, x1, y1;
  int width() const { return x1 - x0 + 1; }
  int height() const { return y1 - y0 + 1; }
  bool holds(int x, int y) const { return x >= x0 && x <= x1 && y >= y0 && y <= y1; }
};

template <class T>
void put(std::string& bytes, T value) {  // the machines that we build for are little-endian, as the format is
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}
void put(std::string& bytes, const Window& w) {
  for (const int number : {w.x0, w.y0, w.x1, w.y1}) put(bytes, std::int32_t{number});
}
void put_attribute(std::string& bytes, const char* name, const char* type, const std::string& value) {
  bytes.append(name).push_back('\0');
  bytes.append(type).push_back('\0');
  put(bytes, static_cast<std::int32_t>(value.size()));
  bytes += value;
}

// An OpenEXR file of one part, scan lines without compression; channels B, G and R.
std::string exr(const Window& display, const Window& data, const std::function<float(int x, int y)>& value) {
  std::string channels, windows[2], one, centre;
  for (const char* name : {"B", "G", "R"}) {
    channels.append(name).push_back('\0');
    for (const std::int32_t number : {2 /* float */, 0, 1, 1}) put(channels, number);
  }
  channels.push_back('\0');
  put(windows[0], data);
  put(windows[1], display);
  put(one, 1.0f);
  put(centre, 0.0f);
  put(centre, 0.0f);
  std::string bytes;
  put(bytes, std::int32_t{20000630});
  put(bytes, std::int32_t{2});
  put_attribute(bytes, "channels", "chlist", channels);
  put_attribute(bytes, "compression", "compression", std::string(1, '\0'));
  put_attribute(bytes, "dataWindow", "box2i", windows[0]);
  put_attribute(bytes, "displayWindow", "box2i", windows[1]);
  put_attribute(bytes, "lineOrder", "lineOrder", std::string(1, '\0'));
  put_attribute(bytes, "pixelAspectRatio", "float", one);
  put_attribute(bytes, "screenWindowCenter", "v2f", centre);
  put_attribute(bytes, "screenWindowWidth", "float", one);
  bytes.push_back('\0');
  const std::size_t line = 3 * sizeof(float) * static_cast<std::size_t>(data.width());
  const std::size_t lines_begin = bytes.size() + 8 * static_cast<std::size_t>(data.height());
  for (int y = 0; y < data.height(); ++y)
    put(bytes, std::uint64_t{lines_begin + static_cast<std::size_t>(y) * (8 + line)});
  for (int y = data.y0; y <= data.y1; ++y) {
    put(bytes, std::int32_t{y});
    put(bytes, static_cast<std::int32_t>(line));
    for (const float scale : {3.0f, 2.0f, 1.0f})
      for (int x = data.x0; x <= data.x1; ++x) put(bytes, scale * value(x, y));
  }
  return bytes;
}

class Windows : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return (folder_ / name).string();
  }

 private:
  fs::path folder_ = test_folder();
};

constexpr std::uint64_t plenty = std::uint64_t{1} << 30;

TEST_F(Windows, ThePictureIsTheDisplayWindow) {
  const Window displays[] = {{0, 0, 7, 5}, {0, 0, 1, 1}, {-3, 4, 2, 9}, {10, 10, 12, 12}};
  const Window data[] = {{2, 1, 5, 4}, {-2, -3, 9, 8}, {0, 0, 7, 5}, {-4, -4, -1, -1}, {5, 3, 400, 300}};
  const auto value = [](int x, int y) { return static_cast<float>(1000 + 20 * y + x); };
  for (const Window& display : displays)
    for (const Window& stored : data) {
      const std::string path = file("a.exr", exr(display, stored, value));
      const PlanesResult planes = read_planes(path, "", plenty);
      ASSERT_EQ(planes.error, "");
      ASSERT_EQ(planes.width, display.width());
      ASSERT_EQ(planes.height, display.height());
      ASSERT_EQ(planes.planes.size(), 3u);
      const ReadResult whole = read(path);
      ASSERT_TRUE(whole.image) << whole.error;
      ASSERT_EQ(whole.image->width, display.width());
      ASSERT_EQ(whole.image->height, display.height());
      for (int y = 0; y < display.height(); ++y)
        for (int x = 0; x < display.width(); ++x) {
          const int at_x = display.x0 + x, at_y = display.y0 + y;
          const float wanted = stored.holds(at_x, at_y) ? value(at_x, at_y) : 0;
          for (std::size_t c = 0; c < 3; ++c) {
            const float scale = static_cast<float>(c + 1);
            EXPECT_EQ(planes.planes[c].texels[static_cast<std::size_t>(y * display.width() + x)],
                      scale * wanted);
            EXPECT_EQ(whole.image->at(x, y, c), scale * wanted) << whole.image->channels[c];
          }
        }
    }
}

TEST_F(Windows, OneChannelIsReadAlone) {
  const std::string path =
      file("a.exr", exr({0, 0, 3, 3}, {0, 0, 3, 3}, [](int x, int) { return static_cast<float>(x); }));
  const PlanesResult green = read_planes(path, "g", plenty);
  ASSERT_EQ(green.planes.size(), 1u);
  EXPECT_EQ(green.planes[0].texels[3], 6);
  const PlanesResult none = read_planes(path, "Z", plenty);
  EXPECT_TRUE(none.planes.empty());
  EXPECT_EQ(none.error, "");
  EXPECT_EQ(none.channels.size(), 3u);
}

TEST_F(Windows, WhatWouldTakeTooMuchIsRefusedBeforeItIsRead) {
  const Window corner{0, 0, 1, 1};
  const auto one = [](int, int) { return 1.0f; };
  const std::string shown = file("shown.exr", exr({0, 0, 99'999, 99'999}, corner, one));
  const std::string claimed = file("claimed.pfm", "PF\n90000 90000\n-1.0\n");
  for (const std::string& path : {shown, claimed})
    EXPECT_NE(read_planes(path, "", plenty).error.find("MB of memory, and 1024 MB are left for pictures"),
              std::string::npos)
        << read_planes(path, "", plenty).error;
  const std::string small = file("small.exr", exr(corner, corner, one));
  EXPECT_EQ(read_planes(small, "", 48).error, "");
  EXPECT_NE(read_planes(small, "", 47).error, "");
  EXPECT_EQ(read_planes(small, "R", 16).error, "");
}

TEST_F(Windows, AFileThatHoldsLessThanItClaimsIsAnError) {
  const Window window{0, 0, 99, 99};
  const std::string path = file("short.exr", exr(window, window, [](int, int) { return 1.0f; }));
  fs::resize_file(path, fs::file_size(path) / 2);
  const PlanesResult result = read_planes(path, "", plenty);
  EXPECT_NE(result.error, "");
  EXPECT_TRUE(result.planes.empty());
}

// Of a kilobyte that claims a gigabyte and more: in scan lines, in tiles, in one tile that is cut short, in
// rows.
TEST_F(Windows, WhatIsOnlyClaimedTakesNoMemory) {
  std::ifstream tiles(TYNDALL_SOURCE_DIR "/tests/image/pictures/tiles.exr", std::ios::binary);
  const std::string tiled{std::istreambuf_iterator<char>(tiles), {}};
  const auto with_value = [](std::string bytes, const std::string& attribute, const std::string& value) {
    return bytes.replace(bytes.find(attribute) + attribute.size() + 4, value.size(), value);
  };
  std::string window;
  put(window, Window{0, 0, 16383, 8191});
  const auto claiming = [&](std::string bytes) {
    for (const char* name : {"dataWindow", "displayWindow"})
      bytes = with_value(std::move(bytes), name + std::string("\0box2i\0", 7), window);
    return bytes;
  };
  const std::string lines = exr({0, 0, 7, 7}, {0, 0, 7, 7}, [](int, int) { return 1.0f; });
  const std::pair<std::string, std::string> cases[] = {
      {"lines.exr", claiming(lines)}, {"tiles.exr", claiming(tiled)}, {"rows.pfm", "PF\n16384 8192\n-1.0\n"}};
  read_planes(file("good.exr", lines), "", plenty);  // the libraries take some themselves
  const auto peak = [] {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;  // [MB]
  };
  for (const auto& [name, bytes] : cases) {
    const auto before = peak();
    const PlanesResult result = read_planes(file(name, bytes), "", 4 * plenty);
    EXPECT_NE(result.error, "") << name;
    EXPECT_LT(peak() - before, 100) << name;
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::image
