// Values: literals, names, things, brackets, and what may follow a value: call, index, member.
#include <fmt/format.h>

#include <algorithm>

#include "syntax/recursive_parser.h"

namespace tyndall::syntax {

// postfix = value { "(" [ arguments ] ")" | "[" expression "]" | "." name }
ExprId Parser::postfix() {
  const std::uint32_t first = at_;
  ExprId result = value();
  while (!panic_) {
    if (at(TokenKind::left_paren) && callable(result))
      result = call(result, first);
    else if (at(TokenKind::left_bracket))
      result = index(result, first);
    else if (at(TokenKind::dot))
      result = member(result, first);
    else
      break;
  }
  return result;
}

// A literal, a sum or a thing is never a function: `(` after it begins something else (a comma may be
// missing).
bool Parser::callable(ExprId e) const {
  const ExprNode& node = tree_[e].node;
  return std::holds_alternative<NameExpr>(node) || std::holds_alternative<CallExpr>(node) ||
         std::holds_alternative<IndexExpr>(node) || std::holds_alternative<MemberExpr>(node) ||
         std::holds_alternative<ConditionalExpr>(node) || std::holds_alternative<ErrorExpr>(node);
}

// value = literal | string | name | thing | tuple | "(" expression ")" | list | unnamed_body
ExprId Parser::value() {
  if (at(TokenKind::number) || at(TokenKind::color) || at(TokenKind::kw_true) || at(TokenKind::kw_false))
    return literal();
  if (at(TokenKind::string) || at(TokenKind::string_head)) return string_value();
  if (at(TokenKind::name)) return begins_next_statement() ? not_a_value() : name_or_thing();
  if (at(TokenKind::left_paren)) return tuple_or_group();
  if (at(TokenKind::left_bracket)) return list();
  if (at(TokenKind::left_brace) && !brace_opens_body_) return unnamed_body();
  if (at(TokenKind::less)) return angle_bracket_vector();
  return not_a_value();
}

ExprId Parser::not_a_value() {
  std::string help;
  if (at(TokenKind::plus)) help = "leave the '+' out";
  if (at(TokenKind::equals)) help = "comparison is '=='";
  if (at(TokenKind::name)) help = "the value before it is missing";
  if (at(TokenKind::kw_medium) || at(TokenKind::kw_material)) {
    help = fmt::format("an unnamed body is written {}: {{ … }}", spelling(kind()));
    if (kind(1) == TokenKind::left_brace && !brace_opens_body_) {  // the word is too much
      note_mistake(peek().span, fmt::format("expected a value, found the reserved word {}", found()),
                   std::move(help));
      take();
      return unnamed_body();
    }
  }
  const std::string_view noun = is_reserved(kind()) ? "the reserved word " : "";
  fail(peek().span, fmt::format("expected a value, found {}{}", noun, found()), std::move(help));
  if (at(TokenKind::kw_medium) || at(TokenKind::kw_material)) take();  // it begins no definition here
  return error_expr();
}

// unnamed_body = block, as in `medium: { density = 1 }`
ExprId Parser::unnamed_body() {
  const std::uint32_t first = at_;
  if (kind(1) == TokenKind::number || kind(1) == TokenKind::minus) {
    fail(peek().span, "expected a value, found '{'", "a vec is written (x, y, z), a list [a, b, …]");
    return error_expr();
  }
  const BlockPlace place = first == braces_of_no_body_ ? BlockPlace::thing : BlockPlace::body;
  const BlockId body = block(place, "the value");
  return add(first, ThingExpr{{}, {}, body}, 1 + height(body));
}

// literal = number | color | "true" | "false"
ExprId Parser::literal() {
  const std::uint32_t first = at_;
  const Token& token = take();
  if (token.kind == TokenKind::number) {
    double value = token.number;
    const Unit unit = at(TokenKind::name) ? parted_unit(token, value) : token.unit;
    return add(first, NumberExpr{value, unit});
  }
  if (token.kind == TokenKind::color) return add(first, ColorExpr{token.text});
  return add(first, BoolExpr{token.kind == TokenKind::kw_true});
}

// format = ":" [ "0" digit { digit } ] [ "." digit ], without a space: zeros in front up to a width, and
// decimals
NumberFormat Parser::number_format() {
  const Token& colon = take();
  const std::string help = "write {x:.2} for two decimals, {i:04} for four digits";
  NumberFormat format;
  const std::string_view written =
      at(TokenKind::number) && peek().span.begin == colon.span.end ? text(peek()) : std::string_view{};
  const std::size_t point = std::min(written.find('.'), written.size());
  const std::string_view width = written.substr(0, point), decimals = written.substr(point);
  const auto digits = [](std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  };
  const bool good_width = width.empty() || (width[0] == '0' && width.size() <= 3 && digits(width));
  const bool good_decimals = decimals.empty() || (decimals.size() == 2 && digits(decimals.substr(1)));
  if (written.empty() || !good_width || !good_decimals) {
    fail(colon.span, "expected the format of a number after ':'", help);
    return format;
  }
  for (const char c : width) format.width = static_cast<std::uint8_t>(format.width * 10 + (c - '0'));
  if (!decimals.empty()) format.decimals = static_cast<std::uint8_t>(decimals[1] - '0');
  take();
  return format;
}

// string = '"' { character | escape | "{" expression [ format ] "}" } '"'
ExprId Parser::string_value() {
  const std::uint32_t first = at_;
  StringValue literal;
  std::uint32_t tallest = 0;
  TokenKind last = kind();
  literal.pieces.push_back(tokens_.strings[take().text]);
  const bool in_header = std::exchange(brace_opens_body_, false);
  while (last == TokenKind::string_head || last == TokenKind::string_middle) {
    literal.values.push_back(expression());
    tallest = std::max(tallest, height(literal.values.back()));
    literal.formats.push_back(!panic_ && at(TokenKind::colon) ? number_format() : NumberFormat{});
    if (!panic_ && !ends_everything())
      fail(peek().span, fmt::format("expected '}}' after the value in a string, found {}", found()));
    while (!ends_everything()) skip_group();
    if (at(TokenKind::end_of_file)) break;  // only after giving up
    panic_ = false;
    last = kind();
    literal.pieces.push_back(tokens_.strings[take().text]);
  }
  brace_opens_body_ = in_header;
  literal.pieces.resize(literal.values.size() + 1);
  literal.formats.resize(literal.values.size());
  tree_.strings.push_back(std::move(literal));
  return add(first, StringExpr{static_cast<std::uint32_t>(tree_.strings.size() - 1)}, 1 + tallest);
}

// value_thing = name [ string ] block, but not in the header of `if` and `for`
ExprId Parser::name_or_thing() {
  const std::uint32_t first = at_;
  const Name name = take_name();
  if (at(TokenKind::number) && !first_on_line(at_)) {
    note_mistake(join(name.span, peek().span), "an argument goes in parentheses",
                 fmt::format("write {}({})", text(name), text(peek())));
    take();
    return error_expr();
  }
  const bool file_follows = at(TokenKind::string) || at(TokenKind::string_head);
  if (file_follows && letter_before_string(name)) {
    note_mistake(name.span, fmt::format("no letter goes before a string, found '{}'", text(name)),
                 "leave it out: braces in any string hold a value, as in \"leaf{i}.png\"");
    return string_value();
  }
  if (at(TokenKind::less) && vector_word(name)) return angle_bracket_vector();
  if (at(TokenKind::name) && !first_on_line(at_) && text(name) == "lambda") {
    fail(name.span, "a function has a name here", "write def f(x) = x * 2");
    skip_line();
    return error_expr();
  }
  if (brace_opens_body_ || !(at(TokenKind::left_brace) || file_follows))
    return add(first, NameExpr{name.symbol});
  ExprId file;
  if (file_follows) file = string_value();
  if (!at(TokenKind::left_brace)) {
    fail(name.span, fmt::format("expected '(' after '{}', found a string", text(name)),
         fmt::format("a function is called with parentheses: {}(\"…\")", text(name)));
    return error_expr();
  }
  const BlockId body = block(BlockPlace::thing, fmt::format("'{}'", text(name)));
  return add(first, ThingExpr{name, file, body}, 1 + std::max(height(body), file.valid() ? height(file) : 0));
}

// tuple = "(" expression "," expression [ "," expression ] [ "," ] ")"
ExprId Parser::tuple_or_group() {
  const std::uint32_t first = at_;
  Pending elements(pending_);
  const bool good = comma_list(TokenKind::right_paren, [&] { elements.add(expression()); });
  if (!good) return add(first, ErrorExpr{});
  const bool trailing_comma = tokens_.tokens[at_ - 2].kind == TokenKind::comma;
  if (elements.size() == 1 && !trailing_comma) {
    const ExprId only = elements.all()[0];
    tree_.exprs[only.index].span = span_from(first);
    return only;
  }
  std::uint32_t tallest = 0;
  for (const ExprId e : elements.all()) tallest = std::max(tallest, height(e));
  if (elements.size() == 2 || elements.size() == 3)
    return add(first, TupleExpr{append_exprs(elements.all())}, 1 + tallest);
  note_mistake(span_from(first),
               elements.size() == 0
                   ? "there is no value in these parentheses"
                   : fmt::format("{} value{} in parentheses: a pair has 2, a vec 3", elements.size(),
                                 elements.size() == 1 ? " and a comma" : "s"),
               elements.size() > 3 ? "a list is written in square brackets" : "");
  return add(first, ErrorExpr{});
}

// `<1, 2, 3>`, as other languages write vectors.
ExprId Parser::angle_bracket_vector() {
  const std::uint32_t first = at_;
  take();
  std::vector<ExprId> elements;
  bool good = true;
  do {
    const std::uint32_t begin = at_;
    good = good && (begins_value(kind()) || at(TokenKind::minus));
    if (!good) break;
    elements.push_back(unary());
    while (!panic_ && at_ > begin &&
           (at(TokenKind::plus) || at(TokenKind::minus) || at(TokenKind::star) || at(TokenKind::slash))) {
      take();
      unary();
    }
  } while (!panic_ && take_if(TokenKind::comma));
  if (panic_) return error_expr();
  if (!good || elements.size() < 2 || !at(TokenKind::greater)) {
    fail(tokens_.tokens[first].span, "expected a value, found '<'", "a vec is written (x, y, z)");
    return error_expr();
  }
  take();
  note_mistake(span_from(first), "a vec is written in parentheses", "write (x, y, z)");
  return add(first, ErrorExpr{});
}

// list = "[" [ expression { "," expression } [ "," ] ] "]" | "[" expression each { each } "]"
ExprId Parser::list() {
  const std::uint32_t first = at_;
  Pending elements(pending_);
  ExprId comprehension;
  const int errors = diagnostics_.error_count();
  std::uint32_t tallest = 0;
  const bool good = comma_list(TokenKind::right_bracket, [&] {
    if (elements.size() == max_list_length) {
      note_mistake(peek().span, fmt::format("a list of more than {} entries", max_list_length),
                   "a large mesh comes from a glTF file, many alike things from a loop");
      while (!ends_everything() && !at(TokenKind::right_bracket)) skip_group();
      return;
    }
    const ExprId element = expression();
    elements.add(element);
    tallest = std::max(tallest, height(element));
    if (at(TokenKind::kw_for) && elements.size() == 1) comprehension = each(element, first);
  });
  if (!good) return add(first, ErrorExpr{});
  if (comprehension.valid()) {
    if (elements.size() == 1) return comprehension;
    if (diagnostics_.error_count() == errors)
      note_mistake(span_from(first), "a list has either one 'for' or entries one by one",
                   "join two lists: [a, b] + [i * i for i in 0..<10]");
    return add(first, ErrorExpr{});
  }
  return add(first, ListExpr{append_exprs(elements.all())}, 1 + tallest);
}

// arguments = argument { "," argument } [ "," ];  argument = [ word ":" ] expression
ExprId Parser::call(ExprId callee, std::uint32_t first_token) {
  std::vector<Argument> arguments;
  std::uint32_t tallest = height(callee);
  bool in_order = true;
  const bool good = comma_list(TokenKind::right_paren, [&] {
    Name name;
    const std::uint32_t begin = at_;
    if (is_word(kind()) && (kind(1) == TokenKind::colon || kind(1) == TokenKind::equals)) {
      name = take_name();
      if (at(TokenKind::equals))
        note_mistake(peek().span, "an argument is given with ':'",
                     fmt::format("write {}: value; '=' defines or sets a name", text(name)));
      take();
    }
    const ExprId given = expression();
    tallest = std::max(tallest, height(given));
    if (!name.symbol.valid() && !arguments.empty() && arguments.back().name.symbol.valid()) {
      note_mistake(span_from(begin), "a positional argument after a named one",
                   "positional arguments come first");
      in_order = false;
    }
    arguments.push_back({name, given});
  });
  if (!good || !in_order) return add(first_token, ErrorExpr{});
  return add(first_token, CallExpr{callee, append(tree_.arguments, arguments)}, 1 + tallest);
}

ExprId Parser::index(ExprId object, std::uint32_t first_token) {
  const std::uint32_t open = at_;
  std::vector<ExprId> elements;
  const bool good = comma_list(TokenKind::right_bracket, [&] { elements.push_back(expression()); });
  if (!good) return add(first_token, ErrorExpr{});
  if (elements.size() != 1) {
    note_mistake(span_from(open), fmt::format("an index is one value, here are {}", elements.size()),
                 "if a list is meant, a ',' is missing before '['");
    return add(first_token, ErrorExpr{});
  }
  return add(first_token, IndexExpr{object, elements[0]}, 1 + std::max(height(object), height(elements[0])));
}

ExprId Parser::member(ExprId object, std::uint32_t first_token) {
  take();
  if (!at(TokenKind::name)) {
    fail(peek().span, fmt::format("expected a name after '.', found {}", found()), "as in p.x or c.bgr");
    return error_expr();
  }
  const Name name = take_name();
  return add(first_token, MemberExpr{object, name.symbol, name.span}, 1 + height(object));
}

}  // namespace tyndall::syntax
