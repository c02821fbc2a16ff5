// Scenes of grids for tests, and what is told of them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "resolve/resolve.h"
#include "support/test_folder.h"
#include "syntax/parser.h"

namespace tyndall::import {

struct Resolved {
  Sources sources;
  Diagnostics diagnostics;
  syntax::Symbols symbols;
  scene::Scene scene;

  std::string messages() const { return render_text(diagnostics, sources, false); }
};

inline Resolved resolved(const std::string& text, const resolve::Options& options = {}) {
  Resolved r;
  const SourceId source = r.sources.add((test_folder() / "test.tyn").string(), text);
  const syntax::TokenList tokens = syntax::lex(r.sources, source, r.diagnostics);
  const syntax::SyntaxTree tree = syntax::parse(r.sources, source, tokens, r.symbols, r.diagnostics);
  r.scene = resolve::resolve(tree, r.sources, r.symbols, options, r.diagnostics);
  return r;
}

inline const std::string camera = R"(
render { resolution: (8, 8)  samples: 4  step: 0.05  bounces: 4 }
camera perspective { from: (0, 0, 4)  to: (0, 0, 0)  fov: 30deg }
light environment { radiance: 1 }
light point { position: (2, 3, 2)  power: 60 }
)";

inline scene::Scene clean(const std::string& text) {
  Resolved r = resolved(camera + text);
  EXPECT_TRUE(r.diagnostics.all().empty()) << r.messages();
  return std::move(r.scene);
}

inline void expect_message(const std::string& text, const std::string& message) {
  const Resolved r = resolved(camera + text);
  EXPECT_NE(r.messages().find(message), std::string::npos) << r.messages();
}

}  // namespace tyndall::import
