// The printed forms: tokens, one a line; the tree, as s-expressions with one item a line.
#include <fmt/format.h>

#include <iterator>

#include "syntax/parser.h"

namespace tyndall::syntax {

namespace {

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    switch (c) {
      case '\n':
        out += "\\n";
        break;
      case '\t':
        out += "\\t";
        break;
      case '"':
      case '\\':
      case '{':
      case '}':
        out += '\\';
        [[fallthrough]];
      default:
        out += c;
    }
  }
  return out + '"';
}

class TreePrinter {
 public:
  TreePrinter(const SyntaxTree& tree, const Symbols& symbols) : tree_(tree), symbols_(symbols) {}

  std::string run() {
    out_ = "(file";
    block(tree_.file);
    return std::move(out_) + ")\n";
  }

 private:
  void put(std::string_view text) { out_ += text; }
  void word(std::string_view text) { (out_ += ' ') += text; }
  void name(const Name& n) { word(symbols_.text(n.symbol)); }
  void optional_name(const Name& n) {
    if (n.symbol.valid()) name(n);
  }
  void value(ExprId e) {
    put(" ");
    std::visit([this](const auto& node) { expr(node); }, tree_[e].node);
  }
  void optional_value(ExprId e) {
    if (e.valid()) value(e);
  }
  void values(ListRef list) {
    for (const ExprId e : tree_.list_of_exprs(list)) value(e);
  }
  // The items of a block, each on its line, two columns further in.
  void block(BlockId b) {
    indent_ += 2;
    for (const ItemId i : tree_.list_of_items(tree_[b].items)) {
      put("\n");
      out_.append(indent_, ' ');
      put("(");
      std::visit([this](const auto& node) { item(node); }, tree_[i].node);
      put(")");
    }
    indent_ -= 2;
  }
  void parameters(ListRef list) {
    put(" (");
    const char* before = "";
    for (const Parameter& p : tree_.list_of_parameters(list)) {
      put(before);
      put(symbols_.text(p.name.symbol));
      if (p.default_value.valid()) {
        put(" =");
        value(p.default_value);
      }
      before = ", ";
    }
    put(")");
  }
  void thing(const Name& keyword, const Name& kind, ExprId file, BlockId body) {
    put("thing");
    if (keyword.symbol.valid())
      name(keyword);
    else
      word("_");
    optional_name(kind);
    optional_value(file);
    block(body);
  }

  void expr(const ErrorExpr&) { put("<error>"); }
  void expr(const NumberExpr& e) { put(fmt::format("{}{}", e.value, spelling(e.unit))); }
  void expr(const ColorExpr& e) { put(fmt::format("#{:06x}", e.rgb)); }
  void expr(const BoolExpr& e) { put(e.value ? "true" : "false"); }
  void expr(const StringExpr& e) {
    const StringValue& s = tree_.strings[e.literal];
    if (s.values.empty()) return put(quoted(s.pieces[0]));
    put("(string");
    for (std::size_t i = 0; i < s.pieces.size(); ++i) {
      word(quoted(s.pieces[i]));
      if (i < s.values.size()) value(s.values[i]);
      if (i < s.formats.size() && s.formats[i].width > 0) put(fmt::format(":0{}", s.formats[i].width));
      if (i < s.formats.size() && s.formats[i].decimals) put(fmt::format(":.{}", *s.formats[i].decimals));
    }
    put(")");
  }
  void expr(const NameExpr& e) { put(symbols_.text(e.symbol)); }
  void expr(const UnaryExpr& e) {
    put(e.op == UnaryOp::negate ? "(-" : "(not");
    value(e.operand);
    put(")");
  }
  void expr(const BinaryExpr& e) {
    put("(");
    put(spelling(e.op));
    value(e.left);
    value(e.right);
    put(")");
  }
  void expr(const ConditionalExpr& e) {
    put("(if");
    value(e.condition);
    value(e.then_value);
    value(e.else_value);
    put(")");
  }
  void expr(const CallExpr& e) {
    put("(call");
    value(e.callee);
    arguments(e.arguments);
    put(")");
  }
  void arguments(ListRef list) {
    for (const Argument& a : tree_.list_of_arguments(list)) {
      if (a.name.symbol.valid()) {
        name(a.name);
        put(":");
      }
      value(a.value);
    }
  }
  void expr(const IndexExpr& e) {
    put("(index");
    value(e.list);
    value(e.index);
    put(")");
  }
  void expr(const MemberExpr& e) {
    put("(member");
    value(e.object);
    word(symbols_.text(e.member));
    put(")");
  }
  void expr(const TupleExpr& e) {
    put("(tuple");
    values(e.elements);
    put(")");
  }
  void expr(const ListExpr& e) {
    put("(list");
    values(e.elements);
    put(")");
  }
  void expr(const ComprehensionExpr& node) {
    const Comprehension& e = tree_.comprehensions[node.comprehension];
    put(e.nests ? "(each of" : "(each");
    name(e.name);
    value(e.over);
    optional_value(e.condition);
    value(e.element);
    put(")");
  }
  void expr(const WithEntryExpr& e) {
    put("(with_entry");
    value(e.list);
    value(e.index);
    value(e.entry);
    put(")");
  }
  void expr(const RangeExpr& e) {
    put(e.excludes_last ? "(..<" : "(..");
    value(e.first);
    value(e.last);
    optional_value(e.step);
    put(")");
  }
  void expr(const ThingExpr& e) {
    put("(");
    thing(e.keyword, {}, e.file, e.block);
    put(")");
  }

