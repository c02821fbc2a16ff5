#include "generate/text.h"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <map>
#include <memory>

#include "base/utf8.h"
#include "generate/extrude.h"
#include "generate/fonts.h"
#include "generate/line.h"

namespace tyndall::generate {

namespace {

// A letter's outlines as FreeType tells them, in metres, with curves cut into straight pieces.
struct Pen {
  double scale;
  std::vector<Outline> outlines;

  Pair<double> place(const FT_Vector& v) const {
    return {static_cast<double>(v.x) * scale, static_cast<double>(v.y) * scale};
  }
  Pair<double> last() const { return outlines.back().back(); }
  void add(const Pair<double>& p) { outlines.back().push_back(p); }
  // Calls at(t) for the pieces' ends.
  template <class At>
  void curve(At at) {
    for (std::size_t k = 1; k <= pieces_of_curve; ++k) add(at(static_cast<double>(k) / pieces_of_curve));
  }
};

Pair<double> between(const Pair<double>& a, const Pair<double>& b, double t) {
  return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t};
}

constexpr FT_Outline_Funcs pen_moves{
    [](const FT_Vector* to, void* user) {
      auto& pen = *static_cast<Pen*>(user);
      pen.outlines.push_back({pen.place(*to)});
      return 0;
    },
    [](const FT_Vector* to, void* user) {
      auto& pen = *static_cast<Pen*>(user);
      pen.add(pen.place(*to));
      return 0;
    },
    [](const FT_Vector* control, const FT_Vector* to, void* user) {
      auto& pen = *static_cast<Pen*>(user);
      const Pair<double> a = pen.last(), b = pen.place(*control), c = pen.place(*to);
      pen.curve([&](double t) { return between(between(a, b, t), between(b, c, t), t); });
      return 0;
    },
    [](const FT_Vector* control, const FT_Vector* control_2, const FT_Vector* to, void* user) {
      auto& pen = *static_cast<Pen*>(user);
      const Pair<double> a = pen.last(), b = pen.place(*control), c = pen.place(*control_2),
                         d = pen.place(*to);
      pen.curve([&](double t) {
        const Pair<double> bc = between(b, c, t);
        return between(between(between(a, b, t), bc, t), between(bc, between(c, d, t), t), t);
      });
      return 0;
    },
    0,
    0};

struct Letter {
  Area area;
  std::vector<Outline> outlines;
};

class Font {
 public:
  Font(const std::filesystem::path& file, double size) {
    FT_Library library = nullptr;
    if (FT_Init_FreeType(&library) != 0) return;
    library_.reset(library);
    FT_Face face = nullptr;
    if (FT_New_Face(library, file.c_str(), 0, &face) != 0) return;
    face_.reset(face);
    if (good()) scale_ = size / face->units_per_EM;
  }
  bool good() const { return face_ && FT_IS_SCALABLE(face_.get()) && face_->units_per_EM > 0; }
  unsigned glyph(char32_t c) const { return FT_Get_Char_Index(face_.get(), c); }
  double line_height() const { return face_->height * scale_; }
  // How far the next letter stands from the one before.
  double kerning(unsigned left, unsigned right) const {
    FT_Vector way{};
    if (FT_Get_Kerning(face_.get(), left, right, FT_KERNING_UNSCALED, &way) != 0) return 0;
    return static_cast<double>(way.x) * scale_;
  }
  double advance(unsigned glyph) const {
    return load(glyph) ? static_cast<double>(face_->glyph->metrics.horiAdvance) * scale_ : 0;
  }
  // Null for one that is damaged.
  const Letter* letter(unsigned glyph) {
    const auto [known, is_new] = letters_.try_emplace(glyph);
    if (!is_new) return &known->second;
    constexpr std::size_t most_crossings = 100;  // of overlapping strokes; each adds a point
    Pen pen{scale_, {}};
    if (!load(glyph) || FT_Outline_Decompose(&face_->glyph->outline, &pen_moves, &pen) != 0) return nullptr;
    std::size_t points = 0;
    for (const Outline& outline : pen.outlines) points += outline.size();
    if (points > most_outline_points || crossings(pen.outlines, most_crossings).size() == most_crossings)
      return nullptr;
    known->second = {fill(pen.outlines, Filled::nonzero), pen.outlines};
    return &known->second;
  }

