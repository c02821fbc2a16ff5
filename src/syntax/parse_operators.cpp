// Operators: the precedence table, and the productions that climb it.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "syntax/foreign_words.h"
#include "syntax/recursive_parser.h"

namespace tyndall::syntax {

namespace {

// Binding levels, loosest first (docs: language, "Values"). `if` is looser than all of them.
enum Level : int {
  or_level,
  and_level,
  not_level,
  comparison_level,
  range_level,
  sum_level,
  product_level,
  unary_level
};

struct OperatorRow {
  TokenKind token;
  Level level;
  BinaryOp op;
};
// Ranges have a node of their own; unary operators and `^`, which bind to the right, have their own
// productions.
constexpr OperatorRow operator_table[] = {
    {TokenKind::kw_or, or_level, BinaryOp::logical_or},
    {TokenKind::kw_and, and_level, BinaryOp::logical_and},
    {TokenKind::less, comparison_level, BinaryOp::less},
    {TokenKind::less_equal, comparison_level, BinaryOp::less_equal},
    {TokenKind::greater, comparison_level, BinaryOp::greater},
    {TokenKind::greater_equal, comparison_level, BinaryOp::greater_equal},
    {TokenKind::equal_equal, comparison_level, BinaryOp::equal},
    {TokenKind::not_equal, comparison_level, BinaryOp::not_equal},
    {TokenKind::plus, sum_level, BinaryOp::add},
    {TokenKind::minus, sum_level, BinaryOp::subtract},
    {TokenKind::star, product_level, BinaryOp::multiply},
    {TokenKind::slash, product_level, BinaryOp::divide},
};

// Where each kind of token stands in the table, from 1; 0 for what is no operator.
constexpr auto operator_places = [] {
  std::array<std::uint8_t, static_cast<std::size_t>(TokenKind::dot_dot_less) + 1> places{};
  for (std::size_t i = 0; i < std::size(operator_table); ++i)
    places[static_cast<std::size_t>(operator_table[i].token)] = static_cast<std::uint8_t>(i + 1);
  return places;
}();

const OperatorRow* find_operator(TokenKind kind) {
  const std::uint8_t place = operator_places[static_cast<std::size_t>(kind)];
  return place == 0 ? nullptr : &operator_table[place - 1];
}

// Marks that continue no value.
bool ends_value(TokenKind kind) {
  return kind == TokenKind::comma || kind == TokenKind::right_paren || kind == TokenKind::right_bracket ||
         kind == TokenKind::right_brace;
}

}  // namespace

// expression = conditional | disjunction
ExprId Parser::expression() {
  if (panic_) return error_expr();
  if (!enter()) return leave(), error_expr();
  // A number that nothing continues, as in long lists, is all that operators() would find.
  const bool only_number = at(TokenKind::number) && ends_value(kind(1));
  ExprId result = only_number ? literal() : at(TokenKind::kw_if) ? conditional() : operators(or_level);
  if (at(TokenKind::error) && !panic_ && !first_on_line(at_)) result = value_before_error();
  leave();
  return result;
}

// conditional = "if" header_value "then" expression "else" expression
ExprId Parser::conditional() {
  const std::uint32_t first = at_;
  const Span keyword = take().span;
  const ExprId condition = header_value();
  if (!panic_ && !at(TokenKind::kw_then)) {
    fail(peek().span, fmt::format("expected 'then', found {}", found()),
         "a choice of values is written: if a then b else c", {{keyword, "the 'if' is here"}});
  }
  if (panic_) return error_expr();
  take();
  const ExprId then_value = expression();
  if (!panic_ && !at(TokenKind::kw_else))
    fail(peek().span, fmt::format("expected 'else', found {}", found()),
         "a choice of values is written: if a then b else c", {{keyword, "the 'if' is here"}});
  if (panic_) return error_expr();
  take();
  const ExprId else_value = expression();
  return add(first, ConditionalExpr{condition, then_value, else_value},
             1 + std::max({height(condition), height(then_value), height(else_value)}));
}

// disjunction = conjunction { "or" conjunction };  conjunction = negation { "and" negation };
// sum = product { ( "+" | "-" ) product };  product = unary { ( "*" | "/" ) unary }
// Reads the operators of the level `loosest` and of all that bind tighter.
ExprId Parser::operators(int loosest) {
  const std::uint32_t first = at_;
  ExprId left = prefix(loosest);
  while (!panic_) {
    const bool is_range = at(TokenKind::dot_dot) || at(TokenKind::dot_dot_less);
    const OperatorRow* row = find_operator(kind());
    if (row == nullptr && !is_range) {
      if (at(TokenKind::name) && word_for_operator(left)) continue;
      break;
    }
    const int level = is_range ? range_level : row->level;
    if (level < loosest) break;
    if (level == range_level || level == comparison_level) {
      left = comparison_or_range(left, first, level);
      continue;
    }
    take();
    const ExprId right = operators(level + 1);
    left = add(first, BinaryExpr{row->op, left, right}, 1 + std::max(height(left), height(right)));
  }
  return left;
}

// `5 mod 3`, `0 to 10`: passes over a word that other languages have for an operator, and its right side.
bool Parser::word_for_operator(ExprId& left) {
  const TokenKind next = kind(1);
  const bool value_follows = next == TokenKind::number || next == TokenKind::color ||
                             (next == TokenKind::name && kind(2) != TokenKind::left_brace &&
                              kind(2) != TokenKind::string && kind(2) != TokenKind::colon);
  if (!value_follows || first_on_line(at_)) return false;
  const std::string_view word = text(peek());
  const std::string_view help = help_for_foreign_word(ForeignUse::between, word);
  if (help.empty()) return false;
  note_mistake(peek().span, fmt::format("'{}' is not an operator", word), std::string(help));
  take();
  operators(sum_level);
  left = error_expr();
  return true;
}

// The first operand of a level: negation = "not" negation | comparison; looser operators need parentheses
// here.
ExprId Parser::prefix(int loosest) {
  if (at(TokenKind::kw_if)) {
    note_mistake(peek().span, "'if' inside an operation needs parentheses", "write a + (if b then c else d)");
    return expression();
  }
  if (!at(TokenKind::kw_not)) return unary();
  if (loosest > not_level)
    note_mistake(peek().span, "'not' inside an operation needs parentheses", "write a == (not b)");
  if (!enter()) return leave(), error_expr();
  const std::uint32_t first = at_;
  take();
  const ExprId operand = operators(not_level);
  leave();
  if (loosest > not_level) return error_expr();
  return add(first, UnaryExpr{UnaryOp::logical_not, operand}, 1 + height(operand));
}

// comparison = range [ comparator range ];  comparator = "<" | "<=" | ">" | ">=" | "==" | "!="
// range = sum [ ( ".." | "..<" ) sum [ ".." sum ] ]
ExprId Parser::comparison_or_range(ExprId left, std::uint32_t first_token, int level) {
  const Token& token = take();
  const ExprId right = operators(level + 1);
  if (level == comparison_level) {
    if (const OperatorRow* next = find_operator(kind()); next != nullptr && next->level == comparison_level) {
      note_mistake(peek().span, "comparisons cannot be chained", "write a < b and b < c");
      return error_expr();
    }
    return add(first_token, BinaryExpr{find_operator(token.kind)->op, left, right},
               1 + std::max(height(left), height(right)));
  }
  ExprId step;
  std::uint32_t tallest = std::max(height(left), height(right));
  if (!panic_ && (at(TokenKind::dot_dot) || at(TokenKind::dot_dot_less))) {
    if (at(TokenKind::dot_dot_less))
      note_mistake(peek().span, "the step of a range follows '..'", "write a..<b..step");
    take();
    step = operators(level + 1);
    tallest = std::max(tallest, height(step));
    if (at(TokenKind::dot_dot) || at(TokenKind::dot_dot_less)) {
      note_mistake(peek().span, "a range has at most three parts", "write first..last..step");
      return error_expr();
    }
  }
  return add(first_token, RangeExpr{left, right, step, token.kind == TokenKind::dot_dot_less}, 1 + tallest);
}

// unary = "-" unary | power
ExprId Parser::unary() {
  if (panic_) return error_expr();
  if (!at(TokenKind::minus)) return power();
  const std::uint32_t first = at_;
  if (!enter()) return leave(), error_expr();
  take();
  const ExprId operand = unary();
  leave();
  return add(first, UnaryExpr{UnaryOp::negate, operand}, 1 + height(operand));
}

// power = postfix [ "^" unary ]
ExprId Parser::power() {
  const std::uint32_t first = at_;
  const ExprId base = postfix();
  if (panic_ || !at(TokenKind::caret)) return base;
  if (!enter()) return leave(), error_expr();
  take();
  const ExprId exponent = unary();
  leave();
  return add(first, BinaryExpr{BinaryOp::power, base, exponent},
             1 + std::max(height(base), height(exponent)));
}

}  // namespace tyndall::syntax
