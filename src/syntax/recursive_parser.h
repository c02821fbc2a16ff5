// The parser's state and productions. Functions carry the production names of grammar/tyndall.ebnf; they are
// split by job over parse_items.cpp, parse_blocks.cpp, parse_operators.cpp, parse_values.cpp, parse_lists.cpp
// and recover.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "syntax/parser.h"

namespace tyndall::syntax {

// Levels to which expressions, blocks and operator chains may nest: what walks the tree by recursion is safe.
inline constexpr std::uint32_t max_nesting = 256;

// Entries of a list.
inline constexpr std::uint32_t max_list_length = 1'000'000;

// Where a block stands: settles what `name: value` means in it.
enum class BlockPlace : std::uint8_t {
  file,   // the file, a template, an object: statements
  thing,  // the parameters of a thing, and statements of groups
  body,   // a medium or material: outputs are set with `=`
  steps,  // a function: variables are set with `=`
};

class Parser {
 public:
  Parser(const Sources& sources, SourceId source, const TokenList& tokens, Symbols& symbols,
         Diagnostics& diagnostics);

  SyntaxTree file();
  ParsedExpression only_expression();

 private:
  using ItemNode = decltype(Item::node);
  using ExprNode = decltype(Expr::node);

  // parse_blocks.cpp
  BlockId block(BlockPlace place, std::string_view owner);
  void items(std::vector<ItemId>& out, const std::optional<Span>& open);
  BlockId add_block(std::uint32_t first_token, const std::vector<ItemId>& list, std::uint32_t outer_tallest);
  bool open_block(std::string_view owner);
  void read_item(std::vector<ItemId>& out);
  void never_closed(const Span& open);
  void note_unread_definition(std::uint32_t first_token);
  std::size_t indentation(const Span& place) const;

  // parse_items.cpp
  std::optional<ItemId> item();
  std::optional<ItemNode> item_node();
  std::optional<ItemNode> let_item();
  std::optional<ItemNode> var_item();
  std::optional<ItemNode> def_item();
  std::optional<ItemNode> body_item();
  std::optional<ItemNode> object_item();
  std::optional<ItemNode> place_item();
  std::optional<ItemNode> include_item();
  std::optional<ItemNode> for_item();
  std::optional<ItemNode> if_item();
  std::optional<ItemNode> return_item();
  std::optional<ItemNode> parameter_item();
  std::optional<ItemNode> assign_item();
  std::optional<ItemNode> thing_item();
  std::optional<ItemNode> call_item();
  ListRef parameters();
  void after_item(const std::optional<ItemId>& id);
  std::optional<Name> new_name(std::string_view what);
  ExprId defined_value(const Name& name);
  ExprId header_value();
  std::optional<Name> name_of_rounds(const std::string& help);

  // parse_mistakes.cpp
  std::optional<ItemNode> not_an_item();
  void part_of_a_word(const std::string& owner);
  bool no_value_defined(const Name& name);
  bool value_without_colon() const;
  ItemNode parameter_without_colon(const Name& name);
  bool begins_body() const;
  std::optional<ItemNode> include_without_quotes();
  // parse_habits.cpp: what POV-Ray and Python users write
  bool skip_directive();
  ExprId value_before_error();
  bool word_for_operator(ExprId& left);
  bool values_side_by_side(ItemId item);
  bool second_definition(ItemId item);
  bool is_comment_of_others() const;
  bool ends_line_alone(const Name& keyword) const;
  std::optional<Name> name_without_type(std::optional<Name> name);
  void skip_type();
  // `light point {` on a new line is a statement, however much a value is wanted.
  bool begins_next_statement() const {
    return kind(1) == TokenKind::name && kind(2) == TokenKind::left_brace && first_on_line(at_) &&
           (text(peek()) == "light" || text(peek()) == "camera");
  }
  std::optional<ItemNode> lone_word(const Name& keyword, bool alone);
  bool letter_before_string(const Name& name) const;
  void skip_line();
  bool gives_value(BlockId block) const;
  BlockId indented_block(BlockPlace place, std::string_view owner);
  bool statement_of_others(const Name& keyword);
  bool begins_thing() const;
  Unit parted_unit(const Token& number, double& value);
  bool vector_word(const Name& name) const;
  PlaceItem placed_without_braces(const Name& name, ListRef arguments);
  struct ForeignStatement {
    Span place;
    std::string_view word, help;
  };
  std::optional<ForeignStatement> foreign_statement_around() const;

  // parse_operators.cpp
  ExprId expression();
  ExprId conditional();
  ExprId operators(int loosest);
  ExprId prefix(int loosest);
  ExprId comparison_or_range(ExprId left, std::uint32_t first_token, int level);
  ExprId unary();
  ExprId power();

  // parse_values.cpp
  ExprId postfix();
  ExprId value();
  ExprId not_a_value();
  ExprId unnamed_body();
  ExprId literal();
  ExprId string_value();
  ExprId name_or_thing();
  ExprId tuple_or_group();
  ExprId angle_bracket_vector();
  ExprId list();
  ExprId each(ExprId element, std::uint32_t first_token);
  bool sets_entry() const;
  std::optional<ItemNode> assign_entry();
  NumberFormat number_format();
  ExprId call(ExprId callee, std::uint32_t first_token);
  ExprId index(ExprId object, std::uint32_t first_token);
  ExprId member(ExprId object, std::uint32_t first_token);
  bool callable(ExprId e) const;

