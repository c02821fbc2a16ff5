// Items: definitions, settings, statements. Each begins with a word.
#include <fmt/format.h>

#include <algorithm>

#include "syntax/recursive_parser.h"

namespace tyndall::syntax {

// item: any of those below
std::optional<ItemId> Parser::item() {
  const std::uint32_t first = at_;
  std::optional<ItemNode> node = item_node();
  if (!node) return std::nullopt;
  tree_.items.push_back({span_from(first), std::move(*node)});
  return ItemId(tree_.items.size() - 1);
}

std::optional<Parser::ItemNode> Parser::item_node() {
  struct Rule {
    TokenKind keyword;
    std::optional<ItemNode> (Parser::*read)();
  };
  static constexpr Rule rules[] = {
      {TokenKind::kw_let, &Parser::let_item},       {TokenKind::kw_var, &Parser::var_item},
      {TokenKind::kw_def, &Parser::def_item},       {TokenKind::kw_medium, &Parser::body_item},
      {TokenKind::kw_material, &Parser::body_item}, {TokenKind::kw_object, &Parser::object_item},
      {TokenKind::kw_place, &Parser::place_item},   {TokenKind::kw_include, &Parser::include_item},
      {TokenKind::kw_for, &Parser::for_item},       {TokenKind::kw_if, &Parser::if_item},
      {TokenKind::kw_return, &Parser::return_item},
  };
  if (!is_word(kind())) return not_an_item();
  if (kind(1) == TokenKind::colon) return parameter_item();
  for (const Rule& rule : rules)
    if (at(rule.keyword) && kind(1) != TokenKind::equals) return (this->*rule.read)();
  if (kind(1) == TokenKind::equals) return assign_item();
  if (sets_entry()) return assign_entry();
  if (!at(TokenKind::name)) return not_an_item();
  if (kind(1) == TokenKind::left_paren) return call_item();
  return thing_item();
}

// A comma may follow `name: value`, and nothing else.
void Parser::after_item(const std::optional<ItemId>& id) {
  if (!id || !(at(TokenKind::comma) || at(TokenKind::number))) return;
  if (values_side_by_side(*id) || second_definition(*id) || !at(TokenKind::comma)) return;
  const Span comma = take().span;
  if (!std::holds_alternative<ParameterItem>(tree_[*id].node))
    note_mistake(comma, "no ',' is needed here", "commas may part 'name: value' pairs only");
}

// The name that a definition gives; a reserved word is reported and taken.
std::optional<Name> Parser::new_name(std::string_view what) {
  if (at(TokenKind::name)) return take_name();
  if (is_reserved(kind()) && !first_on_line(at_)) {
    note_mistake(peek().span, fmt::format("'{}' is a reserved word and cannot be a name", spelling(kind())));
    return take_name();
  }
  fail(peek().span, fmt::format("expected the name of {}, found {}", what, found()));
  return std::nullopt;
}

// "=" expression, after the name that it defines.
ExprId Parser::defined_value(const Name& name) {
  if (at(TokenKind::equals)) {
    take();
    return expression();
  }
  skip_type();
  if (at(TokenKind::colon)) {
    note_mistake(take().span, "a name is defined with '='",
                 fmt::format("write {} = value; ':' gives a value to a parameter", text(name)));
  } else if (at(TokenKind::equal_equal)) {
    note_mistake(take().span, "a name is defined with one '='");
  } else if (no_value_defined(name)) {
    return error_expr();
  } else if (!expect(TokenKind::equals, fmt::format("'{}'", text(name)))) {
    return error_expr();
  }
  return expression();
}

// let = "let" name "=" expression
std::optional<Parser::ItemNode> Parser::let_item() {
  take();
  const std::optional<Name> name = name_without_type(new_name("what 'let' defines"));
  if (!name) return std::nullopt;
  if (at(TokenKind::left_paren)) {
    fail(peek().span, "'let' names a value, not a function", fmt::format("write def {}(…) = …", text(*name)));
    return std::nullopt;
  }
  return LetItem{*name, defined_value(*name)};
}

// var = "var" name "=" expression
std::optional<Parser::ItemNode> Parser::var_item() {
  take();
  const std::optional<Name> name = name_without_type(new_name("a variable"));
  if (!name) return std::nullopt;
  return VarItem{*name, defined_value(*name)};
}

// def = "def" name parameters ( "=" expression | "=" block | block )
std::optional<Parser::ItemNode> Parser::def_item() {
  take();
  const std::optional<Name> name = new_name("a function");
  if (!name) return std::nullopt;
  ListRef list;
  if (at(TokenKind::left_paren)) {
    list = parameters();
  } else {
    fail(peek().span, fmt::format("expected '(' after '{}', found {}", text(*name), found()),
         "a function is written def f(x) = …, a value let a = …");
  }
  const bool result_type = at(TokenKind::error) && text(peek()) == "->" && kind(1) == TokenKind::name;
  if (result_type && kind(2) != TokenKind::name && !first_on_line(at_ + 2)) at_ += 2;
  const bool python = at(TokenKind::colon) && (kind(1) == TokenKind::kw_return || first_on_line(at_ + 1));
  if (at(TokenKind::left_brace) || python || panic_) {
    const BlockId body = block(BlockPlace::file, fmt::format("'{}'", text(*name)));
    if (!gives_value(body)) return TemplateItem{*name, list, body};
    // Without '=' it is a template by the grammar; a value beside the steps tells whoever defines it.
    const ExprId mistaken = python ? ExprId{} : add(at_, BoolExpr{false});
    return FunctionItem{*name, list, mistaken, body};
  }
  if (at(TokenKind::colon)) {
    note_mistake(take().span, "a function is defined with '='");
  } else if (at(TokenKind::kw_return)) {
    note_mistake(take().span, "expected '=' or '{' after the parameters, found 'return'",
                 fmt::format("write def {}(…) = value", text(*name)));
  } else if (!take_if(TokenKind::equals)) {
    fail(peek().span, fmt::format("expected '=' or '{{' after the parameters, found {}", found()),
         "a function is written def f(x) = …, a template def f(x) { … }");
    return std::nullopt;
  }
  if (at(TokenKind::left_brace))
    return FunctionItem{*name, list, {}, block(BlockPlace::steps, fmt::format("'{}'", text(*name)))};
  return FunctionItem{*name, list, expression(), {}};
}

// parameters = "(" [ parameter_declaration { "," parameter_declaration } [ "," ] ] ")"
// parameter_declaration = name [ "=" expression ]
ListRef Parser::parameters() {
  std::vector<Parameter> list;
  comma_list(TokenKind::right_paren, [&] {
    std::optional<Name> name = new_name("a parameter");
    if (!name) return;
    if (at(TokenKind::name) && !first_on_line(at_)) {
      note_mistake(name->span, "parameters have no types", fmt::format("leave '{}' out", text(*name)));
      name = take_name();
    }
    skip_type();
    ExprId default_value;
    if (at(TokenKind::colon))
      note_mistake(peek().span, "a default is given with '='", fmt::format("write {} = value", text(*name)));
    if (take_if(TokenKind::equals) || take_if(TokenKind::colon)) default_value = expression();
    list.push_back({*name, default_value});
  });
  return append(tree_.parameters, list);
}

// body = ( "medium" | "material" ) name [ parameters ] block
std::optional<Parser::ItemNode> Parser::body_item() {
  if (place_ == BlockPlace::thing && !begins_body()) return parameter_without_colon(take_name());
  const bool is_medium = at(TokenKind::kw_medium);
  const BodyKind body_kind = is_medium ? BodyKind::medium : BodyKind::material;
  const std::string_view noun = is_medium ? "medium" : "material";
  take();
  if (at(TokenKind::left_brace))
    note_mistake(peek().span, fmt::format("a {} that is defined needs a name", noun),
                 fmt::format("write {0} name() {{ … }}; as a parameter, {0}: {{ … }}", noun));
  std::optional<Name> name;
  if (at(TokenKind::left_brace))
    name = Name{symbols_.intern(""), peek().span};
  else
    name = new_name(fmt::format("a {}", noun));
  if (!name) return std::nullopt;
  ListRef list;
  if (at(TokenKind::left_paren)) list = parameters();
  if (at(TokenKind::equals))
    note_mistake(take().span, "no '=' before the body",
                 fmt::format("write {} {}() {{ … }}", noun, text(*name)));
  return BodyItem{body_kind, *name, list, block(BlockPlace::body, fmt::format("'{}'", text(*name)))};
}

// object = "object" name [ parameters ] block
std::optional<Parser::ItemNode> Parser::object_item() {
  take();
  const std::optional<Name> name = new_name("an object");
  if (!name) return std::nullopt;
  const ListRef list = at(TokenKind::left_paren) ? parameters() : ListRef{};
  if (at(TokenKind::equals)) {
    note_mistake(take().span, "no '=' before what an object is made of",
                 fmt::format("write object {} {{ sphere {{ … }} }}", text(*name)));
    expression();
    return std::nullopt;
  }
  return ObjectItem{*name, list, block(BlockPlace::file, fmt::format("'{}'", text(*name)))};
}

// place = "place" name [ "(" [ arguments ] ")" ] block
std::optional<Parser::ItemNode> Parser::place_item() {
  take();
  const std::optional<Name> name = new_name("the object to place");
  if (!name) return std::nullopt;
  ListRef arguments;
  if (at(TokenKind::left_paren)) {
    const ExprId called = call(add(at_ - 1, NameExpr{name->symbol}), at_ - 1);
    if (const auto* good = std::get_if<CallExpr>(&tree_[called].node)) arguments = good->arguments;
  }
  if (!at(TokenKind::left_brace) && !(is_word(kind()) && kind(1) == TokenKind::colon))
    return placed_without_braces(*name, arguments);
  return PlaceItem{*name, arguments, block(BlockPlace::thing, fmt::format("'place {}'", text(*name)))};
}

// include = "include" expression
std::optional<Parser::ItemNode> Parser::include_item() {
  take();
  if (const std::optional<ItemNode> unquoted = include_without_quotes()) return unquoted;
  return IncludeItem{expression()};
}

// header_value = expression, where `{` outside of brackets belongs to no value: in a header it opens the
// body.
ExprId Parser::header_value() {
  const bool outer = std::exchange(brace_opens_body_, true);
  ExprId result = expression();
  const bool comparison = at(TokenKind::equals);
  const bool range = at(TokenKind::colon) && kind(1) == TokenKind::number && !first_on_line(at_ + 1);
  if (!panic_ && (comparison || range)) {
    note_mistake(take().span, comparison ? "a comparison is written '=='" : "a range is written '..'",
                 comparison ? "write a == b" : "write 0..10, or 0..<10 without its end");
    expression();
    result = error_expr();
  }
  brace_opens_body_ = outer;
  return result;
}

// The name in "for" name "in", of a loop or a list; `help` shows how that is written.
std::optional<Name> Parser::name_of_rounds(const std::string& help) {
  take();
  if (at(TokenKind::left_paren)) fail(peek().span, "expected a name after 'for', found '('", help);
  const std::optional<Name> name = panic_ ? std::nullopt : new_name("the loop's variable");
  if (name && !take_if(TokenKind::kw_in)) {
    if (at(TokenKind::equals))
      note_mistake(take().span, "expected 'in', found '='", help);
    else
      fail(peek().span, fmt::format("expected 'in', found {}", found()), help);
  }
  return name;
}

// for = "for" name "in" header_value block
std::optional<Parser::ItemNode> Parser::for_item() {
  const std::optional<Name> name = name_of_rounds("a loop is written: for i in 0..<10 { … }");
  const ExprId range = header_value();
  const BlockId body = block(place_, "the header of 'for'");
  if (!name) return std::nullopt;
  return ForItem{*name, range, body};
}

// if = "if" expression block [ "else" ( if | block ) ]
std::optional<Parser::ItemNode> Parser::if_item() {
  take();
  const ExprId condition = header_value();
  if (at(TokenKind::kw_then)) {
    const Span then = take().span;  // what has no braces is told by them
    if (at(TokenKind::left_brace))
      note_mistake(then, "no 'then' in a statement", "write if condition { … } else { … }");
  }
  if (at(TokenKind::kw_else))
    fail(peek().span, "expected '{' after the condition of 'if', found 'else'",
         "a choice of values is written: if a then b else c");
  const BlockId then_block = block(place_, "the condition of 'if'");
  BlockId else_block;
  if (!panic_ && take_if(TokenKind::kw_else)) {
    if (at(TokenKind::kw_if)) {
      const std::uint32_t first = at_;
      const std::uint32_t outer_tallest = std::exchange(tallest_, 0);
      std::vector<ItemId> only;
      if (enter())
        if (const std::optional<ItemId> inner = item()) only.push_back(*inner);
      leave();
      else_block = add_block(first, only, outer_tallest);
    } else {
      else_block = block(place_, "'else'");
    }
  }
  return IfItem{condition, then_block, else_block};
}

// return = "return" expression
std::optional<Parser::ItemNode> Parser::return_item() {
  take();
  return ReturnItem{expression()};
}

// parameter = word ":" expression [ "," ]
std::optional<Parser::ItemNode> Parser::parameter_item() {
  const Name name = take_name();
  const Span colon = take().span;
  switch (place_) {
    case BlockPlace::thing:
      if (at(TokenKind::left_brace) && tokens_.tokens[at_ - 2].kind == TokenKind::name)
        braces_of_no_body_ = at_;
      return ParameterItem{name, expression()};
    case BlockPlace::body:
      note_mistake(colon, fmt::format("'{}' is set with '=' here", text(name)),
                   fmt::format("write {} = value; ':' gives a value to a parameter", text(name)));
      return AssignItem{name, expression()};
    case BlockPlace::steps:
      note_mistake(colon, fmt::format("'{}' is set with '=' here", text(name)),
                   "':' gives a value to a parameter");
      return AssignItem{name, expression()};
    case BlockPlace::file:
      break;
  }
  note_mistake(colon, fmt::format("'{}:' gives a value to a parameter, and nothing here has one", text(name)),
               fmt::format("to define a name write let {} = value", text(name)));
  return LetItem{name, expression()};
}

// assign = name "=" expression, or as assign_entry() reads it
std::optional<Parser::ItemNode> Parser::assign_item() {
  const bool reserved = is_reserved(kind());
  const Name name = take_name();
  const Span equals = take().span;
  if (reserved && place_ == BlockPlace::thing) {
    note_mistake(equals, "a parameter is given with ':'", fmt::format("write {}: value", text(name)));
    return ParameterItem{name, expression()};
  }
  if (reserved) {
    note_mistake(name.span, fmt::format("'{}' is a reserved word and cannot be set", text(name)));
    expression();
    return std::nullopt;
  }
  return AssignItem{name, expression()};
}

// thing = name [ name ] [ string ] block
std::optional<Parser::ItemNode> Parser::thing_item() {
  const Name keyword = take_name();
  if (value_without_colon()) return parameter_without_colon(keyword);
  const bool alone = ends_line_alone(keyword);
  if ((alone || !begins_thing()) && statement_of_others(keyword)) return std::nullopt;
  if (alone || (at(TokenKind::name) && kind(1) == TokenKind::equals)) return lone_word(keyword, alone);
  std::string owner(text(keyword));
  const bool kind_follows = at(TokenKind::name) && kind(1) != TokenKind::colon &&
                            kind(1) != TokenKind::equals && kind(1) != TokenKind::left_paren;
  Name variant;
  ExprId file;
  if (kind_follows) {
    variant = take_name();
    owner += fmt::format(" {}", text(variant));
  }
  if (at(TokenKind::string) || at(TokenKind::string_head)) file = string_value();
  if (at(TokenKind::dot) || at(TokenKind::left_bracket)) {
    part_of_a_word(owner);
    return std::nullopt;
  }
  if (!at(TokenKind::left_brace) && !file.valid() && !kind_follows &&
      !(is_word(kind()) && kind(1) == TokenKind::colon)) {
    fail(keyword.span,
         fmt::format("'{}' does nothing here: expected '{{', '(', ':' or '=' after it, found {}", owner,
                     found()),
         at(TokenKind::minus) && kind(1) == TokenKind::minus ? fmt::format("write {0} = {0} - 1", owner)
                                                             : std::string{});
    return std::nullopt;
  }
  if (kind_follows && !file.valid() && !at(TokenKind::left_brace) &&
      !(is_word(kind()) && kind(1) == TokenKind::colon)) {
    fail(keyword.span, fmt::format("expected '{{' after '{}', found {}", owner, found()),
         fmt::format("write {} {{ … }}", owner));
    return std::nullopt;
  }
  const BlockId body = block(BlockPlace::thing, fmt::format("'{}'", owner));
  return ThingItem{keyword, variant, file, body};
}

// call = postfix, which must end with a call
std::optional<Parser::ItemNode> Parser::call_item() {
  const std::uint32_t first = at_;
  const ExprId result = postfix();
  if (panic_) return std::nullopt;
  const std::string_view name = text(tokens_.tokens[first]);
  if (at(TokenKind::left_brace) && statement_of_others({symbols_.intern(name), tokens_.tokens[first].span}))
    return std::nullopt;
  if (at(TokenKind::equals) || at(TokenKind::left_brace)) {
    fail(peek().span, fmt::format("expected a statement, found {}", found()),
         fmt::format("a function or template is defined with def {}(…)", name));
    return std::nullopt;
  }
  const ExprNode& node = tree_[result].node;
  if (!std::holds_alternative<CallExpr>(node) && !std::holds_alternative<ErrorExpr>(node))
    note_mistake(tree_[result].span, "this value is not used", "give it a name with 'let'");
  return CallItem{result};
}

}  // namespace tyndall::syntax
