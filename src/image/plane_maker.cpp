#include "image/plane_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall::image {

namespace {

// Places in the planes of memory are counted in 31 bits.
constexpr std::uint64_t most_in_memory = std::uint64_t{1} << 30;  // texels
// Of a temporary file.
constexpr std::uint64_t most_paged_bytes = std::uint64_t{64} << 30;

}  // namespace

PlaneMaker::PlaneMaker(std::string name, Negative negative, PictureMemory& memory)
    : name_(std::move(name)), clearing_(negative), memory_(memory) {}

std::string PlaneMaker::begin(const PictureHeader& header) {
  header_ = header;
  if (header.chosen.empty()) return {};
  pixels_ = static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height);
  texels_.resize(header.chosen.size());
  bytes_ = pixels_ * texels_.size() * sizeof(float);
  if (bytes_ <= memory_.of_one && bytes_ <= memory_.left && pixels_ <= most_in_memory) {
    memory_.left -= bytes_;
    return {};
  }
  paged_ = std::make_shared<PagedTexels>(header.width, header.height, static_cast<int>(texels_.size()),
                                         memory_.tiles);
  bytes_ = paged_->bytes();
  if (bytes_ > most_paged_bytes)
    return fmt::format("its {} x {} pixels would take {} GB of a temporary file, and {} GB are possible",
                       header.width, header.height, bytes_ >> 30, most_paged_bytes >> 30);
  summaries_.assign(texels_.size(), PlaneSummary(header.width, header.height));
  return {};
}

float PlaneMaker::checked(float number) {
  if (!std::isfinite(number)) {
    ++not_finite_;
    return 0;
  }
  if (number < 0 && clearing_ == Negative::cleared) {
    ++negative_;
    return 0;
  }
  return number;
}

// Memory is taken as rows come: a file may claim more than it holds.
void PlaneMaker::row(std::span<const float> numbers) {
  const std::size_t channels = texels_.size();
  if (!paged_) {
    for (std::size_t k = 0; k < channels; ++k) {
      texels_[k].reserve(pixels_);
      for (std::size_t i = k; i < numbers.size(); i += channels) texels_[k].push_back(checked(numbers[i]));
    }
    return;
  }
  if (!problem_.empty()) return;
  numbers_.resize(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers_[i] = checked(numbers[i]);
    summaries_[i % channels].add(numbers_[i]);
  }
  problem_ = paged_->add_row(numbers_);
}

std::vector<PlanePointer> PlaneMaker::finish(std::string& error) {
  error = problem_;
  std::vector<PlanePointer> planes;
  for (std::size_t k = 0; k < texels_.size() && error.empty(); ++k) {
    std::string name = fmt::format("{} {}", name_, header_.channels[header_.chosen[k]]);
    if (paged_) {
      Plane plane{std::move(name), header_.width, header_.height, {}};
      plane.paged = paged_;
      plane.channel = static_cast<int>(k);
      summaries_[k].write_to(plane);
      planes.push_back(std::make_shared<const Plane>(std::move(plane)));
      continue;
    }
    // From rows from the top to rows from the bottom.
    std::vector<float>& texels = texels_[k];
    const auto width = static_cast<std::ptrdiff_t>(header_.width);
    for (std::ptrdiff_t low = 0, high = header_.height - 1; low < high; ++low, --high)
      std::swap_ranges(texels.begin() + low * width, texels.begin() + (low + 1) * width,
                       texels.begin() + high * width);
    planes.push_back(make_plane(std::move(name), header_.width, header_.height, std::move(texels)));
  }
  return planes;
}

}  // namespace tyndall::image
