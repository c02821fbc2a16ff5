#include "tools/slice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/numbers.h"
#include "vm/run/machine.h"

namespace tyndall::tools {

namespace {

// Right and up, seen from the tip of the axis: which coordinate, and with which sign.
struct Directions {
  int right, up;
  double right_sign, up_sign;
};
constexpr Directions seen_from[] = {{2, 1, -1, 1}, {0, 2, 1, -1}, {0, 1, 1, 1}};

// The lanes of every input that can be told from p.
struct SliceInputs {
  std::array<std::vector<float>, 6> lanes;  // p, P
  std::vector<float> zeros;
  float time;

  vm::BatchInputs of(const vm::Program& program, std::size_t first) const {
    vm::BatchInputs inputs;
    for (const vm::Input input : program.inputs) {
      const auto k = static_cast<std::size_t>(input);
      inputs[input] = vm::is_uniform(input) ? &time
                      : k < lanes.size()    ? lanes[k].data() + first
                                            : zeros.data();
    }
    return inputs;
  }
};

void measure(Slice& slice) {
  double sum = 0;
  std::size_t count = 0;
  for (const std::vector<float>& values : slice.components)
    for (const float v : values) {
      if (!std::isfinite(v)) {
        ++slice.not_finite;
        continue;
      }
      slice.lowest = count == 0 ? v : std::min(slice.lowest, v);
      slice.highest = count == 0 ? v : std::max(slice.highest, v);
      sum += static_cast<double>(v);
      ++count;
    }
  slice.mean = count == 0 ? 0 : sum / static_cast<double>(count);
}

}  // namespace

std::optional<SlicePlane> parse_slice(const std::string& text) {
  if (text.size() < 3 || text[0] < 'x' || text[0] > 'z' || text[1] != '=') return std::nullopt;
  std::string_view number = std::string_view(text).substr(2);
  if (number.ends_with('m')) number.remove_suffix(1);
  const std::optional<double> at = read_decimal<double>(number);
  return at ? std::optional(SlicePlane{text[0] - 'x', *at}) : std::nullopt;
}

Slice cut(const MediumPlace& place, const scene::Watched& watched, const std::string& name, double time,
          const SlicePlane& plane, int longest_side) {
  const Directions& d = seen_from[plane.axis];
  const auto extent = [&](int axis) {
    const auto k = static_cast<std::size_t>(axis);
    return place.box.hi[k] - place.box.lo[k];
  };
  const double longest = std::max(extent(d.right), extent(d.up));
  const auto pixels = [&](int axis) {
    return std::max(1, static_cast<int>(std::lround(extent(axis) / longest * longest_side)));
  };
  Slice slice;
  slice.title =
      fmt::format("{} of medium {} at {} = {:g}", name, place.medium->name, "xyz"[plane.axis], plane.at);
  slice.width = pixels(d.right);
  slice.height = pixels(d.up);
  const auto edges = [&](int axis, double sign, double& low, double& high) {
    const auto k = static_cast<std::size_t>(axis);
    low = sign > 0 ? place.box.lo[k] : place.box.hi[k];
    high = sign > 0 ? place.box.hi[k] : place.box.lo[k];
  };
  edges(d.right, d.right_sign, slice.left, slice.right);
  edges(d.up, d.up_sign, slice.bottom, slice.top);
  slice.right_axis = "xyz"[d.right];
  slice.up_axis = "xyz"[d.up];

  const std::size_t count = static_cast<std::size_t>(slice.width) * static_cast<std::size_t>(slice.height);
  SliceInputs inputs{{}, std::vector<float>(vm::Machine::max_lanes), static_cast<float>(time)};
  for (std::vector<float>& lanes : inputs.lanes) lanes.reserve(count);
  for (int row = 0; row < slice.height; ++row)
    for (int column = 0; column < slice.width; ++column) {
      Vec3d p;
      p[static_cast<std::size_t>(plane.axis)] = plane.at;
      p[static_cast<std::size_t>(d.right)] =
          slice.left + (slice.right - slice.left) * (column + 0.5) / slice.width;
      p[static_cast<std::size_t>(d.up)] = slice.top + (slice.bottom - slice.top) * (row + 0.5) / slice.height;
      const Vec3d world = place.world_from_medium.point(p);
      for (std::size_t k = 0; k < 3; ++k) {
        inputs.lanes[k].push_back(static_cast<float>(p[k]));
        inputs.lanes[k + 3].push_back(static_cast<float>(world[k]));
      }
    }
  slice.components.assign(watched.program->outputs.size(), std::vector<float>(count));
  vm::Machine machine;
  for (std::size_t first = 0; first < count; first += vm::Machine::max_lanes) {
    std::vector<float*> outputs;
    for (std::vector<float>& values : slice.components) outputs.push_back(values.data() + first);
    machine.run(*watched.program, inputs.of(*watched.program, first),
                std::min(vm::Machine::max_lanes, count - first), outputs);
  }
  measure(slice);
  return slice;
}

}  // namespace tyndall::tools
