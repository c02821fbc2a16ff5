// Pictures decoded in a process of their own: they come as they are, and whatever becomes of the process is
// an error.
#include "image/apart.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "image/image.h"
#include "support/test_folder.h"

namespace tyndall::image {
namespace UNNAMED {

struct Kept final : RowTaker {
  PictureHeader header;
  std::vector<std::vector<float>> rows;
  std::string refusal;
  std::string begin(const PictureHeader& given) override {
    header = given;
    return refusal;
  }
  void row(std::span<const float> numbers) override { rows.emplace_back(numbers.begin(), numbers.end()); }
};

const PictureHeader small{2, 3, {"R", "G"}, {1}, {Transfer::Curve::power, 2.2}};
std::string decode_small(RowTaker& taker) {
  if (std::string problem = taker.begin(small); !problem.empty()) return problem;
  for (int y = 0; y < 3; ++y) taker.row(std::array{static_cast<float>(y), 0.5f});
  return {};
}

TEST(Apart, PicturesComeAsTheyAre) {
  Kept kept;
  EXPECT_EQ(decode_apart(decode_small, kept), "");
  EXPECT_EQ(kept.header.width, 2);
  EXPECT_EQ(kept.header.height, 3);
  EXPECT_EQ(kept.header.channels, small.channels);
  EXPECT_EQ(kept.header.chosen, small.chosen);
  EXPECT_EQ(kept.header.transfer.degree, 2.2);
  EXPECT_EQ(kept.rows, (std::vector<std::vector<float>>{{0, 0.5f}, {1, 0.5f}, {2, 0.5f}}));
}

TEST(Apart, ErrorsOfBothSidesAreTold) {
  Kept kept;
  EXPECT_EQ(decode_apart([](RowTaker&) { return std::string("it is no picture"); }, kept),
            "it is no picture");
  kept.refusal = "it is too large";
  EXPECT_EQ(decode_apart(decode_small, kept), "it is too large");
}

TEST(Apart, WhateverBecomesOfTheProcessIsAnError) {
  const std::function<std::string(RowTaker&)> ends[] = {
      [](RowTaker&) -> std::string { std::abort(); },
      [](RowTaker& taker) -> std::string {
        taker.begin(small);
        ::raise(SIGSEGV);
        return {};
      },
      [](RowTaker& taker) -> std::string {  // more rows than it told
        taker.begin(small);
        for (int i = 0; i < 4; ++i) taker.row(std::array{1.0f, 1.0f});
        return {};
      },
      [](RowTaker&) -> std::string {  // out of memory
        void* const all = ::mmap(nullptr, std::size_t{8} << 30, PROT_READ | PROT_WRITE,
                                 MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
        if (all == MAP_FAILED) throw std::bad_alloc();
        return {};
      }};
  for (const auto& decode : ends) {
    Kept kept;
    EXPECT_NE(decode_apart(decode, kept).find("it is broken"), std::string::npos);
  }
}

// An IFF whose tile reaches beyond its picture writes beyond OpenImageIO's memory.
TEST(Apart, ReadersThatTrustTheirFilesDoNoHarm) {
  std::ifstream file(TYNDALL_SOURCE_DIR "/tests/image/pictures/small.iff", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(file), {}};
  const auto path = test_folder() / "a.iff";
  for (std::size_t place = 16; place < 140; place += 3) {
    std::string changed = whole;
    changed[place] = '\xff';
    std::ofstream(path, std::ios::binary) << changed;
    const PlanesResult result = read_planes(path.string(), "", std::uint64_t{1} << 26);
    EXPECT_EQ(result.planes.empty(), !result.error.empty());
  }
}

}  // namespace UNNAMED
}  // namespace tyndall::image
