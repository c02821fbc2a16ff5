// The syntax tree: what the parser read, nothing decided. Read-only after parsing; analyses use side tables.
//
// Nodes live in vectors and refer to each other by typed ids; lists are ranges of shared vectors. A node that
// could not be read is ErrorExpr (already reported): whoever meets it stays silent.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "base/id.h"
#include "base/source.h"
#include "syntax/token.h"

namespace tyndall::syntax {

struct Expr;
struct Item;
struct Block;
using ExprId = Id<Expr>;
using ItemId = Id<Item>;
using BlockId = Id<Block>;

// A range of one of the tree's list vectors.
struct ListRef {
  std::uint32_t first = 0, count = 0;
};

// A name as written, with its place. The text is interned: equal names have equal `symbol`.
using SymbolId = Id<struct SymbolTag>;
struct Name {
  SymbolId symbol;
  Span span;
};

// ----------------------------------------------------------------------------------------------------
// expressions

struct ErrorExpr {};
struct NumberExpr {
  double value;
  Unit unit;
};  // base units; angles in radians
struct ColorExpr {
  std::uint32_t rgb;
};  // #rrggbb, sRGB
struct BoolExpr {
  bool value;
};
struct StringExpr {
  std::uint32_t literal;
};  // SyntaxTree::strings
struct NameExpr {
  SymbolId symbol;
};
enum class UnaryOp : std::uint8_t { negate, logical_not };
struct UnaryExpr {
  UnaryOp op;
  ExprId operand;
};
enum class BinaryOp : std::uint8_t {
  add,
  subtract,
  multiply,
  divide,
  power,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  logical_and,
  logical_or
};
std::string_view spelling(BinaryOp op);
struct BinaryExpr {
  BinaryOp op;
  ExprId left, right;
};
struct ConditionalExpr {
  ExprId condition, then_value, else_value;
};
struct CallExpr {
  ExprId callee;
  ListRef arguments;
};  // SyntaxTree::arguments; callee is a NameExpr or an expression
struct IndexExpr {
  ExprId list, index;
};
struct MemberExpr {
  ExprId object;
  SymbolId member;
  Span member_span;
};  // swizzles: c.bgr, p.x
struct TupleExpr {
  ListRef elements;
};  // (x, y) or (x, y, z): SyntaxTree::expr_list
struct ListExpr {
  ListRef elements;
};  // [a, b]: SyntaxTree::expr_list
struct ComprehensionExpr {
  std::uint32_t comprehension;
};  // SyntaxTree::comprehensions
struct WithEntryExpr {
  ExprId list, index, entry;
};  // the list with another entry: what `l[i] = x` sets l to
struct RangeExpr {
  ExprId first, last, step;
  bool excludes_last;
};  // step may be invalid (none written)
// `sphere { … }`, `gltf "jar.glb" { … }`, `{ density = 1 }` (an unnamed medium body: keyword invalid).
struct ThingExpr {
  Name keyword;
  ExprId file;
  BlockId block;
};  // file may be invalid

// An argument of a call: positional (name invalid) or `name: value`.
struct Argument {
  Name name;
  ExprId value;
};

struct Expr {
  Span span;
  std::variant<ErrorExpr, NumberExpr, ColorExpr, BoolExpr, StringExpr, NameExpr, UnaryExpr, BinaryExpr,
               ConditionalExpr, CallExpr, IndexExpr, MemberExpr, TupleExpr, ListExpr, ComprehensionExpr,
               WithEntryExpr, RangeExpr, ThingExpr>
      node;
};
static_assert(sizeof(Expr) <= 48);  // long lists of numbers are many expressions

// ----------------------------------------------------------------------------------------------------------
// items

// A parameter of a def, medium or material; `default_value` may be invalid.
struct Parameter {
  Name name;
  ExprId default_value;
};

struct LetItem {
  Name name;
  ExprId value;
};  // let a = 1
struct VarItem {
  Name name;
  ExprId value;
};  // var a = 1
struct AssignItem {
  Name name;
  ExprId value;
};  // a = 1: a var, or an output of a body
struct FunctionItem {
  Name name;
  ListRef parameters;
  ExprId value;
  BlockId steps;
};  // def f(p) = e, or = { steps }
struct TemplateItem {
  Name name;
  ListRef parameters;
  BlockId body;
};  // def f(p) { … }
enum class BodyKind : std::uint8_t { medium, material };
struct BodyItem {
  BodyKind kind;
  Name name;
  ListRef parameters;
  BlockId body;
};  // medium f(p) { … }
struct ObjectItem {
  Name name;
  ListRef parameters;
  BlockId body;
};  // object a { … }, object a(x) { … }
struct PlaceItem {
  Name name;
  ListRef arguments;
  BlockId block;
};  // place a { … }, place a(x: 1) { … }; block always valid
struct IncludeItem {
  ExprId file;
};
struct ForItem {
  Name name;
  ExprId range;
  BlockId body;
};
struct IfItem {
  ExprId condition;
  BlockId then_block;
  BlockId else_block;
};  // `else if` is a block of one IfItem
struct ReturnItem {
  ExprId value;
};
struct ParameterItem {
  Name name;
  ExprId value;
};  // radius: 2, inside a thing's block
// A scene statement: `sphere { … }`, `light point { … }`, `camera perspective { … }`, `gltf "a.glb" { … }`.
struct ThingItem {
  Name keyword;
  Name kind;
  ExprId file;
  BlockId block;
};
struct CallItem {
  ExprId call;
};  // lamp((1, 2, 0)): a template placed

struct Item {
  Span span;
  std::variant<LetItem, VarItem, AssignItem, FunctionItem, TemplateItem, BodyItem, ObjectItem, PlaceItem,
               IncludeItem, ForItem, IfItem, ReturnItem, ParameterItem, ThingItem, CallItem>
      node;
};

// `{ … }` or a whole file.
struct Block {
  Span span;
  ListRef items;  // SyntaxTree::item_list
};

// How a number is written into a string: "{x:06.2}".
struct NumberFormat {
  std::uint8_t width = 0;                // with zeros in front up to so many characters
  std::optional<std::uint8_t> decimals;  // as many as it has, if not given