 private:
  bool load(unsigned glyph) const {
    return FT_Load_Glyph(face_.get(), glyph, FT_LOAD_NO_SCALE) == 0 &&
           face_->glyph->format == FT_GLYPH_FORMAT_OUTLINE;
  }
  struct End {
    void operator()(FT_Library library) const { FT_Done_FreeType(library); }
    void operator()(FT_Face face) const { FT_Done_Face(face); }
  };
  std::unique_ptr<FT_LibraryRec_, End> library_;
  std::unique_ptr<FT_FaceRec_, End> face_;
  double scale_ = 0;
  std::map<unsigned, Letter> letters_;
};

struct Placed {
  unsigned glyph;
  Pair<double> at;
};

// Where the letters of a text stand; or the problem.
Problems lay_out(const Text& text, Font& font, std::vector<Placed>& out) {
  std::size_t line_begin = 0;
  Pair<double> at;
  unsigned before = 0;
  const auto end_line = [&] {
    const double shift = text.align == Align::left ? 0 : text.align == Align::center ? at.x / 2 : at.x;
    for (std::size_t i = line_begin; i < out.size(); ++i) out[i].at.x -= shift;
    line_begin = out.size();
    at = {0, at.y - font.line_height()};
    before = 0;
  };
  for (std::size_t i = 0; i < text.text.size();) {
    const CodePoint c = decode_utf8(text.text, i);
    const std::string_view written = std::string_view(text.text).substr(i, c.bytes);
    i += c.bytes;
    if (c.value == '\n') {
      end_line();
      continue;
    }
    const unsigned glyph = c.valid ? font.glyph(c.value) : 0;
    if (glyph == 0)
      return {{"text", fmt::format("the font has no '{}'", c.value < ' ' ? "control character" : written),
               "leave it out, or name a `font` that has it"}};
    if (before != 0) at.x += font.kerning(before, glyph);
    out.push_back({glyph, at});
    at.x += font.advance(glyph);
    before = glyph;
  }
  end_line();
  return {};
}

}  // namespace

bool Text::names_file() const { return font && font->find_first_of("./") != std::string::npos; }

Problems Text::validate() const {
  Problems problems;
  want_positive(problems, "size", size);
  want_positive(problems, "depth", depth);
  if (text.find_first_not_of(" \n") == std::string::npos)
    problems.push_back({"text", "there is nothing to write: 'text' has no letter"});
  return problems;
}

double Text::facets() const {
  constexpr double of_letter = 100;  // about
  return of_letter * static_cast<double>(text.size());
}

Made Text::make() const {
  const std::filesystem::path file = !font_file.empty() ? font_file
                                     : font             ? system_font(*font)
                                                        : standard_font();
  if (file.empty() && font)
    return {{},
            {{"font", fmt::format("the system has no font '{}'", *font),
              "a file has its ending: \"carved.ttf\""}}};
  if (file.empty())
    return {{},
            {{"font", "the system has no font", "install one, such as fonts-dejavu-core, or name a file"}}};
  Font face(file, size);
  if (!face.good())
    return {{},
            {{"font", fmt::format("'{}' is no font with outlines", font.value_or(file.string())),
              "TrueType and OpenType fonts can be read: .ttf and .otf"}}};
  std::vector<Placed> letters;
  if (Problems problems = lay_out(*this, face, letters); !problems.empty()) return {{}, std::move(problems)};
  Extrusion how;
  how.high = depth;
  std::size_t facets = 0;
  std::vector<Outline> all;
  for (const Placed& placed : letters) {
    const Letter* letter = face.letter(placed.glyph);
    if (!letter) return {{}, {{"font", "a letter of the font is damaged", "name another `font`"}}};
    facets += letter->area.facets();
    Problems problems;
    want_few_facets(problems, "text", static_cast<double>(facets));
    if (!problems.empty()) return {{}, std::move(problems)};
    if (letter->outlines.empty()) continue;
    Pair<double> low, high;
    bounds_of(letter->outlines, low, high);
    all.push_back({{low.x + placed.at.x, low.y + placed.at.y}, {high.x + placed.at.x, high.y + placed.at.y}});
  }
  if (facets == 0) return {{}, {{"text", "there is nothing to write: these letters have no outline"}}};
  Pair<double> from, to;
  bounds_of(all, from, to);
  MeshMaker maker;
  for (const Placed& placed : letters) {
    how.origin = {placed.at.x, placed.at.y, 0};
    how.from = {from.x - placed.at.x, from.y - placed.at.y};
    how.to = {to.x - placed.at.x, to.y - placed.at.y};
    extrude(maker, face.letter(placed.glyph)->area, how);
  }
  return {maker.take(), {}};
}

}  // namespace tyndall::generate
