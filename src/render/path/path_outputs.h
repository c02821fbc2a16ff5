// Where the results of camera samples go.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/vec.h"
#include "render/context/deadline.h"
#include "render/film/aov.h"
#include "render/lights/scattered_light.h"

namespace tyndall::render {

struct PathOutputs {
  std::span<Rgb> radiance;         // one a sample
  std::span<AovSample> aovs = {};  // as many, or none when nothing beside the picture is wanted
  std::string* trace = nullptr;    // gets a line of text for each event
  const Deadline* deadline = nullptr;
  std::span<ScatteredLight> scattered = {};  // of each sample, where it is limited

  // Adds light that a sample's path brought; `what` names it in the trace.
  void add(std::uint32_t sample, LightPart part, const Rgb& light, std::string_view what) const {
    radiance[sample] += light;
    if (!aovs.empty()) aovs[sample].add(part, light);
    if (!scattered.empty()) scattered[sample].add(part, light);
    say_light(light, what);
  }
  void add_cost(std::uint32_t sample, std::uint32_t segments) const {
    if (!aovs.empty()) aovs[sample].cost += 1 + segments;
  }
  void say_light(const Rgb& light, std::string_view what) const {
    if (trace && !is_black(light)) say("  + ({:.6g}, {:.6g}, {:.6g}) {}\n", light.x, light.y, light.z, what);
  }
  template <class... Args>
  void say(fmt::format_string<Args...> format, Args&&... args) const {
    fmt::format_to(std::back_inserter(*trace), format, std::forward<Args>(args)...);
  }
};

}  // namespace tyndall::render
