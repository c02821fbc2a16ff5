// Lays a scene out anew: blocks on one line where the author wrote them so and they fit, an item a line
// otherwise; line breaks inside values, single empty lines, tables and comments stay where the author put
// them.
#include "syntax/format.h"

#include <algorithm>

#include "base/check.h"
#include "base/line_ends.h"
#include "syntax/format_lines.h"
#include "syntax/format_marks.h"

namespace tyndall::syntax {

namespace {

using enum TokenKind;

bool ends_value(TokenKind k) {
  return k == name || k == number || k == color || k == string || k == string_tail || k == kw_true ||
         k == kw_false || k == right_paren || k == right_bracket || k == right_brace;
}
bool opens(TokenKind k) { return k == left_paren || k == left_bracket; }
bool closes(TokenKind k) { return k == right_paren || k == right_bracket; }
bool is_range(TokenKind k) { return k == dot_dot || k == dot_dot_less; }

class Formatter {
 public:
  Formatter(std::string_view text, const TokenList& list, const SyntaxTree& tree)
      : text_(text),
        tokens_(list.tokens),
        comments_(list.comments),
        marks_(mark_tokens(text, list, tree)),
        branches_flat_(marks_.size()) {}

  std::string run() {
    if (text_.starts_with(byte_order_mark)) counted_ = byte_order_mark.size();
    for (std::uint32_t i = 0; kind(i) != end_of_file; i = last_of_unit(i) + 1) {
      if (marks_[i].dropped) continue;
      token(i);
      before_ = i;
    }
    gap_at_line_begin(end(), 0, false);
    return lines_.text();
  }

 private:
  // A bracket or brace that is open.
  struct Open {
    std::uint32_t token;
    bool block, flat;
    bool by_author;      // broken since the author broke it, not for its length
    std::size_t indent;  // of the line on which it was opened
  };

  TokenKind kind(std::uint32_t i) const { return tokens_[i].kind; }
  std::uint32_t end() const { return static_cast<std::uint32_t>(tokens_.size() - 1); }
  // A string with its interpolations is one unit, and keeps its spelling.
  std::uint32_t last_of_unit(std::uint32_t i) const { return kind(i) == string_head ? marks_[i].match : i; }
  std::string_view text_of(std::uint32_t i) const {
    const std::uint32_t begin = tokens_[i].span.begin;
    return text_.substr(begin, tokens_[last_of_unit(i)].span.end - begin);
  }
  std::uint32_t end_of(std::uint32_t i) const { return tokens_[last_of_unit(i)].span.end; }
  std::size_t line_breaks(std::uint32_t begin, std::uint32_t end_offset) const {
    return static_cast<std::size_t>(std::count(text_.begin() + begin, text_.begin() + end_offset, '\n'));
  }
  bool on_one_line(std::uint32_t first, std::uint32_t last) const {
    return line_breaks(tokens_[first].span.begin, end_of(last)) == 0;
  }
  // Before an item on the line of what stands before it.
  std::size_t spaces_between_items(std::uint32_t left) const {
    return kind(left) == left_brace || kind(left) == comma ? 1 : 2;
  }
  bool begins_item(std::uint32_t i) const { return marks_[i].item_end != no_token; }
  bool in_flat_block() const { return !open_.empty() && open_.back().flat; }
  bool in_brackets() const { return !open_.empty() && !open_.back().block; }
  // The indentation of the items of the innermost block.
  std::size_t item_indent() const {
    for (auto it = open_.rbegin(); it != open_.rend(); ++it)
      if (it->block) return it->indent + indent_step;
    return 0;
  }
  std::size_t continuation_indent(std::uint32_t i) const {
    if (in_brackets()) return open_.back().indent + (closes(kind(i)) ? 0 : indent_step);
    return item_indent() + (marks_[i].else_statement ? 0 : indent_step);
  }

