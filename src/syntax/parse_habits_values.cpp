// Values and definitions as other languages write them: told once, with what to write, and passed over.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "syntax/foreign_words.h"
#include "syntax/recursive_parser.h"

namespace tyndall::syntax {

// A value that a mark of another language follows, which was told, is none: nothing is said of it. `a ? b :
// c` and `x => x * 2` are passed over.
ExprId Parser::value_before_error() {
  const std::string_view mark = text(peek());
  if (mark == "?" || mark == "=>") {
    take();
    if (mark == "=>" && at(TokenKind::left_brace))
      skip_group();
    else
      expression();
    if (mark == "?" && take_if(TokenKind::colon)) expression();
  }
  return error_expr();
}

// `1,5`, `0, 1, 0` and `0 1 0` where one value stands. False where the item ends well, or in another way.
bool Parser::values_side_by_side(ItemId item) {
  const auto begins_number = [&](std::uint32_t ahead) {
    return kind(ahead) == TokenKind::number ||
           (kind(ahead) == TokenKind::minus && kind(ahead + 1) == TokenKind::number);
  };
  const auto goes_on = [&] {
    if (at(TokenKind::number)) return !first_on_line(at_);
    const bool name =
        kind(1) == TokenKind::name && (kind(2) == TokenKind::comma || kind(2) == TokenKind::right_brace);
    return at(TokenKind::comma) && (begins_number(1) || name);
  };
  const ExprId value = std::visit(
      [](const auto& node) {
        if constexpr (requires {
                        { node.value } -> std::convertible_to<ExprId>;
                        node.name;
                      })
          return node.value;
        else
          return ExprId{};
      },
      tree_[item].node);
  if (!value.valid() || !goes_on()) return false;
  const Span first = tree_[value].span;
  const std::uint32_t begin = at_;
  std::vector<std::string> parts{std::string(source_text_.substr(first.begin, first.end - first.begin))};
  while (!panic_ && goes_on()) {
    take_if(TokenKind::comma);
    const std::uint32_t part = at_;
    unary();
    const Span span = span_from(part);
    parts.emplace_back(source_text_.substr(span.begin, span.end - span.begin));
  }
  const Span all = join(first, span_from(begin));
  const bool decimal = parts.size() == 2 && std::holds_alternative<NumberExpr>(tree_[value].node) &&
                       all.end - all.begin == parts[0].size() + 1 + parts[1].size() &&
                       source_text_[first.end] == ',';
  const std::string vec = fmt::format("({})", fmt::join(parts, ", "));
  note_mistake(all, "one value belongs here",
               decimal            ? fmt::format("write {}.{}, or {} for a pair", parts[0], parts[1], vec)
               : parts.size() < 4 ? fmt::format("write {}", vec)
                                  : "a list is written in square brackets: [a, b, …]");
  tree_.exprs[value.index].node = ErrorExpr{};
  return true;
}

// `let a = 1, b = 2`: the definitions behind the first one.
bool Parser::second_definition(ItemId item) {
  const bool is_let = std::holds_alternative<LetItem>(tree_[item].node);
  if (!is_let && !std::holds_alternative<VarItem>(tree_[item].node)) return false;
  bool found = false;
  while (at(TokenKind::comma) && kind(1) == TokenKind::name && kind(2) == TokenKind::equals) {
    const Span comma = take().span;
    const Name name = take_name();
    if (!found)
      note_mistake(comma, fmt::format("a '{}' defines one name", is_let ? "let" : "var"),
                   fmt::format("write {} {} = … after it", is_let ? "let" : "var", text(name)));
    tree_.unread_definitions.push_back(name.symbol);
    take();
    expression();
    found = true;
  }
  return found;
}

// The name of a definition that has a word before it: `let mut x`, `let my size`, `let float x`.
std::optional<Name> Parser::name_without_type(std::optional<Name> name) {
  if (!name || !at(TokenKind::name) || kind(1) != TokenKind::equals || first_on_line(at_)) return name;
  const Name second = take_name();
  const std::string_view word = text(*name), last = text(second);
  const bool is_type = !help_for_foreign_word(ForeignUse::statement, word).empty();
  note_mistake(name->span, fmt::format("expected '=' after '{}', found '{}'", word, last),
               word == "mut" ? fmt::format("write var {} = …", last)
               : is_type     ? fmt::format("a name has no type: write let {} = …", last)
                             : fmt::format("a name is one word: write let {}_{} = …", word, last));
  return second;
}

// Passes over a type behind a name that is defined, and behind a parameter's: `x: float`.
void Parser::skip_type() {
  if (!at(TokenKind::colon) || kind(1) != TokenKind::name) return;
  const TokenKind after = kind(2);
  const std::string_view word = text(peek(1));
  const bool is_type = !help_for_foreign_word(ForeignUse::statement, word).empty() ||
                       !help_for_foreign_word(ForeignUse::value, word).empty();
  if (after != TokenKind::equals &&
      !(is_type && (after == TokenKind::comma || after == TokenKind::right_paren)))
    return;
  note_mistake(join(peek().span, peek(1).span), "names and parameters have no types",
               fmt::format("leave ': {}' out", word));
  take();
  take();
}

// `f"…"`: a letter that tells another language how to read the text.
bool Parser::letter_before_string(const Name& name) const {
  static constexpr std::string_view letters[] = {"f", "r", "b", "u", "F", "R", "B", "U", "fr", "rf", "L"};
  return tokens_.tokens[at_ - 1].span.end == peek().span.begin && kind(1) != TokenKind::left_brace &&
         std::find(std::begin(letters), std::end(letters), text(name)) != std::end(letters);
}

// `-- text` and `% text` on a line of their own.
bool Parser::is_comment_of_others() const {
  if (!first_on_line(at_)) return false;
  return (at(TokenKind::minus) && kind(1) == TokenKind::minus) ||
         (at(TokenKind::error) && text(peek()) == "%");
}

// A word that begins an item and has nothing behind it but the next line's. Its kind may stand there: whether
// that is one only resolving tells.
bool Parser::ends_line_alone(const Name& keyword) const {
  if (!is_word(kind()) && !at(TokenKind::end_of_file)) return false;
  const bool takes_kind = text(keyword) == "light" || text(keyword) == "camera";
  const bool may_be_kind = takes_kind || kind(1) == TokenKind::left_brace || kind(1) == TokenKind::string ||
                           kind(1) == TokenKind::string_head;
  return first_on_line(at_) && kind(1) != TokenKind::colon && !(may_be_kind && at(TokenKind::name));
}

}  // namespace tyndall::syntax