  // parse_lists.cpp
  // Reads `open element, element, close` by calling `element` at each; false if something in it was reported.
  template <class Element>
  bool comma_list(TokenKind close, Element&& element);
  enum class AfterElement : std::uint8_t { next, done, broken };
  AfterElement after_element(TokenKind close, const Span& open);
  bool recover_in_list(TokenKind close);
  bool closes_ahead(TokenKind close) const;

  // recover.cpp
  void synchronize(std::uint32_t first_token);
  static std::optional<TokenKind> closer_of(TokenKind k);
  void skip_group();
  bool begins_item(std::uint32_t token) const;
  bool begins_value(TokenKind kind) const;
  bool first_on_line(std::uint32_t token) const;
  bool ends_everything() const;
  std::string found() const;
  void fail(const Span& span, std::string message, std::string help = {},
            std::vector<Diagnostic::Note> notes = {});
  void note_mistake(const Span& span, std::string message, std::string help = {},
                    std::vector<Diagnostic::Note> notes = {});
  void give_up();
  void too_deep(const Span& span);
  bool enter();
  void leave() { --depth_; }

  // Tokens.
  const Token& peek(std::uint32_t ahead = 0) const {
    const std::size_t i = std::size_t{at_} + ahead;
    return i < tokens_.tokens.size() ? tokens_.tokens[i] : tokens_.tokens.back();
  }
  TokenKind kind(std::uint32_t ahead = 0) const { return peek(ahead).kind; }
  bool at(TokenKind k) const { return kind() == k; }
  const Token& take() {
    const Token& token = peek();
    if (std::size_t{at_} + 1 < tokens_.tokens.size()) ++at_;
    return token;
  }
  bool take_if(TokenKind k) {
    if (!at(k)) return false;
    take();
    return true;
  }
  bool expect(TokenKind k, std::string_view after);
  std::string_view text(const Token& token) const {
    return source_text_.substr(token.span.begin, token.span.end - token.span.begin);
  }
  // From the beginning of a token to the end of the last one taken.
  Span span_from(std::uint32_t first_token) const {
    const Span& first = tokens_.tokens[first_token].span;
    return at_ > first_token ? join(first, tokens_.tokens[at_ - 1].span) : first;
  }
  Name take_name() {
    const Token& token = take();
    return {symbols_.intern(text(token)), token.span};
  }
  std::string_view text(const Name& name) const { return symbols_.text(name.symbol); }

  // Nodes. `height` is that of the subtree.
  ExprId add(std::uint32_t first_token, ExprNode node, std::uint32_t height = 1);
  ExprId error_expr() { return add(at_, ErrorExpr{}); }
  std::uint32_t height(ExprId e) const { return expr_heights_[e.index]; }
  std::uint32_t height(BlockId b) const { return block_heights_[b.index]; }
  // The expressions of a list while it is read: they lie on one stack, so that short lists take no memory.
  class Pending {
   public:
    explicit Pending(std::vector<ExprId>& stack) : stack_(stack), first_(stack.size()) {}
    ~Pending() { stack_.resize(first_); }
    Pending(const Pending&) = delete;
    Pending& operator=(const Pending&) = delete;
    void add(ExprId e) { stack_.push_back(e); }
    std::size_t size() const { return stack_.size() - first_; }
    std::span<const ExprId> all() const { return std::span(stack_).subspan(first_); }

   private:
    std::vector<ExprId>& stack_;
    std::size_t first_;
  };
  ListRef append_exprs(std::span<const ExprId> list) {
    const ListRef ref{static_cast<std::uint32_t>(tree_.expr_list.size()),
                      static_cast<std::uint32_t>(list.size())};
    tree_.expr_list.insert(tree_.expr_list.end(), list.begin(), list.end());
    return ref;
  }
  template <class T>
  static ListRef append(std::vector<T>& all, const std::vector<T>& list) {
    const ListRef ref{static_cast<std::uint32_t>(all.size()), static_cast<std::uint32_t>(list.size())};
    all.insert(all.end(), list.begin(), list.end());
    return ref;
  }

  std::string_view source_text_;
  const TokenList& tokens_;
  Symbols& symbols_;
  Diagnostics& diagnostics_;
  SyntaxTree tree_;
  std::uint32_t at_ = 0;
  // The '{' of `sphere: { radius: 2 }`: only media and materials are braces alone, so that parameters are
  // meant.
  std::uint32_t braces_of_no_body_ = 0xffffffffu;
  // Set by the first error of an item, cleared where reading goes on: what follows an error is not reported.
  bool panic_ = false;
  bool gave_up_ = false;           // nested too deeply, or too many errors: the rest of the file is not read
  bool brace_opens_body_ = false;  // in the header of `if` and `for`
  BlockPlace place_ = BlockPlace::file;
  Span doubtful_brace_;  // the first `{` whose `}` stands further left than its line
  std::uint32_t depth_ = 0;
  std::uint32_t tallest_ = 0;  // height of the tallest subtree met in the innermost block so far
  std::vector<std::uint32_t> expr_heights_, block_heights_;
  std::vector<ExprId> pending_;  // see Pending
};

template <class Element>
bool Parser::comma_list(TokenKind close, Element&& element) {
  const Span open = take().span;
  const bool in_header = std::exchange(brace_opens_body_, false);
  bool good = true;
  for (AfterElement state = AfterElement::next; state == AfterElement::next;) {
    if (take_if(close)) break;
    element();
    good = good && !panic_;
    state = panic_ ? (recover_in_list(close) ? AfterElement::next : AfterElement::broken)
                   : after_element(close, open);
    good = good && state != AfterElement::broken;
  }
  brace_opens_body_ = in_header;
  return good;
}

}  // namespace tyndall::syntax
