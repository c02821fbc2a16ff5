// Planes for lookups, made of a picture's rows as they come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/plane.h"
#include "image/rows.h"

namespace tyndall::image {

// What the pictures of a scene may take. One that takes more than an eighth of it, or than is left, is kept
// in a temporary file, and the tiles of such pictures that are in use share an eighth.
struct PictureMemory {
  static constexpr std::uint64_t usual = std::uint64_t{4} << 30, least = std::uint64_t{16} << 20;

  explicit PictureMemory(std::uint64_t most_bytes = usual)
      : of_one(most_bytes / 8), left(most_bytes - most_bytes / 8), tiles(make_tile_memory(most_bytes / 8)) {}

  std::uint64_t of_one, left;
  std::shared_ptr<TileMemory> tiles;
};

class PlaneMaker final : public RowTaker {
 public:
  enum class Negative : bool { kept, cleared };
  // `name` is the picture's, for listings.
  PlaneMaker(std::string name, Negative negative, PictureMemory& memory);

  std::string begin(const PictureHeader& header) override;
  void row(std::span<const float> numbers) override;
  // A plane for each channel, once all rows have come; a message when they could not be kept.
  std::vector<PlanePointer> finish(std::string& error);

  const PictureHeader& header() const { return header_; }
  std::uint64_t not_finite() const { return not_finite_; }
  std::uint64_t negative() const { return negative_; }
  // In memory, or in a temporary file.
  std::uint64_t bytes() const { return bytes_; }
  bool is_paged() const { return paged_ != nullptr; }

 private:
  float checked(float number);

  std::string name_;
  Negative clearing_;
  PictureMemory& memory_;
  PictureHeader header_;
  std::uint64_t not_finite_ = 0, negative_ = 0, bytes_ = 0;
  std::size_t pixels_ = 0;
  std::vector<std::vector<float>> texels_;  // of each channel, rows from the top
  std::shared_ptr<PagedTexels> paged_;
  std::vector<PlaneSummary> summaries_;  // of paged ones
  std::vector<float> numbers_;
  std::string problem_;
};

}  // namespace tyndall::image
