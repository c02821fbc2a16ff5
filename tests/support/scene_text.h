// Scenes written as text, for tests.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "resolve/resolve.h"
#include "syntax/parser.h"

namespace tyndall::support {

// The scene that the text describes; a failure when it has errors.
inline scene::Scene scene_of(const std::string& text, const resolve::Options& options = {}) {
  Sources sources;
  Diagnostics diagnostics;
  syntax::Symbols symbols;
  const SourceId source = sources.add("test.tyn", text);
  const syntax::TokenList tokens = syntax::lex(sources, source, diagnostics);
  const syntax::SyntaxTree tree = syntax::parse(sources, source, tokens, symbols, diagnostics);
  scene::Scene scene = resolve::resolve(tree, sources, symbols, options, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << render_text(diagnostics, sources, false);
  return scene;
}

}  // namespace tyndall::support
