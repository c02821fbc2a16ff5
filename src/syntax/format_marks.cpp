// Marks of tokens: items, pairs of brackets, branches, and commas that may go.
#include "syntax/format_marks.h"

#include <algorithm>
#include <string_view>

#include "base/check.h"

namespace tyndall::syntax {

namespace {

class Marker {
 public:
  Marker(std::string_view text, const TokenList& list, const SyntaxTree& tree)
      : text_(text), tokens_(list.tokens), tree_(tree), marks_(tokens_.size()) {}

  std::vector<TokenMark> run() {
    match_brackets();
    for (const Item& item : tree_.items) mark_item(item);
    for (const Item& item : tree_.items)
      if (const auto* branch = std::get_if<IfItem>(&item.node)) mark_else(*branch);
    for (const Item& item : tree_.items)
      if (const auto* branch = std::get_if<IfItem>(&item.node)) mark_branches(item, *branch);
    for (const Expr& expr : tree_.exprs)
      if (const auto* range = std::get_if<RangeExpr>(&expr.node)) mark_range(*range);
    for (std::uint32_t i = 0; i < tokens_.size(); ++i)
      if (kind(i) == TokenKind::comma) mark_comma(i);
    return std::move(marks_);
  }

 private:
  TokenKind kind(std::uint32_t i) const {
    return i < tokens_.size() ? tokens_[i].kind : TokenKind::end_of_file;
  }
  // The token that begins at an offset, and the last one that ends at or before one.
  std::uint32_t token_at(std::uint32_t begin) const {
    const auto found = std::lower_bound(tokens_.begin(), tokens_.end(), begin,
                                        [](const Token& t, std::uint32_t at) { return t.span.begin < at; });
    CHECK(found != tokens_.end() && found->span.begin == begin);
    return static_cast<std::uint32_t>(found - tokens_.begin());
  }
  std::uint32_t token_before(std::uint32_t end) const {
    // By where they begin: the end of the file is a token that ends where the last one does.
    const auto found = std::lower_bound(tokens_.begin(), tokens_.end(), end,
                                        [](const Token& t, std::uint32_t at) { return t.span.begin < at; });
    return static_cast<std::uint32_t>(found - tokens_.begin()) - 1;
  }

  void match_brackets() {
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < tokens_.size(); ++i) {
      const TokenKind k = kind(i);
      if (k == TokenKind::left_paren || k == TokenKind::left_bracket || k == TokenKind::left_brace ||
          k == TokenKind::string_head) {
        open.push_back(i);
      } else if (k == TokenKind::right_paren || k == TokenKind::right_bracket ||
                 k == TokenKind::right_brace || k == TokenKind::string_tail) {
        CHECK(!open.empty());
        marks_[open.back()].match = i;
        marks_[i].match = open.back();
        open.pop_back();
      }
    }
    CHECK(open.empty());
  }

  void mark_item(const Item& item) {
    const std::uint32_t first = token_at(item.span.begin);
    marks_[first].item_end = token_before(item.span.end);
    const auto equals_after = [&](const Name& name) {
      std::uint32_t next = token_at(name.span.begin) + 1;
      if (kind(next) == TokenKind::left_bracket) next = marks_[next].match + 1;  // l[i] = x
      if (kind(next) == TokenKind::equals) marks_[next].defines = true;
    };
    if (std::holds_alternative<ParameterItem>(item.node)) {
      marks_[first].parameter = true;
      marks_[first + 1].names_value = true;
    } else if (const auto* let = std::get_if<LetItem>(&item.node)) {
      equals_after(let->name);
    } else if (const auto* var = std::get_if<VarItem>(&item.node)) {
      equals_after(var->name);
    } else if (const auto* assign = std::get_if<AssignItem>(&item.node)) {
      equals_after(assign->name);
    } else if (const auto* function = std::get_if<FunctionItem>(&item.node)) {
      std::uint32_t last = token_at(function->name.span.begin) + 1;
      if (kind(last) == TokenKind::left_paren) last = marks_[last].match + 1;
      if (kind(last) == TokenKind::equals) marks_[last].defines = true;
    } else if (const auto* thing = std::get_if<ThingItem>(&item.node)) {
      marks_[token_at(tree_[thing->block].span.begin)].opens_statement = true;
    }
  }

  // `else if` goes on with the statement: no item begins there.
  void mark_else(const IfItem& branch) {
    if (!branch.else_block.valid()) return;
    const std::uint32_t other = token_at(tree_[branch.else_block].span.begin);
    marks_[other - 1].else_statement = true;
    if (kind(other) == TokenKind::kw_if) marks_[other].item_end = no_token;
  }

  void mark_branches(const Item& item, const IfItem& branch) {
    if (marks_[token_at(item.span.begin)].item_end == no_token) return;
    const std::uint32_t first = token_at(tree_[branch.then_block].span.begin);
    marks_[first].last_brace = token_before(item.span.end);
    const IfItem* inner = &branch;
    while (inner != nullptr) {
      marks_[token_at(tree_[inner->then_block].span.begin)].first_brace = first;
      if (!inner->else_block.valid()) return;
      const Block& other = tree_[inner->else_block];
      const std::uint32_t begin = token_at(other.span.begin);
      if (kind(begin) == TokenKind::left_brace) marks_[begin].first_brace = first;
      inner = kind(begin) == TokenKind::left_brace
                  ? nullptr
                  : std::get_if<IfItem>(&tree_[tree_.list_of_items(other.items)[0]].node);
    }
  }

  // Whether an operand is a sum or the like, outside of parentheses.
  bool compound(ExprId id) const {
    if (!id.valid()) return false;
    const Expr& expr = tree_[id];
    if (!std::holds_alternative<BinaryExpr>(expr.node)) return false;
    const std::uint32_t first = token_at(expr.span.begin);
    return kind(first) != TokenKind::left_paren || marks_[first].match != token_before(expr.span.end);
  }
  void mark_range(const RangeExpr& range) {
    if (!compound(range.first) && !compound(range.last) && !compound(range.step)) return;
    marks_[token_before(tree_[range.first].span.end) + 1].loose_range = true;
    if (range.step.valid()) marks_[token_before(tree_[range.last].span.end) + 1].loose_range = true;
  }

  // A comma before the next parameter of a block, and one before a bracket that closes on the same line.
  void mark_comma(std::uint32_t i) {
    const TokenKind next = kind(i + 1);
    const bool closes_list = next == TokenKind::right_paren || next == TokenKind::right_bracket;
    const bool ends_item = next == TokenKind::right_brace || marks_[i + 1].item_end != no_token;
    const bool would_go_on = next == TokenKind::kw_and || next == TokenKind::kw_or ||
                             next == TokenKind::kw_then || next == TokenKind::kw_else;
    const std::uint32_t end = tokens_[i].span.end, next_begin = tokens_[i + 1].span.begin;
    const std::string_view between = text_.substr(end, next_begin - end);
    const bool alone = between.find_first_not_of(" \t") == std::string_view::npos;
    marks_[i].dropped = (ends_item && !would_go_on) || (closes_list && alone);
  }

  std::string_view text_;
  const std::vector<Token>& tokens_;
  const SyntaxTree& tree_;
  std::vector<TokenMark> marks_;
};

}  // namespace

std::vector<TokenMark> mark_tokens(std::string_view text, const TokenList& tokens, const SyntaxTree& tree) {
  return Marker(text, tokens, tree).run();
}

}  // namespace tyndall::syntax
