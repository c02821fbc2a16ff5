// The texels of a picture that is too large for memory: in tiles, in a temporary file without a name, of
// which each thread keeps those that it looked at last.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tyndall {

// Memory that the tiles of several pictures take, of all threads together.
class TileMemory;
std::shared_ptr<TileMemory> make_tile_memory(std::uint64_t most_bytes);

class PagedTexels {
 public:
  static constexpr int tile_side = 32;  // [texels]

  // Rows from the bottom, of so many channels that are looked up together.
  PagedTexels(int width, int height, int channels, std::shared_ptr<TileMemory> memory);
  ~PagedTexels();
  PagedTexels(const PagedTexels&) = delete;
  PagedTexels& operator=(const PagedTexels&) = delete;

  // Fills it: all rows once, from the top, channels interleaved. Says what went wrong, if anything did.
  std::string add_row(std::span<const float> numbers);

  // By any thread, once all rows are there.
  float at(int x, int y, int channel) const;
  // What it takes in the file.
  std::uint64_t bytes() const;

 private:
  std::string write_band(int band);
  void read_tile(std::uint32_t tile, float* numbers) const;
  std::size_t tile_numbers() const { return static_cast<std::size_t>(tile_side * tile_side * channels_); }

  int width_, height_, channels_, tiles_across_, next_row_;
  std::uint64_t number_;  // of this picture, among all there ever were
  int file_ = -1;
  std::vector<float> band_;  // of tiles, while they are filled
  std::shared_ptr<TileMemory> memory_;
};

}  // namespace tyndall
