#include "tools/measure/sweep.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "tools/numbers.h"
#include "tools/setting_options.h"

namespace tyndall::tools {
namespace {

constexpr std::size_t most_settings = 1000;
constexpr const char* sweep_option = "--sweep";

// The options of `render` that say how a picture is rendered, into `arguments`.
void add_swept_options(CLI::App& app, RenderArguments& arguments) {
  add_setting_options(app, arguments.settings);
  add_method_options(app, arguments);
}

std::string name_of_option(const CLI::Option& option) {
  std::string name = option.get_name().substr(2);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
std::string option_of_name(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return "--" + name;
}

[[noreturn]] void complain(const std::string& message) { throw CLI::ValidationError(sweep_option, message); }

// Commas inside of parentheses are the value's own, as in `clamp=off,(4,2)`.
std::vector<std::string> values_in(std::string_view text) {
  std::vector<std::string> values{""};
  int depth = 0;
  for (const char c : text) {
    depth += (c == '(') - (c == ')');
    if (c == ',' && depth == 0)
      values.emplace_back();
    else
      values.back() += c;
  }
  return values;
}

// As the option writes it.
std::string option_value(const std::string& value) {
  return value.starts_with('(') && value.ends_with(')') ? value.substr(1, value.size() - 2) : value;
}

void refuse_what_one_reference_cannot_serve(const std::string& name) {
  if (name == "resolution")
    complain(
        "cannot sweep resolution, for all settings are compared with one reference: measure each size by "
        "itself, with --resolution WxH");
  if (name == "seed")
    complain("cannot sweep seed: every setting is rendered with several, --seeds N says how many");
}

void set_value(RenderArguments& arguments, const std::string& name, const std::string& value) {
  CLI::App app;
  add_swept_options(app, arguments);
  try {
    app.parse(std::vector<std::string>{option_value(value), option_of_name(name)});  // the last word first
  } catch (const CLI::ParseError& error) {
    std::string message = error.what();
    const std::string option = option_of_name(name) + ": ";
    if (message.starts_with(option)) message.erase(0, option.size());
    complain(fmt::format("{}: {}", name, message));
  }
}

}  // namespace

std::vector<std::string> swept_names() {
  CLI::App app;
  RenderArguments arguments;
  add_swept_options(app, arguments);
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = name_of_option(*option);
    if (option != app.get_help_ptr() && name != "resolution" && name != "seed") names.push_back(name);
  }
  return names;
}

Sweep read_sweep(const std::string& text) {
  const std::size_t equals = text.find('=');
  Sweep sweep{text.substr(0, equals), {}};
  std::replace(sweep.name.begin(), sweep.name.end(), '-', '_');
  const std::vector<std::string> names = swept_names();
  refuse_what_one_reference_cannot_serve(sweep.name);
  if (const std::string problem = name_problem({names.begin(), names.end()}, sweep.name); !problem.empty())
    complain(problem);
  if (equals != std::string::npos) sweep.values = values_in(std::string_view(text).substr(equals + 1));
  for (std::size_t i = 0; i < sweep.values.size(); ++i)
    if (std::find(sweep.values.begin(), sweep.values.begin() + static_cast<std::ptrdiff_t>(i),
                  sweep.values[i]) != sweep.values.begin() + static_cast<std::ptrdiff_t>(i))
      complain(fmt::format("has {}={} twice: give each value once, --seeds says how often it is rendered",
                           sweep.name, sweep.values[i]));
  if (sweep.values.empty() || std::find(sweep.values.begin(), sweep.values.end(), "") != sweep.values.end())
    complain(
        fmt::format("wants NAME=VALUE,VALUE,… with a value before and after each comma, for instance "
                    "step=0.1,0.05, not '{}'",
                    text));
  return sweep;
}

std::string MeasuredSetting::name() const {
  std::string text;
  for (const auto& [parameter, value] : swept)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", parameter, value);
  return text.empty() ? "as the scene is" : text;
}

const std::string* MeasuredSetting::value(const std::string& parameter) const {
  for (const auto& [name, value] : swept)
    if (name == parameter) return &value;
  return nullptr;
}

std::vector<MeasuredSetting> grid_of(const RenderArguments& base, const std::vector<Sweep>& sweeps) {
  std::vector<MeasuredSetting> grid{{{}, base}};
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    const Sweep& sweep = sweeps[i];
    for (std::size_t j = 0; j < i; ++j)
      if (sweeps[j].name == sweep.name)
        complain(fmt::format("has {} twice: write all values in one, {}=A,B,C", sweep.name, sweep.name));
    if (grid.size() * sweep.values.size() > most_settings)
      complain(fmt::format("makes more than {} settings: give fewer values", most_settings));
    std::vector<MeasuredSetting> finer;
    for (const MeasuredSetting& setting : grid)
      for (const std::string& value : sweep.values) {
        MeasuredSetting next = setting;
        next.swept.emplace_back(sweep.name, value);
        set_value(next.arguments, sweep.name, value);
        finer.push_back(std::move(next));
      }
    grid = std::move(finer);
  }
  return grid;
}

}  // namespace tyndall::tools