  bool given() const { return width > 0 || decimals.has_value(); }
};

// A string with its interpolated expressions: pieces.size() == values.size() + 1 == formats.size() + 1.
struct StringValue {
  std::vector<std::string> pieces;
  std::vector<ExprId> values;
  std::vector<NumberFormat> formats;
};

// [element for name in over if condition]; `condition` may be invalid. A further `for` makes the element
// another one, whose entries stand in this one's list.
struct Comprehension {
  Name name;
  ExprId over, condition, element;
  bool nests;
};

// Names to small numbers and back. One table serves a whole run, so symbols compare across files.
class Symbols {
 public:
  SymbolId intern(std::string_view text);
  std::string_view text(SymbolId id) const { return texts_[id.index]; }

 private:
  std::deque<std::string> texts_;  // stable addresses for the keys of ids_
  std::unordered_map<std::string_view, SymbolId> ids_;
};

struct SyntaxTree {
  SourceId source;
  std::vector<Expr> exprs;
  std::vector<Item> items;
  std::vector<Block> blocks;
  std::vector<ExprId> expr_list;
  std::vector<Argument> arguments;
  std::vector<Parameter> parameters;
  std::vector<ItemId> item_list;
  std::vector<StringValue> strings;
  std::vector<Comprehension> comprehensions;
  BlockId file;  // the whole file
  // Definitions of which no more than the name could be read, and whether reading was given up: told already.
  std::vector<SymbolId> unread_definitions;
  bool gave_up = false;

  const Expr& operator[](ExprId id) const { return exprs[id.index]; }
  const Item& operator[](ItemId id) const { return items[id.index]; }
  const Block& operator[](BlockId id) const { return blocks[id.index]; }
  std::span<const ExprId> list_of_exprs(ListRef r) const { return {expr_list.data() + r.first, r.count}; }
  std::span<const Argument> list_of_arguments(ListRef r) const {
    return {arguments.data() + r.first, r.count};
  }
  std::span<const Parameter> list_of_parameters(ListRef r) const {
    return {parameters.data() + r.first, r.count};
  }
  std::span<const ItemId> list_of_items(ListRef r) const { return {item_list.data() + r.first, r.count}; }
};

}  // namespace tyndall::syntax
