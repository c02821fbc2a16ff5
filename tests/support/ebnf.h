// A reader of the EBNF that grammar/ is written in: productions as trees.
#pragma once

#include <cctype>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall::test {

struct EbnfNode {
  enum class Kind { terminal, name, prose, optional, repeated, sequence, choice, range } kind;
  std::string text;             // terminal, name, prose
  std::vector<EbnfNode> parts;  // of a range: its two ends
};

// The productions by name; throws std::runtime_error at what is no EBNF.
class Ebnf {
 public:
  explicit Ebnf(std::string_view text) : rest_(text) {
    for (blanks(); !rest_.empty(); blanks()) {
      const std::string name = word();
      mark('=');
      if (!productions_.emplace(name, choice()).second) fail("a second production of " + name);
      order_.push_back(name);
      mark(';');
    }
  }
  const EbnfNode& operator[](const std::string& name) const {
    const auto found = productions_.find(name);
    if (found == productions_.end()) throw std::runtime_error("no production '" + name + "'");
    return found->second;
  }
  bool has(const std::string& name) const { return productions_.contains(name); }
  const std::vector<std::string>& names() const { return order_; }

 private:
  using Kind = EbnfNode::Kind;

  [[noreturn]] void fail(const std::string& message) const {
    throw std::runtime_error(message + " before: " + std::string(rest_.substr(0, 40)));
  }
  void blanks() {
    for (;;) {
      while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_[0]))) rest_.remove_prefix(1);
      if (!rest_.starts_with("(*")) return;
      const std::size_t end = rest_.find("*)");
      if (end == std::string_view::npos) fail("a comment is not closed");
      rest_.remove_prefix(end + 2);
    }
  }
  bool at(char c) {
    blanks();
    return rest_.starts_with(c);
  }
  void mark(char c) {
    if (!at(c)) fail(std::string("expected ") + c);
    rest_.remove_prefix(1);
  }
  std::string word() {
    std::size_t end = 0;
    while (end < rest_.size() && (std::isalnum(static_cast<unsigned char>(rest_[end])) || rest_[end] == '_'))
      ++end;
    if (end == 0) fail("expected a name");
    return taken(end);
  }
  std::string taken(std::size_t length) {
    std::string out(rest_.substr(0, length));
    rest_.remove_prefix(length);
    return out;
  }
  std::string quoted(std::string_view quote) {
    rest_.remove_prefix(quote.size());
    const std::size_t end = rest_.find(quote);
    if (end == std::string_view::npos) fail("a quote is not closed");
    std::string out = taken(end);
    rest_.remove_prefix(quote.size());
    return out;
  }
  EbnfNode choice() {
    std::vector<EbnfNode> parts{sequence()};
    while (at('|')) {
      mark('|');
      parts.push_back(sequence());
    }
    return parts.size() == 1 ? parts[0] : EbnfNode{Kind::choice, {}, parts};
  }
  EbnfNode sequence() {
    std::vector<EbnfNode> parts;
    while (!at('|') && !at(';') && !at(']') && !at('}') && !at(')')) {
      if (rest_.empty()) fail("a production is not ended");
      parts.push_back(part());
      if (at('\xe2') && rest_.starts_with("…")) {
        rest_.remove_prefix(std::string_view("…").size());
        blanks();
        const EbnfNode low = parts.back();
        parts.back() = {Kind::range, {}, {low, part()}};
      }
    }
    return parts.size() == 1 ? parts[0] : EbnfNode{Kind::sequence, {}, parts};
  }
  EbnfNode part() {
    if (at('"')) return {Kind::terminal, quoted("\""), {}};
    if (at('\'')) return {Kind::terminal, quoted("'"), {}};
    if (at('?')) return {Kind::prose, quoted("?"), {}};
    if (at('[')) return group('[', Kind::optional, ']');
    if (at('{')) return group('{', Kind::repeated, '}');
    if (at('(')) return group('(', Kind::sequence, ')');
    return {Kind::name, word(), {}};
  }
  EbnfNode group(char open, Kind kind, char close) {
    mark(open);
    EbnfNode node{kind, {}, {choice()}};
    mark(close);
    return node;
  }

  std::string_view rest_;
  std::map<std::string, EbnfNode> productions_;
  std::vector<std::string> order_;
};

}  // namespace tyndall::test
