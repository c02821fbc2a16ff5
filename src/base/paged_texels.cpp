#include "base/paged_texels.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/check.h"

namespace tyndall {

class TileMemory {
 public:
  explicit TileMemory(std::uint64_t most_bytes) : left_(static_cast<std::int64_t>(most_bytes)) {}

  // For a thread that has `held` of it: none has more than is left for the others.
  bool take(std::size_t bytes, std::size_t held) {
    const auto wanted = static_cast<std::int64_t>(bytes);
    if (left_.fetch_sub(wanted) >= wanted + static_cast<std::int64_t>(held)) return true;
    left_.fetch_add(wanted);
    return false;
  }
  void give_back(std::size_t bytes) { left_.fetch_add(static_cast<std::int64_t>(bytes)); }

 private:
  std::atomic<std::int64_t> left_;
};

std::shared_ptr<TileMemory> make_tile_memory(std::uint64_t most_bytes) {
  return std::make_shared<TileMemory>(most_bytes);
}

namespace {

// The tiles of a thread: each picture's tile has a place here, which the next one for that place takes.
class ThreadTiles {
 public:
  struct Tile {
    std::uint64_t picture = 0;
    std::uint32_t tile = 0;
    std::vector<float> numbers;
    std::shared_ptr<TileMemory> memory;  // where it is counted; null: one of the least_tiles
    std::size_t bytes() const { return numbers.size() * sizeof(float); }
  };

  ThreadTiles() = default;
  ~ThreadTiles() {
    for (Tile& place : places_)
      if (place.memory) place.memory->give_back(place.bytes());
  }
  ThreadTiles(const ThreadTiles&) = delete;
  ThreadTiles& operator=(const ThreadTiles&) = delete;

  // The place for a tile of so many numbers; it may hold another.
  Tile& place_for(std::uint64_t picture, std::uint32_t tile, std::size_t numbers,
                  const std::shared_ptr<TileMemory>& memory) {
    const std::uint64_t hash = (picture * 0x9e3779b97f4a7c15u) ^ (std::uint64_t{tile} * 0xd6e8feb86659fd93u);
    Tile& place = places_[(hash >> 40) % places];
    if (place.picture == picture && place.tile == tile) return place;
    if (place.numbers.size() != numbers) {
      if (!place.numbers.empty()) {
        release(place);
        std::erase(in_order_, &place);
      }
      if (make_room(numbers * sizeof(float), memory)) place.memory = memory;
      place.numbers.resize(numbers);
      in_order_.push_back(&place);
    }
    return place;
  }
  // The last one that was looked at, which most often is the next.
  const Tile* last = nullptr;

 private:
  static constexpr std::size_t places = std::size_t{1} << 16;
  static constexpr std::size_t least_tiles = 16;  // of each thread, whatever the limit

  // True when the bytes are counted; else there are few enough tiles. The oldest go for it.
  bool make_room(std::size_t bytes, const std::shared_ptr<TileMemory>& memory) {
    bool counted = memory->take(bytes, held_);
    while (!counted && in_order_.size() >= least_tiles) {
      release(*in_order_.front());
      in_order_.pop_front();
      counted = memory->take(bytes, held_);
    }
    if (counted) held_ += bytes;
    return counted;
  }
  void release(Tile& place) {
    if (place.memory) {
      place.memory->give_back(place.bytes());
      held_ -= place.bytes();
    }
    place = {};
  }

