#include "image/view.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace tyndall::image {

namespace {

std::optional<double> read_stops(std::string_view text) {
  double stops = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), stops);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(stops)) return std::nullopt;
  return stops;
}

}  // namespace

std::string describe(const Exposure& exposure) {
  if (!exposure.metered) return fmt::format("{}", exposure.stops);
  return exposure.stops == 0 ? "auto" : fmt::format("auto({})", exposure.stops);
}

std::optional<Exposure> read_exposure(std::string_view text) {
  if (text == "auto") return Exposure{0, true};
  const bool metered = text.starts_with("auto(") && text.ends_with(")");
  if (metered) text = text.substr(5, text.size() - 6);
  const auto stops = read_stops(text);
  return stops ? std::optional(Exposure{*stops, metered}) : std::nullopt;
}

std::string_view describe(Tonemap tonemap) {
  for (const TonemapInfo& info : tonemaps)
    if (info.tonemap == tonemap) return info.name;
  return {};
}

std::optional<Tonemap> read_tonemap(std::string_view text) {
  for (const TonemapInfo& info : tonemaps)
    if (info.name == text) return info.tonemap;
  return std::nullopt;
}

}  // namespace tyndall::image
