// What the tests of this folder share: reading a text to its printed tree and its errors.
#pragma once

#include <string>

#include "syntax/parser.h"

namespace tyndall::syntax {

// A text that was read: its printed tree, and its errors as text.
struct Reading {
  Sources sources;
  Diagnostics diagnostics;
  Symbols symbols;
  TokenList tokens;
  SyntaxTree tree;

  explicit Reading(std::string text) {
    const SourceId source = sources.add("scene.tyn", std::move(text));
    tokens = lex(sources, source, diagnostics);
    tree = parse(sources, source, tokens, symbols, diagnostics);
  }
  std::string printed() const { return print(tree, symbols); }
  std::string errors() const { return render_text(diagnostics, sources, false); }
  // "line:column message [help]" of each error, one a line.
  std::string brief() const {
    std::string out;
    for (const Diagnostic& d : diagnostics.all()) {
      const LineColumn at = sources[d.span.source].locate(d.span.begin);
      out += std::to_string(at.line) + ":" + std::to_string(at.column) + " " + d.message;
      if (!d.help.empty()) out += " [" + d.help + "]";
      out += '\n';
    }
    return out;
  }
};

}  // namespace tyndall::syntax
