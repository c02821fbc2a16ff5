// Random sentences of the scene language, made from its EBNF and what the EBNF's comments say in words.
#pragma once

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "support/ebnf.h"
#include "syntax/token.h"

namespace tyndall::test {

class Sentences {
 public:
  // `lexical` are the productions whose parts are joined.
  Sentences(const Ebnf& grammar, std::vector<std::string> lexical, std::uint32_t seed)
      : grammar_(grammar), lexical_(std::move(lexical)), random_(seed) {}

  // The words of a file.
  std::vector<std::string> next() {
    words_.clear();
    depth_ = 0;
    expand("file");
    return words_;
  }
  std::size_t below(std::size_t n) { return random_() % n; }
  std::mt19937& random() { return random_; }

 private:
  using Kind = EbnfNode::Kind;
  static constexpr int deepest = 28;
  static constexpr std::size_t longest = 120;  // words, after which what is open is only closed

  bool is_lexical(const std::string& name) const {
    return std::find(lexical_.begin(), lexical_.end(), name) != lexical_.end();
  }

  void expand(const std::string& name) {
    if (is_lexical(name)) return words_.push_back(word(name));
    ++depth_;
    const bool outer_braces = braces_, outer_parameters = parameters_;
    if (name == "thing" || name == "place" || name == "value_thing") parameters_ = true;
    if (name == "def" || name == "body" || name == "object" || name == "unnamed_body") parameters_ = false;
    if (name == "header_value") braces_ = false;
    if (name == "arguments") {
      const bool outer_named = std::exchange(named_, false);
      expand_node(grammar_[name], name);
      named_ = outer_named;
    } else if (name == "argument") {
      // Positional arguments stand before named ones.
      named_ = named_ || below(3) == 0;
      if (named_) {
        words_.push_back(word("word"));
        words_.push_back(":");
      }
      const bool here = named_;
      expand("expression");
      named_ = here;
    } else if (name == "parameter") {
      // After a value these words go on with it.
      const std::size_t at = words_.size();
      expand_node(grammar_[name], name);
      for (const char* joining : {"and", "or", "then", "else"})
        if (words_[at] == joining) words_[at] = "x";
    } else {
      expand_node(grammar_[name], name);
    }
    braces_ = outer_braces;
    parameters_ = outer_parameters;
    --depth_;
  }

  void expand_node(const EbnfNode& node, const std::string& production) {
    switch (node.kind) {
      case Kind::terminal:
        words_.push_back(node.text);
        return;
      case Kind::name:
        // What follows the `=` of a function begins with no brace, or it is a function with steps.
        if (production == "def" && node.text == "expression") {
          const bool outer = std::exchange(braces_, false);
          expand(node.text);
          braces_ = outer;
          return;
        }
        return expand(node.text);
      case Kind::optional:
        if (below(too_deep() ? 8 : 2) == 0) expand_node(node.parts[0], production);
        return;
      case Kind::repeated:
        if (production == "postfix") return suffixes(node.parts[0]);
        for (std::size_t rounds = below(production == "file" ? 6 : too_deep() ? 1 : 3); rounds > 0; --rounds)
          expand_node(node.parts[0], production);
        return;
      case Kind::sequence: {
        // Brackets lift what a header forbids.
        const bool outer = braces_;
        for (const EbnfNode& part : node.parts) {
          const bool bracket = part.kind == Kind::terminal && (part.text == "(" || part.text == "[");
          expand_node(part, production);
          if (bracket) braces_ = true;
        }
        braces_ = outer;
        return;
      }
      case Kind::choice: {
        const EbnfNode& part = chosen(node, production);
        expand_node(part, production);
        if (production == "value") callable_ = part.text == "name";
        return;
      }
      case Kind::prose:
      case Kind::range:
        throw std::runtime_error("not in a syntactic production: " + production);
    }
  }

  const EbnfNode& chosen(const EbnfNode& choice, const std::string& production) {
    for (;;) {
      const EbnfNode& part = choice.parts[below(choice.parts.size())];
      // Rows of `-` and `not` teach little.
      if ((production == "unary" || production == "negation") && &part != &choice.parts.back() &&
          below(4) > 0)
        continue;
      if (production == "item" && part.text == "parameter" && !parameters_) continue;
      if (production == "value" && !braces_ && (part.text == "value_thing" || part.text == "unnamed_body"))
        continue;
      if (production == "value" && too_deep() && part.text != "literal" && part.text != "name") continue;
      if (production == "item" && too_deep() && part.text != "let" && part.text != "return") continue;
      if (production == "expression" && too_deep() && part.text == "conditional") continue;
      return part;
    }
  }

  // "(" follows only what may be a function.
  void suffixes(const EbnfNode& choice) {
    bool callable = callable_;
    for (std::size_t rounds = below(too_deep() ? 1 : 3); rounds > 0; --rounds) {
      const EbnfNode& part = choice.parts[below(choice.parts.size())];
      if (part.parts[0].text == "(" && !callable) continue;
      expand_node(part, "suffix");
      callable = true;
    }
  }

  // A word: its parts joined.
  std::string word(const std::string& name) {
    if (name == "name") return plain_name();
    return joined(grammar_[name], name);
  }
  std::string plain_name() {
    std::string out = joined(grammar_["name"], "name");
    return syntax::word_kind(out) == syntax::TokenKind::name ? out : out + "_";
  }
  std::string joined(const EbnfNode& node, const std::string& production) {
    std::string out;
    switch (node.kind) {
      case Kind::terminal:
        return node.text;
      case Kind::name:
        if (is_lexical(node.text)) return word(node.text);
        return interpolation();
      case Kind::optional:
        return below(2) == 0 ? joined(node.parts[0], production) : "";
      case Kind::repeated:
        for (std::size_t rounds = below(2); rounds > 0; --rounds) out += joined(node.parts[0], production);
        return out;
      case Kind::sequence:
        for (const EbnfNode& part : node.parts) out += joined(part, production);
        return out;
      case Kind::choice:
        return joined(node.parts[below(node.parts.size())], production);
      case Kind::prose: {
        static constexpr const char* characters[] = {"a", " ", "é", "}", "0", "☁", ".", "'"};
        return characters[below(std::size(characters))];
      }
      case Kind::range: {
        const char low = node.parts[0].text[0], high = node.parts[1].text[0];
        return {static_cast<char>(low + static_cast<char>(below(static_cast<std::size_t>(high - low + 1))))};
      }
    }
    return out;
  }
  // An expression inside a string, on its line.
  std::string interpolation() {
    std::vector<std::string> outer;
    outer.swap(words_);
    const bool outer_braces = std::exchange(braces_, true), outer_named = named_, outer_callable = callable_;
    depth_ += deepest / 2;
    expand("expression");
    depth_ -= deepest / 2;
    braces_ = outer_braces;
    named_ = outer_named;
    callable_ = outer_callable;
    std::string out;
    for (const std::string& w : words_) out += w + " ";
    words_.swap(outer);
    return out;
  }
  bool too_deep() const { return depth_ > deepest || words_.size() > longest; }

  const Ebnf& grammar_;
  std::vector<std::string> lexical_;
  std::mt19937 random_;
  std::vector<std::string> words_;
  int depth_ = 0;
  bool braces_ = true;       // a value may begin with or be joined by "{"
  bool parameters_ = false;  // `name: value` may stand in the block
  bool named_ = false;       // a named argument was given
  bool callable_ = false;    // the last value is a name
};

}  // namespace tyndall::test
