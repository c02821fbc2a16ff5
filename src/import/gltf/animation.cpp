#include "import/gltf/animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "import/gltf/accessor.h"

namespace tyndall::gltf {

namespace {

constexpr std::array<std::string_view, 4> paths = {"translation", "rotation", "scale", "weights"};
constexpr std::array<std::string_view, 3> interpolations = {"STEP", "LINEAR", "CUBICSPLINE"};

// The number of a word among those that there are.
template <std::size_t n>
std::size_t word(const Element& element, const std::string& text,
                 const std::array<std::string_view, n>& words) {
  const auto found = std::find(words.begin(), words.end(), text);
  if (found == words.end()) element.fail(fmt::format("is '{}', which is none of glTF's", text));
  return static_cast<std::size_t>(found - words.begin());
}

// The short way from one rotation to another, at a steady rate.
void slerp(const float* a, const float* b, double t, double* out) {
  double cosine = 0;
  for (int k = 0; k < 4; ++k) cosine += double{a[k]} * double{b[k]};
  const double sign = cosine < 0 ? -1 : 1;
  const double angle = std::acos(std::min(std::abs(cosine), 1.0)), sine = std::sin(angle);
  constexpr double straight = 1e-6;  // the arc is a line to rounding
  const double from = sine > straight ? std::sin((1 - t) * angle) / sine : 1 - t;
  const double to = sine > straight ? std::sin(t * angle) / sine : t;
  for (int k = 0; k < 4; ++k) out[k] = from * double{a[k]} + to * sign * double{b[k]};
}

}  // namespace

Animation::Animation(Document& document, std::uint32_t index) {
  const Element animation = document.item("animations", index), channels = animation["channels"];
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const Element channel = channels.at(i), target = channel["target"];
    if (!target.find("node")) continue;  // an extension's
    channels_.push_back(channel_of(document, animation, channel, target));
    if (!channels_.back().times.empty())
      duration_ = std::max(duration_, double{channels_.back().times.back()});
  }
}

Animation::Channel Animation::channel_of(Document& document, const Element& animation, const Element& channel,
                                         const Element& target) {
  Channel out;
  out.node = *document.index(target, "node", "nodes");
  out.path = static_cast<Path>(word(target["path"], target["path"].text(), paths));
  const Element samplers = animation["samplers"];
  const Element sampler =
      samplers.at(channel["sampler"].index(samplers.size(), "samplers of this animation"));
  out.interpolation =
      static_cast<Interpolation>(word(sampler, sampler.text("interpolation", "LINEAR"), interpolations));
  out.times = read_floats(document, sampler["input"].index(document.count("accessors"), "accessors"), 1);
  if (!std::is_sorted(out.times.begin(), out.times.end())) sampler["input"].fail("holds times that fall");
  const int parts = out.path == Path::weights ? 1 : out.path == Path::rotation ? 4 : 3;
  out.values =
      read_floats(document, sampler["output"].index(document.count("accessors"), "accessors"), parts);
  const std::size_t values_per_key = out.interpolation == Interpolation::cubic ? 3 : 1;
  const std::size_t keys = out.times.size() * values_per_key;
  if (keys == 0) sampler["input"].fail("holds no times");
  out.width = out.path == Path::weights ? out.values.size() / keys : static_cast<std::size_t>(parts);
  if (out.width == 0 || out.values.size() != keys * out.width)
    sampler["output"].fail(fmt::format("holds {} values for {} times",
                                       out.values.size() / static_cast<std::size_t>(parts),
                                       out.times.size()));
  return out;
}

std::vector<double> Animation::Channel::at(double seconds) const {
  const bool cubic = interpolation == Interpolation::cubic;
  const auto value = [&](std::size_t key, std::size_t part) {  // part: tangent before, value, tangent after
    return values.data() + (cubic ? 3 * key + part : key) * width;
  };
  const auto next = std::upper_bound(times.begin(), times.end(), seconds,
                                     [](double s, float time) { return s < double{time}; });
  const auto copy = [&](std::size_t key) {
    return std::vector<double>(value(key, 1), value(key, 1) + width);
  };
  if (next == times.begin()) return copy(0);
  const auto key = static_cast<std::size_t>(next - times.begin()) - 1;
  if (next == times.end() || interpolation == Interpolation::step) return copy(key);
  const double span = double{times[key + 1]} - double{times[key]}, t = (seconds - double{times[key]}) / span;
  std::vector<double> out(width);
  if (cubic) {
    // Hermite's, glTF 2.0 appendix C; tangents are per second.
    const double t2 = t * t, t3 = t2 * t;
    for (std::size_t k = 0; k < width; ++k)
      out[k] = (2 * t3 - 3 * t2 + 1) * double{value(key, 1)[k]} +
               span * (t3 - 2 * t2 + t) * double{value(key, 2)[k]} +
               (3 * t2 - 2 * t3) * double{value(key + 1, 1)[k]} +
               span * (t3 - t2) * double{value(key + 1, 0)[k]};
  } else if (path == Path::rotation) {
    slerp(value(key, 1), value(key + 1, 1), t, out.data());
  } else {
    for (std::size_t k = 0; k < width; ++k)
      out[k] = (1 - t) * double{value(key, 1)[k]} + t * double{value(key + 1, 1)[k]};
  }
  return out;
}

bool Animation::weighs(std::uint32_t node) const {
  return std::any_of(channels_.begin(), channels_.end(), [node](const Channel& channel) {
    return channel.node == node && channel.path == Path::weights;
  });
}

void Animation::apply(double seconds, std::vector<NodePose>& poses) const {
  for (const Channel& channel : channels_) {
    std::vector<double> v = channel.at(seconds);
    NodePose& pose = poses[channel.node];
    switch (channel.path) {
      case Path::translation:
        pose.translation = {v[0], v[1], v[2]};
        break;
      case Path::rotation:
        pose.rotation = normalized(quaternion_of(v.data()));
        break;
      case Path::scale:
        pose.scale = {v[0], v[1], v[2]};
        break;
      case Path::weights:
        pose.weights = std::move(v);
        break;
    }
    if (channel.path != Path::weights) pose.matrix.reset();
  }
}

}  // namespace tyndall::gltf
