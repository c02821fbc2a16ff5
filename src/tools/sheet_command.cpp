// `tyndall sheet`: pictures side by side in one.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"
#include "tools/commands.h"
#include "tools/files_in_use.h"
#include "tools/numbers.h"
#include "tools/report.h"

namespace tyndall::tools {
namespace {

using image::Image;

struct SheetArguments {
  std::vector<std::string> pictures;
  std::string output;
  std::optional<int> columns, width;
  bool label = false;
};

constexpr int gap = 4, usual_cell_width = 320, largest_side = 16384;  // [pixels]
constexpr float background = 0.01f;                                   // linear

// Where the pictures stand.
struct Layout {
  int columns = 1, rows = 1, cell_width = 1, cell_height = 1, label_height = 0;

  int width() const { return gap + columns * (cell_width + gap); }
  int height() const { return gap + rows * (cell_height + label_height + gap); }
  int x(std::size_t i) const { return gap + static_cast<int>(i % columns_()) * (cell_width + gap); }
  int y(std::size_t i) const {
    return gap + static_cast<int>(i / columns_()) * (cell_height + label_height + gap);
  }

 private:
  std::size_t columns_() const { return static_cast<std::size_t>(columns); }
};

// What an 8-bit picture of this one would show, in linear light: averages of it are those of what is seen.
Image shown(const Image& image, const image::View& view) {
  const std::vector<std::uint8_t> bytes = image::display_rgb(image, view);
  const Image::Place whole = image::whole_of(image);
  Image out{whole.whole_width, whole.whole_height, {"R", "G", "B"}, {}};
  out.pixels.reserve(bytes.size());
  for (const std::uint8_t byte : bytes) out.pixels.push_back(image::linear_from_srgb(byte / 255.0f));
  return out;
}

Layout layout_of(const SheetArguments& arguments) {
  Layout layout;
  const auto count = static_cast<int>(arguments.pictures.size());
  layout.columns = std::min(
      arguments.columns.value_or(static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))))), count);
  layout.rows = (count + layout.columns - 1) / layout.columns;
  layout.cell_width = arguments.width ? (*arguments.width - gap) / layout.columns - gap : usual_cell_width;
  if (arguments.label) layout.label_height = std::clamp(layout.cell_width / 12, 14, 40);
  return layout;
}

void paste(const Image& from, Image& sheet, int x, int y) {
  for (int row = 0; row < from.height; ++row)
    std::copy_n(from.pixels.begin() + static_cast<std::ptrdiff_t>(from.index(0, row, 0)),
                static_cast<std::ptrdiff_t>(from.index(0, 1, 0)),
                sheet.pixels.begin() + static_cast<std::ptrdiff_t>(sheet.index(x, y + row, 0)));
}

// The pictures as wide as a cell, in which the highest finds room; none after an error, which is told. All
// that cannot be read are told.
std::vector<Image> small_pictures(const SheetArguments& arguments, Layout& layout) {
  std::vector<Image> pictures;
  for (const std::string& path : arguments.pictures) {
    const image::ReadResult read = image::read(path);
    if (!read.image) {
      print_error(read.error);
      continue;
    }
    const Image whole = shown(*read.image, read.view);
    const double height = std::round(static_cast<double>(layout.cell_width) * whole.height / whole.width);
    layout.cell_height =
        std::max(layout.cell_height, static_cast<int>(std::clamp(height, 1.0, 2.0 * largest_side)));
    if (layout.height() > largest_side) {
      print_error(
          fmt::format("'{}' would make a sheet of {} pixels in height, and {} are possible: use more "
                      "--columns or less --width",
                      path, layout.height(), largest_side));
      return {};
    }
    Image small;
    const std::string problem =
        image::resize(whole, layout.cell_width, std::max(static_cast<int>(height), 1), small);
    if (problem.empty())
      pictures.push_back(std::move(small));
    else
      print_error(fmt::format("cannot resize '{}': {}", path, problem));
  }
  return pictures;
}

std::string file_problem(const SheetArguments& arguments) {
  FilesInUse files;
  for (const std::string& path : arguments.pictures)
    if (std::string problem = files.read(path, "the picture"); !problem.empty()) return problem;
  if (std::string problem = image::check_writable(arguments.output); !problem.empty()) return problem;
  return files.write(arguments.output, "-o");
}

ExitStatus fail(const std::string& message) { return print_error(message), ExitStatus::problem; }

ExitStatus run_sheet(const SheetArguments& arguments) {
  if (const std::string problem = file_problem(arguments); !problem.empty()) return fail(problem);
  Layout layout = layout_of(arguments);
  if (layout.cell_width < 8 || layout.width() > largest_side)
    return misuse(
        fmt::format("{} columns do not go into a sheet of {} pixels: use fewer --columns or another "
                    "--width",
                    layout.columns, arguments.width.value_or(largest_side)));
  const std::vector<Image> pictures = small_pictures(arguments, layout);
  if (pictures.size() < arguments.pictures.size()) return ExitStatus::problem;
  Image sheet{layout.width(), layout.height(), {"R", "G", "B"}, {}};
  sheet.pixels.assign(sheet.index(0, sheet.height, 0), background);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const Image& picture = pictures[i];
    paste(picture, sheet, layout.x(i), layout.y(i) + (layout.cell_height - picture.height) / 2);
    if (!arguments.label) continue;
    const std::string text = std::filesystem::path(arguments.pictures[i]).stem().string();
    const std::string problem = image::draw_text(
        sheet, text, {layout.x(i), layout.y(i) + layout.cell_height, layout.cell_width, layout.label_height});
    if (!problem.empty()) return fail(fmt::format("cannot write the labels: {}", problem));
  }
  const std::string problem =
      image::write(arguments.output, sheet, {{"Software", "Tyndall " TYNDALL_VERSION}});
  return problem.empty() ? ExitStatus::done : fail(problem);
}

Action sheet_options(CLI::App& command) {
  const auto arguments = std::make_shared<SheetArguments>();
  command
      .add_option("pictures", arguments->pictures,
                  "The pictures (.exr, .png, .jpg, .tif) in the order of the sheet")
      ->required()
      ->option_text("PICTURE...");
  command
      .add_option("-o,--output", arguments->output,
                  "The sheet to write: .png, .jpg or .tif, or .exr (linear)")
      ->required()
      ->option_text("OUT");
  add_whole(command, "--columns", arguments->columns,
            "How many stand side by side; without it, about as many as below each other");
  add_whole(command, "--width", arguments->width, "Width of the sheet in pixels; without it, 320 a picture");
  command.add_flag("--label", arguments->label, "Write the name of its file below each picture");
  return [arguments] { return run_sheet(*arguments); };
}

}  // namespace

constinit const Command sheet_command{"sheet", "Put pictures side by side in one", sheet_options};

}  // namespace tyndall::tools
