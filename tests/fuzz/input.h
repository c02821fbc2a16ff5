// What the fuzzers share: bytes read as a scene.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "syntax/parser.h"

namespace tyndall::fuzz {

struct Input {
  Sources sources;
  Diagnostics diagnostics;
  syntax::Symbols symbols;
  SourceId source;
  syntax::TokenList tokens;
  syntax::SyntaxTree tree;

  Input(const std::uint8_t* data, std::size_t size)
      : source(sources.add("fuzz.tyn", std::string(reinterpret_cast<const char*>(data), size))),
        tokens(syntax::lex(sources, source, diagnostics)) {}
  void parse() { tree = syntax::parse(sources, source, tokens, symbols, diagnostics); }
  // Whether it would read other files, which no fuzzer may.
  bool includes() const {
    return std::any_of(tokens.tokens.begin(), tokens.tokens.end(),
                       [](const syntax::Token& t) { return t.kind == syntax::TokenKind::kw_include; });
  }
};

}  // namespace tyndall::fuzz
