#include "tools/setting_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <concepts>
#include <functional>

#include "tools/numbers.h"

namespace tyndall::tools {
namespace {

// Called when an option was given.
using Note = std::function<void()>;

// Adds the option of a setting.
template <std::integral Whole>
void add_option(CLI::App& command, const scene::SettingInfo& info, Whole& value, const Note& note) {
  add_whole_text_option(command, info.option, std::string(info.help),
                        [&value, note](const std::string& text, const WholeOption& option) {
                          value = read_wholes<Whole, 1>(option, text)[0];
                          note();
                        });
}

void add_option(CLI::App& command, const scene::SettingInfo& info, scene::Resolution& value,
                const Note& note) {
  add_whole_text_option(command, info.option, std::string(info.help),
                        [&value, note](const std::string& text, const WholeOption& option) {
                          const auto [width, height] = read_wholes<int, 2>(option, text);
                          value = {width, height};
                          note();
                        });
}

// "0.1", "auto", "adaptive(2%)", "auto(1%)", "auto(0.01)".
std::optional<scene::Step> read_step(std::string_view text) {
  if (text == "auto") return scene::Step();
  std::string_view choice;
  for (const std::string_view word : {"auto", "adaptive"})
    if (text.starts_with(word) && text.substr(word.size()).starts_with("(") && text.ends_with(")"))
      choice = word;
  if (!choice.empty()) text = text.substr(choice.size() + 1, text.size() - choice.size() - 2);
  const bool percent = !choice.empty() && text.ends_with("%");
  if (percent) text.remove_suffix(1);
  const std::optional<double> number = read_decimal<double>(text);
  if (!number || !(*number > 0)) return std::nullopt;
  if (choice.empty()) return scene::Step(*number);
  const double tolerance = percent ? *number / 100 : *number;
  if (!(tolerance < 1)) return std::nullopt;
  return choice == "auto" ? scene::Step::proven_within(tolerance) : scene::Step::estimated_within(tolerance);
}

void add_option(CLI::App& command, const scene::SettingInfo& info, scene::Step& value, const Note& note) {
  const RealOption& option = real_option(info.option);
  add_text_option(command, option.name, option.form, std::string(info.help),
                  [&value, &option, note](const std::string& text) {
                    const std::optional<scene::Step> step = read_step(text);
                    if (!step) refuse(option.name, option.wanted, text);
                    value = *step;
                    note();
                  });
}

void add_option(CLI::App& command, const scene::SettingInfo& info, scene::MultipleScattering& value,
                const Note& note) {
  using scene::ApproximateScattering, scene::MultipleScattering;
  add_text_option(
      command, info.option, fmt::format("{}|{}", MultipleScattering::full, ApproximateScattering::keyword),
      std::string(info.help), [&value, option = info.option, note](const std::string& text) {
        const std::vector<std::string_view> names{MultipleScattering::full, ApproximateScattering::keyword};
        if (std::find(names.begin(), names.end(), text) == names.end()) refuse_name(option, names, text);
        value.approximate.reset();
        if (text == ApproximateScattering::keyword) value.approximate.emplace();
        note();
      });
}

// "4", "off,4", "off".
std::optional<scene::Clamp> read_clamp(std::string_view text) {
  const auto limit = [](std::string_view part) -> std::optional<double> {
    if (part == scene::Clamp::off) return infinity;
    const std::optional<double> number = read_decimal<double>(part);
    return number && *number > 0 ? number : std::nullopt;
  };
  const std::size_t comma = text.find(',');
  const auto direct = limit(text.substr(0, comma));
  const auto indirect = comma == std::string_view::npos ? direct : limit(text.substr(comma + 1));
  if (!direct || !indirect) return std::nullopt;
  return scene::Clamp{*direct, *indirect};
}

void add_option(CLI::App& command, const scene::SettingInfo& info, scene::Clamp& value, const Note& note) {
  const RealOption& option = real_option(info.option);
  add_text_option(command, option.name, option.form, std::string(info.help),
                  [&value, &option, note](const std::string& text) {
                    const std::optional<scene::Clamp> clamp = read_clamp(text);
                    if (!clamp) refuse(option.name, option.wanted, text);
                    value = *clamp;
                    note();
                  });
}

template <class T>
void put_in_place(const T& given, T& setting) {
  setting = given;
}
// `approximate` keeps the scene's numbers.
void put_in_place(const scene::MultipleScattering& given, scene::MultipleScattering& setting) {
  if (!given.approximate || !setting.approximate) setting = given;
}

// As options write it.
std::string option_text(std::integral auto value) { return fmt::format("{}", value); }
std::string option_text(const scene::Resolution& size) {
  return fmt::format("{}x{}", size.width, size.height);
}
std::string option_text(const scene::Step& step) { return scene::describe(step); }
std::string option_text(const scene::Clamp& clamp) {
  const auto one = [](double limit) { return scene::describe(scene::Clamp{limit, limit}); };
  return clamp.direct == clamp.indirect ? one(clamp.direct)
                                        : fmt::format("{},{}", one(clamp.direct), one(clamp.indirect));
}
std::string option_text(const scene::MultipleScattering& scattering) {
  return std::string(scattering.approximate ? scene::ApproximateScattering::keyword
                                            : scene::MultipleScattering::full);
}

// As metadata tell it.
template <class T>
std::string told_text(const T& value) {
  return option_text(value);
}
std::string told_text(const scene::MultipleScattering& scattering) { return scene::describe(scattering); }

// What is told of a setting that was given in place of one that is told as `own`.
template <class T>
std::string told_in_place(const T& given, const std::string&) {
  return told_text(given);
}
std::string told_in_place(const scene::MultipleScattering& given, const std::string& own) {
  const bool keeps = given.approximate && own.starts_with(scene::ApproximateScattering::keyword);
  return keeps ? own : told_text(given);
}

}  // namespace

void add_setting_options(CLI::App& command, GivenSettings& given) {
  scene::RenderSettings::fields([&](auto member, const scene::SettingInfo& info) {
    add_option(command, info, given.values.*member, [&given, name = info.name] { given.names.insert(name); });
  });
}

void apply(const GivenSettings& given, scene::RenderSettings& settings) {
  scene::RenderSettings::fields([&](auto member, const scene::SettingInfo& info) {
    if (given.names.contains(info.name)) put_in_place(given.values.*member, settings.*member);
  });
}

std::vector<std::pair<std::string_view, std::string>> as_options(const GivenSettings& given) {
  std::vector<std::pair<std::string_view, std::string>> options;
  scene::RenderSettings::fields([&](auto member, const scene::SettingInfo& info) {
    if (given.names.contains(info.name)) options.emplace_back(info.option, option_text(given.values.*member));
  });
  return options;
}

std::vector<std::pair<std::string, std::string>> as_texts(const scene::RenderSettings& settings) {
  std::vector<std::pair<std::string, std::string>> texts;
  scene::RenderSettings::fields([&](auto member, const scene::SettingInfo& info) {
    texts.emplace_back(info.name, told_text(settings.*member));
  });
  return texts;
}

bool is_setting(std::string_view name) {
  bool found = false;
  scene::RenderSettings::fields([&](auto, const scene::SettingInfo& info) { found |= info.name == name; });
  return found;
}

std::string text_of(const GivenSettings& given, std::string_view name, const std::string& own) {
  std::string text = own;
  scene::RenderSettings::fields([&](auto member, const scene::SettingInfo& info) {
    if (info.name == name && given.names.contains(name)) text = told_in_place(given.values.*member, own);
  });
  return text;
}

bool has_own_entry(std::string_view name) {
  bool own = false;
  scene::RenderSettings::fields([&](auto, const scene::SettingInfo& info) {
    own |= info.name == name && info.told_in == scene::ToldIn::own_entry;
  });
  return own;
}

}  // namespace tyndall::tools
