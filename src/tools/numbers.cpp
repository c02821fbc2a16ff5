#include "tools/numbers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <concepts>
#include <limits>

#include "base/check.h"
#include "base/diagnostics.h"
#include "scene/render_settings.h"

namespace tyndall::tools {
namespace {

using scene::RenderSettings, scene::SettingInfo;

constexpr WholeOption whole(std::string_view name, std::string_view form, const scene::WholeRange& range) {
  return {name, form, range.least, static_cast<std::uint64_t>(range.most)};
}

// Appends the row of a setting to the table that it belongs to.
struct SettingRows {
  std::vector<WholeOption>* wholes = nullptr;
  std::vector<RealOption>* reals = nullptr;

  template <std::integral Whole>
  void add(const SettingInfo& info, Whole RenderSettings::*) const {
    constexpr WholeOption all{{}, "N", std::numeric_limits<Whole>::min(), std::numeric_limits<Whole>::max()};
    if (wholes)
      wholes->push_back(info.range ? whole(info.option, "N", *info.range)
                                   : WholeOption{info.option, all.form, all.least, all.most});
  }
  void add(const SettingInfo& info, scene::Resolution RenderSettings::*) const {
    if (wholes) wholes->push_back(whole(info.option, "WxH", *info.range));
  }
  void add(const SettingInfo& info, scene::Step RenderSettings::*) const {
    if (reals)
      reals->push_back({info.option, "X|auto|adaptive(1%)|auto(1%)",
                        "a length in metres above 0, auto, or a tolerance: adaptive(1%) or auto(1%)", false});
  }
  void add(const SettingInfo& info, scene::Clamp RenderSettings::*) const {
    if (reals)
      reals->push_back(
          {info.option, "X|X,Y|off",
           "a number above 0, two of them for direct and indirect light (either may be off), or off", false});
  }
  void add(const SettingInfo&, scene::MultipleScattering RenderSettings::*) const {}
};

std::vector<WholeOption> make_whole_options() {
  constexpr std::int64_t last_side = RenderSettings::resolution_range.most,
                         last_sample = RenderSettings::samples_range.most - 1;
  std::vector<WholeOption> table;
  RenderSettings::fields([rows = SettingRows{.wholes = &table}](auto member, const SettingInfo& info) {
    rows.add(info, member);
  });
  table.insert(table.end(), {
                                whole("--frame", "N", scene::frame_range),
                                whole("--crop", "X0,Y0,X1,Y1", {0, last_side}),
                                whole("--sample-range", "A..B", {0, last_sample}),
                                whole("--threads", "N", {1, 4096}),
                                whole("--pixel", "X,Y", {0, last_side - 1}),
                                whole("--sample", "N", {0, last_sample}),
                                whole("--columns", "N", {1, 1000}),
                                whole("--width", "N", {16, last_side}),
                                whole("--split", "N", {1, 1024}),
                                whole("--chunk", "N", {1, 1'000'000}),
                                whole("--cpus", "N", {1, 4096}),
                                whole("--seeds", "N", {2, 1000}),
                            });
  return table;
}

std::vector<RealOption> make_real_options() {
  std::vector<RealOption> table;
  RenderSettings::fields([rows = SettingRows{.reals = &table}](auto member, const SettingInfo& info) {
    rows.add(info, member);
  });
  table.insert(table.end(),
               {
                   {"--error", "X", "a number above 0", false},
                   {"--reference-error", "X", "a number above 0", false},
                   {"--time-limit", "S", "a number above 0", false},
                   {"--checkpoint-interval", "S", "a number above 0", false},
                   {"--exposure", "X|auto|auto(X)",
                    "a number of stops, auto, or stops beside the metered ones: auto(1)", true},
                   {"--white-balance", "K|R,G,B",
                    "the temperature of a light, 1000 to 40000 kelvin, or its colour as R,G,B", false},
                   {"--bloom", "X", "a number from 0 to 1", true},
                   {"--max", "X", "a number from 0", true},
                   {"--significance", "X", "a number above 0 and below 1", false},
                   {"--pixels-per-degree", "X", "a number above 0 and up to 1000", false},
                   {"--frames", "A..B[..STEP]",
                    "frames from -1000000000 to 1000000000, for instance 1..240, 1..240..4 or "
                    "1..10,20 (at most 1000000 of them)",
                    true},
                   {"--slice", "x|y|z=METRES", "a coordinate of p in metres, for instance z=0", true},
               });
  return table;
}

template <class Row>
const Row& row_of(std::span<const Row> table, std::string_view name) {
  const auto row = std::find_if(table.begin(), table.end(), [&](const Row& r) { return r.name == name; });
  CHECK(row != table.end());
  return *row;
}

bool stands_for_a_number(char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

}  // namespace

std::span<const WholeOption> whole_options() {
  static const std::vector<WholeOption> table = make_whole_options();
  return table;
}

std::span<const RealOption> real_options() {
  static const std::vector<RealOption> table = make_real_options();
  return table;
}

const WholeOption& whole_option(std::string_view name) { return row_of(whole_options(), name); }
const RealOption& real_option(std::string_view name) { return row_of(real_options(), name); }

std::string wanted(const WholeOption& option) {
  const bool one = std::all_of(option.form.begin(), option.form.end(), stands_for_a_number);
  return fmt::format("{}a whole number from {} to {}", one ? "" : fmt::format("{}, each ", option.form),
                     option.least, option.most);
}

std::optional<std::uint64_t> read_bytes(std::string_view text) {
  constexpr std::pair<std::string_view, double> units[] = {
      {"kB", 0x1p10}, {"MB", 0x1p20}, {"GB", 0x1p30}, {"TB", 0x1p40}};
  constexpr double least = 0x1p24, most = 0x1p40;
  for (const auto& [unit, bytes] : units) {
    if (!text.ends_with(unit)) continue;
    const auto number = read_decimal<double>(text.substr(0, text.size() - unit.size()));
    if (!number || !(*number * bytes >= least && *number * bytes <= most)) break;
    return static_cast<std::uint64_t>(*number * bytes);
  }
  return std::nullopt;
}

std::optional<std::vector<std::string_view>> split_as(std::string_view form, std::string_view text) {
  std::vector<std::string_view> parts;
  while (true) {
    form.remove_prefix(std::min<std::size_t>(
        static_cast<std::size_t>(std::find_if_not(form.begin(), form.end(), stands_for_a_number) -
                                 form.begin()),
        form.size()));
    if (form.empty()) {
      parts.push_back(text);
      return parts;
    }
    const auto between_size =
        static_cast<std::size_t>(std::find_if(form.begin(), form.end(), stands_for_a_number) - form.begin());
    const std::size_t at = text.find(form.substr(0, between_size));
    if (at == std::string_view::npos) return std::nullopt;
    parts.push_back(text.substr(0, at));
    text.remove_prefix(at + between_size);
    form.remove_prefix(between_size);
  }
}

void refuse(std::string_view option, std::string_view wanted, std::string_view text) {
  throw CLI::ValidationError(std::string(option), fmt::format("wants {}, not '{}'", wanted, text));
}

void refuse_name(std::string_view option, const std::vector<std::string_view>& names, std::string_view text) {
  throw CLI::ValidationError(std::string(option), name_problem(names, text));
}

std::string name_problem(const std::vector<std::string_view>& names, std::string_view text) {
  if (std::find(names.begin(), names.end(), text) != names.end()) return {};
  const std::string meant = did_you_mean(text, names);
  return fmt::format("wants one of {}, not '{}'{}{}", fmt::join(names, ", "), text, meant.empty() ? "" : ": ",
                     meant);
}

std::string wanted_by(std::string_view option) {
  for (const WholeOption& row : whole_options())
    if (row.name == option) return wanted(row);
  for (const RealOption& row : real_options())
    if (row.name == option) return std::string(row.wanted);
  return "a value";
}

CLI::Option* add_text_option(CLI::App& command, std::string_view name, std::string_view form,
                             const std::string& help, std::function<void(const std::string&)> read) {
  return command.add_option_function<std::string>(std::string(name), std::move(read), help)
      ->option_text(std::string(form));
}

CLI::Option* add_whole_text_option(CLI::App& command, std::string_view name, const std::string& help,
                                   std::function<void(const std::string&, const WholeOption&)> read) {
  const WholeOption& option = whole_option(name);
  return add_text_option(command, name, option.form,
                         fmt::format("{} ({} to {})", help, option.least, option.most),
                         [&option, read = std::move(read)](const std::string& text) { read(text, option); });
}

CLI::Option* add_real(CLI::App& command, std::string_view name, std::optional<double>& target,
                      const std::string& help) {
  const RealOption& option = real_option(name);
  return add_text_option(command, name, option.form, help, [&option, &target](const std::string& text) {
    const auto number = read_decimal<double>(text);
    if (!number || *number < 0 || (*number == 0 && !option.takes_zero))
      refuse(option.name, option.wanted, text);
    if (option.name == "--pixels-per-degree" && *number > 1000) refuse(option.name, option.wanted, text);
    target = *number;
  });
}

}  // namespace tyndall::tools