  void item(const LetItem& i) { definition("let", i.name, i.value); }
  void item(const VarItem& i) { definition("var", i.name, i.value); }
  void item(const AssignItem& i) { definition("set", i.name, i.value); }
  void item(const ParameterItem& i) { definition("parameter", i.name, i.value); }
  void definition(std::string_view keyword, const Name& n, ExprId e) {
    put(keyword);
    name(n);
    value(e);
  }
  void item(const FunctionItem& i) {
    put("function");
    name(i.name);
    parameters(i.parameters);
    optional_value(i.value);
    if (i.steps.valid()) block(i.steps);
  }
  void item(const TemplateItem& i) { with_parameters("template", i.name, i.parameters, i.body); }
  void item(const BodyItem& i) {
    with_parameters(i.kind == BodyKind::medium ? "medium" : "material", i.name, i.parameters, i.body);
  }
  void with_parameters(std::string_view keyword, const Name& n, ListRef list, BlockId body) {
    put(keyword);
    name(n);
    parameters(list);
    block(body);
  }
  void item(const ObjectItem& i) {
    put("object");
    name(i.name);
    if (i.parameters.count > 0) parameters(i.parameters);
    block(i.body);
  }
  void item(const PlaceItem& i) {
    put("place");
    name(i.name);
    arguments(i.arguments);
    block(i.block);
  }
  void item(const IncludeItem& i) {
    put("include");
    value(i.file);
  }
  void item(const ForItem& i) {
    put("for");
    name(i.name);
    value(i.range);
    block(i.body);
  }
  void item(const IfItem& i) {
    put("if");
    value(i.condition);
    block(i.then_block);
    if (!i.else_block.valid()) return;
    put("\n");
    out_.append(indent_, ' ');
    put(" else");
    block(i.else_block);
  }
  void item(const ReturnItem& i) {
    put("return");
    value(i.value);
  }
  void item(const ThingItem& i) { thing(i.keyword, i.kind, i.file, i.block); }
  void item(const CallItem& i) {
    put("place_call");
    value(i.call);
  }

  const SyntaxTree& tree_;
  const Symbols& symbols_;
  std::string out_;
  std::size_t indent_ = 0;
};

}  // namespace

std::string print(const TokenList& tokens, const Sources& sources) {
  std::string out;
  LineColumn at;  // of the offset `begin`, counted along: a file may be one long line
  std::uint32_t begin = 0;
  for (const Token& token : tokens.tokens) {
    const std::string_view text = sources[token.span.source].text();
    for (; begin < token.span.begin; ++begin) {
      if (text[begin] == '\n')
        at = {at.line + 1, 1};
      else if ((static_cast<unsigned char>(text[begin]) & 0xc0) != 0x80)
        ++at.column;
    }
    fmt::format_to(std::back_inserter(out), "{}:{} ", at.line, at.column);
    if (token.kind == TokenKind::number)
      fmt::format_to(std::back_inserter(out), "number {}{}", token.number, spelling(token.unit));
    else if (token.kind == TokenKind::color)
      fmt::format_to(std::back_inserter(out), "color #{:06x}", token.text);
    else if (token.kind == TokenKind::name)
      (out += "name ") += sources.text(token.span);
    else if (token.kind >= TokenKind::string && token.kind <= TokenKind::string_tail)
      fmt::format_to(std::back_inserter(out), "{} {}", spelling(token.kind),
                     quoted(tokens.strings[token.text]));
    else
      out += spelling(token.kind);
    out += '\n';
  }
  return out;
}

std::string print(const SyntaxTree& tree, const Symbols& symbols) { return TreePrinter(tree, symbols).run(); }

}  // namespace tyndall::syntax