  std::vector<Tile> places_{places};
  std::deque<Tile*> in_order_;  // those that have numbers, the oldest first
  std::size_t held_ = 0;        // of what is counted [bytes]
};

ThreadTiles& thread_tiles() {
  thread_local const std::unique_ptr<ThreadTiles> tiles = std::make_unique<ThreadTiles>();
  return *tiles;
}

// A file without a name in the folder of temporary files.
int temporary_file() {
  std::error_code failed;
  std::filesystem::path folder = std::filesystem::temp_directory_path(failed);
  if (failed) folder = "/tmp";
  std::string name = (folder / "tyndall-XXXXXX").string();
  const int file = ::mkostemp(name.data(), O_CLOEXEC);
  if (file >= 0) ::unlink(name.c_str());
  return file;
}

std::string no_room() {
  return "its tiles cannot be kept in the folder of temporary files (TMPDIR): " +
         std::generic_category().message(errno);
}

std::atomic<std::uint64_t> pictures_made{0};

}  // namespace

PagedTexels::PagedTexels(int width, int height, int channels, std::shared_ptr<TileMemory> memory)
    : width_(width),
      height_(height),
      channels_(channels),
      tiles_across_((width - 1) / tile_side + 1),
      next_row_(height - 1),
      number_(++pictures_made),
      memory_(std::move(memory)) {}

PagedTexels::~PagedTexels() {
  if (file_ >= 0) ::close(file_);
}

std::uint64_t PagedTexels::bytes() const {
  return static_cast<std::uint64_t>(tiles_across_) *
         static_cast<std::uint64_t>((height_ - 1) / tile_side + 1) * tile_numbers() * sizeof(float);
}

std::string PagedTexels::add_row(std::span<const float> numbers) {
  CHECK_GE(next_row_, 0);
  CHECK_EQ(numbers.size(), static_cast<std::size_t>(width_) * static_cast<std::size_t>(channels_));
  const int y = next_row_--, band = y / tile_side;
  const std::size_t in_row = static_cast<std::size_t>(tile_side * channels_);
  band_.resize(static_cast<std::size_t>(tiles_across_) * tile_numbers());
  for (std::size_t tile = 0; tile * in_row < numbers.size(); ++tile) {
    const std::span part = numbers.subspan(tile * in_row, std::min(in_row, numbers.size() - tile * in_row));
    std::copy(part.begin(), part.end(),
              band_.begin() + static_cast<std::ptrdiff_t>(tile * tile_numbers() +
                                                          static_cast<std::size_t>(y % tile_side) * in_row));
  }
  return y % tile_side == 0 ? write_band(band) : std::string();
}

std::string PagedTexels::write_band(int band) {
  if (file_ < 0) file_ = temporary_file();
  if (file_ < 0) return no_room();
  const char* next = reinterpret_cast<const char*>(band_.data());
  std::size_t left = band_.size() * sizeof(float);
  auto place = static_cast<::off_t>(left) * band;
  while (left > 0) {
    const ::ssize_t written = ::pwrite(file_, next, left, place);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return no_room();
    next += written;
    place += written;
    left -= static_cast<std::size_t>(written);
  }
  if (band == 0) std::vector<float>().swap(band_);
  return {};
}

void PagedTexels::read_tile(std::uint32_t tile, float* numbers) const {
  char* next = reinterpret_cast<char*>(numbers);
  std::size_t left = tile_numbers() * sizeof(float);
  auto place = static_cast<::off_t>(left) * tile;
  while (left > 0) {
    const ::ssize_t got = ::pread(file_, next, left, place);
    if (got < 0 && errno == EINTR) continue;
    CHECK_GT(got, 0);  // the file is ours alone, and whole
    next += got;
    place += got;
    left -= static_cast<std::size_t>(got);
  }
}

float PagedTexels::at(int x, int y, int channel) const {
  const auto tile = static_cast<std::uint32_t>(y / tile_side * tiles_across_ + x / tile_side);
  ThreadTiles& tiles = thread_tiles();
  if (!tiles.last || tiles.last->picture != number_ || tiles.last->tile != tile) {
    ThreadTiles::Tile& place = tiles.place_for(number_, tile, tile_numbers(), memory_);
    if (place.picture != number_ || place.tile != tile) {
      read_tile(tile, place.numbers.data());
      place.picture = number_;
      place.tile = tile;
    }
    tiles.last = &place;
  }
  return tiles.last->numbers[static_cast<std::size_t>(
      ((y % tile_side) * tile_side + x % tile_side) * channels_ + channel)];
}

}  // namespace tyndall
