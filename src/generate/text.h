#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/fields.h"
#include "generate/made.h"

namespace tyndall::generate {

// Where lines of text stand from the origin.
enum class Align { left, center, right };
struct AlignInfo {
  Align value;
  std::string_view name;
};
inline constexpr AlignInfo alignments[] = {
    {Align::left, "left"}, {Align::center, "center"}, {Align::right, "right"}};

// Letters with a thickness.
struct Text {
  static constexpr std::string_view keyword = "text";
  static constexpr std::string_view documentation =
      "Letters with a thickness, from z = 0 up to their depth, to be read from +z. The first line stands on "
      "the x axis; \\n begins another. On their faces `uv` goes from 0 to 1 over the box around the whole "
      "text; on their sides `uv.x` goes around each outline and `uv.y` along the depth.";
  static constexpr bool closed = true;
  static constexpr std::string_view way_to_close = {};
  std::string text;
  std::optional<std::string> font;
  double size = 1, depth = 0.1;
  Align align = Align::left;
  std::filesystem::path font_file;  // where `font` was found; empty: one of the system's is looked for
  template <class F>
  static void fields(F&& field) {
    field(&Text::text, FieldInfo{"text", "what is written", Quantity::plain, required});
    field(&Text::font,
          FieldInfo{"font",
                    "a file: \"carved.ttf\"; or the name of a file of the system's fonts without its ending: "
                    "\"DejaVuSerif-Bold\"; default: a sans-serif one of the system"});
    field(&Text::size,
          FieldInfo{"size",
                    "the size of the font: lines are about so far apart, and capitals 0.7 of it, > 0 [m]",
                    Quantity::length});
    field(&Text::depth, FieldInfo{"depth", "how thick the letters are, > 0 [m]", Quantity::length});
    field(
        &Text::align,
        FieldInfo{"align",
                  "where lines begin, end or have their middle: `left`, `center` or `right` of the y axis"});
  }
  // A file of its own, not one of the system's.
  bool names_file() const;
  Problems validate() const;
  double facets() const;
  Made make() const;
};

}  // namespace tyndall::generate