  void token(std::uint32_t i);
  void close_block(std::uint32_t i);
  void open_block(std::uint32_t i);
  void begin_item(std::uint32_t i);
  void gap_in_line(std::uint32_t i, std::size_t spaces);
  void gap_at_line_begin(std::uint32_t i, std::size_t indent, bool blank_allowed);
  void put_comment(const Span& comment, std::uint32_t last_end, std::size_t indent, bool blank_allowed);
  void put_gap(std::uint32_t i, std::size_t spaces);
  bool may_break(std::uint32_t left, std::uint32_t right) const;
  std::size_t spaces_between(std::uint32_t left, std::uint32_t right) const;
  std::size_t flat_width(std::uint32_t first, std::uint32_t last) const;
  std::size_t most_comment_width(std::uint32_t last) const;
  bool fits(std::uint32_t open, std::uint32_t last, std::size_t spaces) const;
  bool joins_parameters(std::uint32_t i) const;
  std::size_t source_column(std::uint32_t offset);
  bool has_comment_before(std::uint32_t i) const {
    return next_comment_ < comments_.size() && comments_[next_comment_].begin < tokens_[i].span.begin;
  }

  static constexpr std::size_t indent_step = 2;

  std::string_view text_;
  const std::vector<Token>& tokens_;
  const std::vector<Span>& comments_;
  std::vector<TokenMark> marks_;
  FormatLines lines_;
  std::vector<Open> open_;
  std::uint32_t before_ = no_token;  // the unit put last
  std::size_t next_comment_ = 0;     // the first that is not put yet
  std::size_t item_line_ = 0;        // the line on which the last item of a block began
  std::vector<bool>
      branches_flat_;  // at the first `{` of an `if` statement: how all its branches are laid out
  // A place in the text and its column, from which the next one is counted.
  std::uint32_t counted_ = 0;
  std::size_t counted_column_ = 0;
};

void Formatter::token(std::uint32_t i) {
  const TokenKind k = kind(i);
  if (k == right_brace) return close_block(i);
  if (begins_item(i)) {
    begin_item(i);
  } else {
    const std::size_t spaces = spaces_between(before_, i);
    if (k == left_brace) return open_block(i);
    gap_in_line(i, spaces);
    if (closes(k)) open_.pop_back();
    if (opens(k)) open_.push_back({i, false, in_flat_block(), false, lines_.indent()});
  }
  lines_.put(text_of(i));
  while (next_comment_ < comments_.size() && comments_[next_comment_].begin < end_of(i)) ++next_comment_;
}

void Formatter::begin_item(std::uint32_t i) {
  if (in_flat_block()) {
    gap_in_line(i, spaces_between_items(before_));
  } else if (joins_parameters(i)) {
    gap_in_line(i, spaces_between_items(before_));
  } else {
    gap_at_line_begin(i, item_indent(), before_ != no_token && kind(before_) != left_brace);
  }
  item_line_ = lines_.count();
}

// Whether a parameter goes on the line of the one before, as the author wrote it.
bool Formatter::joins_parameters(std::uint32_t i) const {
  if (open_.empty() || !open_.back().by_author || !marks_[i].parameter || kind(before_) == left_brace)
    return false;
  if (line_breaks(end_of(before_), tokens_[i].span.begin) > 0 || lines_.count() != item_line_) return false;
  const std::uint32_t last = marks_[i].item_end;
  return on_one_line(i, last) &&
         lines_.column() + 2 + flat_width(i, last) + most_comment_width(last) <= max_columns;
}

// The columns that the comments up to the end of a token take at most, spaces included.
std::size_t Formatter::most_comment_width(std::uint32_t last) const {
  std::size_t width = 0;
  for (std::size_t k = next_comment_; k < comments_.size() && comments_[k].begin < end_of(last); ++k)
    width += 2 + columns(text_.substr(comments_[k].begin, comments_[k].end - comments_[k].begin));
  return width;
}

// Whether tokens up to `last`, and the brackets that close after it, have room on the line.
bool Formatter::fits(std::uint32_t open, std::uint32_t last, std::size_t spaces) const {
  std::size_t width = flat_width(open, last);
  for (std::uint32_t i = last + 1; closes(kind(i)) || kind(i) == comma; ++i) ++width;
  return lines_.column() + spaces + width <= max_columns;
}

void Formatter::open_block(std::uint32_t i) {
  const std::size_t spaces = spaces_between(before_, i);
  const std::uint32_t close = marks_[i].match, first = marks_[i].first_brace;
  bool flat = in_flat_block(), by_author = !on_one_line(i, close);
  if (first != no_token && first != i) {
    flat = branches_flat_[first];
  } else if (!flat) {
    const std::uint32_t last = first == i ? marks_[i].last_brace : close;
    flat = on_one_line(i, last) && fits(i, last, spaces);
  }
  if (first == i) branches_flat_[i] = flat;
  gap_in_line(i, spaces);
  open_.push_back({i, true, flat, by_author, lines_.indent()});
  lines_.put("{");
}

void Formatter::close_block(std::uint32_t i) {
  const Open block = open_.back();
  CHECK(block.block);
  const bool empty = before_ == block.token && !has_comment_before(i);
  if (empty) {
    open_.pop_back();
  } else if (block.flat) {
    gap_in_line(i, 1);
    open_.pop_back();
  } else {
    gap_at_line_begin(i, block.indent, false);
    open_.pop_back();
  }
  lines_.put("}");
}

// Puts the comments before token `i` and begins its line.
void Formatter::gap_at_line_begin(std::uint32_t i, std::size_t indent, bool blank_allowed) {
  const std::size_t comment_indent = kind(i) == right_brace ? item_indent() : indent;
  std::uint32_t last_end = before_ == no_token ? 0 : end_of(before_);
  bool begun = before_ == no_token;
  bool after_text = blank_allowed;  // an empty line may come between what stands before and here
  while (has_comment_before(i) || (kind(i) == end_of_file && next_comment_ < comments_.size())) {
    const Span comment = comments_[next_comment_++];
    const bool own_line = line_breaks(last_end, comment.begin) > 0 || lines_.line_is_empty();
    put_comment(comment, last_end, comment_indent, after_text);
    begun = own_line && text_[comment.begin + 1] == '*';
    after_text = kind(i) != right_brace || has_comment_before(i);
    last_end = comment.end;
  }
  if (kind(i) == end_of_file) return;
  const std::size_t breaks = line_breaks(last_end, tokens_[i].span.begin);
  if (begun && breaks == 0 && kind(i) != right_brace && !lines_.line_is_empty()) return lines_.put(" ");
  if (breaks > 1 && after_text && kind(i) != right_brace) lines_.blank_line();
  lines_.begin_line(indent);
}

// Puts a comment on a line of its own if the author did, else at the end of the line.
void Formatter::put_comment(const Span& comment, std::uint32_t last_end, std::size_t indent,
                            bool blank_allowed) {
  const std::size_t breaks = line_breaks(last_end, comment.begin);
  const bool to_line_end = text_[comment.begin + 1] == '/';
  if (breaks > 0 || lines_.line_is_empty()) {
    if (breaks > 1 && blank_allowed) lines_.blank_line();
    lines_.begin_line(indent);
  } else if (to_line_end) {
    lines_.put_cell(CellKind::comment, 2, source_column(comment.begin), comment.begin - last_end);
  } else {
    lines_.put(" ");
  }
  lines_.put(text_.substr(comment.begin, comment.end - comment.begin));
}

// Goes on in the line, or in a new one where the author broke it inside a value or a comment wants it.
void Formatter::gap_in_line(std::uint32_t i, std::size_t spaces) {
  const std::size_t indent = continuation_indent(i);
  std::uint32_t last_end = end_of(before_);
  if (!has_comment_before(i)) {
    if (may_break(before_, i) && line_breaks(last_end, tokens_[i].span.begin) > 0)
      return lines_.begin_line(indent);
    return put_gap(i, spaces);
  }
  bool must_break = false;
  while (has_comment_before(i)) {
    const Span comment = comments_[next_comment_++];
    if (must_break) lines_.begin_line(indent);
    put_comment(comment, last_end, indent, false);
    must_break = text_[comment.begin + 1] == '/';
    last_end = comment.end;
  }
  if (must_break || line_breaks(last_end, tokens_[i].span.begin) > 0)
    lines_.begin_line(indent);
  else
    lines_.put(" ");
}

// Puts the spaces before token `i`; where a table may have a column, as a cell of it.
void Formatter::put_gap(std::uint32_t i, std::size_t spaces) {
  const std::uint32_t last_end = end_of(before_), begin = tokens_[i].span.begin;
  const auto cell = [&](CellKind cell_kind) {
    lines_.put_cell(cell_kind, spaces, source_column(begin), begin - last_end);
  };
  if (marks_[i].defines) return cell(CellKind::equals);
  if (marks_[i].opens_statement) return cell(CellKind::brace);
  if (marks_[i].parameter && kind(before_) != left_brace) return cell(CellKind::parameter);
  if (marks_[before_].names_value) return cell(CellKind::argument);
  lines_.put(std::string(spaces, ' '));
}

// Where a line break of the author is kept inside an item.
bool Formatter::may_break(std::uint32_t left, std::uint32_t right) const {
  const TokenKind l = kind(left), r = kind(right);
  if (in_flat_block() || begins_item(right) || r == left_brace || r == right_brace) return false;
  if (opens(l) || l == comma || marks_[left].names_value || marks_[left].defines || closes(r)) return true;
  if (r == comma || r == colon || r == dot || l == dot || marks_[right].else_statement) return false;
  const auto is_operator = [](TokenKind k) {
    return k == plus || k == minus || k == star || k == slash || k == kw_and || k == kw_or || k == kw_then ||
           k == kw_else || (k >= less && k <= not_equal);
  };
  return (is_operator(l) && ends_value(kind(left - 1))) || (is_operator(r) && ends_value(l)) ||
         l == kw_then || l == kw_else;
}

// Spaces between two tokens on one line, the second of which begins no item.
std::size_t Formatter::spaces_between(std::uint32_t left, std::uint32_t right) const {
  const TokenKind l = kind(left), r = kind(right);
  if (l == number && r == dot) return 1;  // a dot joined to a number may be taken for its own
  if (opens(l) || closes(r) || l == dot || r == dot || r == comma || r == colon) return 0;
  if (l == minus && (left == 0 || !ends_value(kind(left - 1)))) return 0;
  if (l == caret || r == caret) return 0;
  if (is_range(l) || is_range(r)) {
    const bool dots_meet = is_range(l) && text_[tokens_[right].span.begin] == '.';
    return marks_[is_range(l) ? left : right].loose_range || dots_meet ? 1 : 0;
  }
  if (opens(r)) return ends_value(l == string_head ? string_tail : l) ? 0 : 1;
  return 1;
}

// The width of tokens on one line; comments between them are no reason to break it.
std::size_t Formatter::flat_width(std::uint32_t first, std::uint32_t last) const {
  std::size_t width = columns(text_of(first));
  std::uint32_t left = first;
  for (std::uint32_t i = last_of_unit(first) + 1; i <= last; i = last_of_unit(i) + 1) {
    if (marks_[i].dropped) continue;
    const bool empty_block = kind(left) == left_brace && kind(i) == right_brace;
    if (begins_item(i))
      width += spaces_between_items(left);
    else if (!empty_block)
      width += kind(i) == right_brace ? 1 : spaces_between(left, i);
    width += columns(text_of(i));
    left = i;
  }
  return width;
}

// The column in the source; asked from the beginning of the text to its end.
std::size_t Formatter::source_column(std::uint32_t offset) {
  const std::string_view between = text_.substr(counted_, offset - counted_);
  const std::size_t line_break = between.rfind('\n');
  counted_column_ = line_break == std::string_view::npos ? counted_column_ + columns(between)
                                                         : columns(between.substr(line_break + 1));
  counted_ = offset;
  return counted_column_;
}

}  // namespace

std::string format(const Sources& sources, SourceId source, const TokenList& tokens, const SyntaxTree& tree) {
  return Formatter(sources[source].text(), tokens, tree).run();
}

}  // namespace tyndall::syntax
