// Files of parts: what is read is what was written, to the bit, and what is damaged is refused.
#include "render/film/part_file.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "base/content_hash.h"
#include "support/test_folder.h"

namespace tyndall::render {
namespace UNNAMED {

AovSet aovs_of(std::initializer_list<Aov> list) {
  AovSet set;
  for (const Aov aov : list) set.add(aov);
  return set;
}

// A film with numbers of all sizes in it.
Film some_film(int groups, const AovSet& aovs, std::optional<PixelWindow> window) {
  Film film(9, 7, groups, aovs, window);
  std::mt19937_64 random(17);
  const PixelWindow w = film.window();
  for (int i = 0; i < 500; ++i) {
    const int x = w.x0 + static_cast<int>(random() % static_cast<unsigned>(w.x1 - w.x0)),
              y = w.y0 + static_cast<int>(random() % static_cast<unsigned>(w.y1 - w.y0));
    const double size = std::exp2(static_cast<double>(random() % 60) - 30);
    film.add(x, y, Rgb(Vec3d{size, -size / 3, size * size}), i % groups);
    AovSample sample;
    sample.hit_surface = i % 3 == 0;
    sample.depth = size;
    sample.albedo = Rgb(Vec3d{size / 7, 0.5, 1});
    if (aovs.recorded()) film.add(x, y, sample);
  }
  return film;
}

bool same(const Film& a, const Film& b) {
  const auto equal = [](auto p, auto q) { return std::equal(p.begin(), p.end(), q.begin(), q.end()); };
  return a.width() == b.width() && a.height() == b.height() && a.groups() == b.groups() &&
         a.window() == b.window() && a.aovs().bits() == b.aovs().bits() &&
         equal(a.bytes().first, b.bytes().first) && equal(a.bytes().second, b.bytes().second);
}

struct PartFile : testing::Test {
  std::string path = (test_folder() / "a.tynpart").string();
  std::string bytes() const {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static PartResult read(const std::string& bytes) {
    std::istringstream in(bytes);
    return read_part(in, bytes.size());
  }
};

TEST_F(PartFile, IsReadAsItWasWritten) {
  for (const int groups : {1, error_groups})
    for (const AovSet& aovs :
         {AovSet{}, aovs_of({Aov::samples}), aovs_of({Aov::depth, Aov::albedo, Aov::variance})})
      for (const auto& window : {std::optional<PixelWindow>{}, std::optional(PixelWindow{2, 1, 6, 7})}) {
        const Film film = some_film(groups, aovs, window);
        ASSERT_EQ(write_part(path, "what it is", film, std::string("\0rest", 5)), "");
        const PartResult back = read_part(path);
        ASSERT_TRUE(back.part) << back.error;
        EXPECT_EQ(back.part->text, "what it is");
        EXPECT_EQ(back.part->rest, std::string("\0rest", 5));
        EXPECT_TRUE(same(back.part->film, film));
        EXPECT_EQ(read_part_text(path).text, "what it is");
      }
}

TEST_F(PartFile, NoTruncationAndNoFlippedBitIsRead) {
  const Film film = some_film(1, aovs_of({Aov::depth}), PixelWindow{1, 1, 4, 3});
  ASSERT_EQ(write_part(path, "text", film, "rest"), "");
  const std::string whole = bytes();
  ASSERT_TRUE(read(whole).part);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const PartResult cut = read(whole.substr(0, size));
    EXPECT_FALSE(cut.part) << size;
    EXPECT_NE(cut.error, "") << size;
  }
  EXPECT_FALSE(read(whole + '\0').part);
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const int bit : {0, 3, 7}) {
      std::string flipped = whole;
      flipped[at] = static_cast<char>(flipped[at] ^ (1 << bit));
      const PartResult result = read(flipped);
      EXPECT_FALSE(result.part) << at << " " << bit;
      EXPECT_NE(result.error, "") << at << " " << bit;
    }
}

// The part with a number of its film's shape changed, and a checksum that is right.
std::string with_shape(std::string bytes, int number, int value) {
  const std::size_t film = bytes.find("FILM");
  std::memcpy(bytes.data() + film + 16 + 4 * number, &value, 4);
  ContentHash hash;
  hash.add(std::string_view(bytes).substr(film, 16 + 32));
  const std::uint64_t sum = hash.value();
  std::memcpy(bytes.data() + film + 16 + 32, &sum, 8);
  return bytes;
}

// Shapes that no film has, and sizes beyond the file.
TEST_F(PartFile, ImpossibleShapesAreRefused) {
  ASSERT_EQ(write_part(path, "text", Film(9, 7), ""), "");
  const std::string whole = bytes();
  for (int number = 0; number < 8; ++number)
    for (const int value : {-1, 0, 2, 3, 8, 17000, 2'000'000'000, -2'000'000'000}) {
      const std::string changed = with_shape(whole, number, value);
      if (changed == whole || (number == 1 && value == 8)) continue;  // a picture a row higher is one
      EXPECT_FALSE(read(changed).part) << number << " " << value;
    }
}

// Outputs that take no room beside the film's sums, so that the file's size tells nothing of them.
TEST_F(PartFile, OutputsThatNeedGroupsAreRefusedWithoutThem) {
  for (const int groups : {1, error_groups}) {
    ASSERT_EQ(write_part(path, "text", Film(9, 7, groups), ""), "");
    const std::string whole = bytes();
    for (const AovInfo& info : aov_infos()) {
      const AovSet aovs = aovs_of({info.aov});
      if (aovs.recorded()) continue;
      const bool can_be = Film::can_be(9, 7, groups, aovs, {0, 0, 9, 7});
      EXPECT_EQ(read(with_shape(whole, 3, static_cast<int>(aovs.bits()))).part.has_value(), can_be)
          << info.name << " " << groups;
      EXPECT_EQ(can_be, groups == error_groups || info.aov != Aov::halves);
    }
  }
}

TEST_F(PartFile, OtherFilesAreToldApart) {
  for (const auto& [text, words] : {std::pair("", "it is no part of a picture"),
                                    std::pair("render { samples: 1 } // and more", "no part"),
                                    std::pair("TYNPART\n\2\0\0\0\0\0\0", "cut short")})
    EXPECT_NE(read(text).error, "") << words;
  std::string newer(16, '\0');
  newer.replace(0, 9, "TYNPART\n\7");
  EXPECT_EQ(read(newer).error, "its format is version 7, and this program reads version 1");
  EXPECT_EQ(read_part("/nowhere/a.tynpart").error, "cannot read '/nowhere/a.tynpart': no such file");
  EXPECT_EQ(read_part("/tmp").error, "cannot read '/tmp': it is no plain file");
  EXPECT_EQ(read_part_text("/tmp").error, "cannot read '/tmp': it is no plain file");
}

TEST(FilmSums, AddUpWhateverTheParts) {
  const AovSet aovs = aovs_of({Aov::depth, Aov::variance});
  const Film part = some_film(error_groups, aovs, PixelWindow{2, 1, 6, 7});
  Film whole = some_film(error_groups, aovs, {}), other(9, 7, error_groups, aovs);
  other.add(part);
  other.add(some_film(error_groups, aovs, {}));
  whole.add(part);
  EXPECT_TRUE(same(whole, other));
  EXPECT_FALSE(part.takes(whole)) << "it is larger";
  EXPECT_FALSE(Film(9, 7, 1, aovs).takes(part)) << "of other groups";
  EXPECT_FALSE(Film(9, 7, error_groups).takes(part)) << "of other outputs";
  EXPECT_FALSE(Film(9, 8, error_groups, aovs).takes(part)) << "of another picture";
}

}  // namespace UNNAMED
}  // namespace tyndall::render
