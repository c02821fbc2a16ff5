// A scene text resolved, with its messages: what the tests of this folder share.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "resolve/resolve.h"
#include "syntax/parser.h"

namespace tyndall {

struct Resolved {
  Sources sources;
  Diagnostics diagnostics;
  syntax::Symbols symbols;
  scene::Scene scene;

  std::string messages() const { return render_text(diagnostics, sources, false); }
};

// Resolves a text read under `name`; look at the messages.
inline Resolved resolve_text(const std::string& text, const resolve::Options& options = {},
                             const std::string& name = "test.tyn") {
  Resolved r;
  const SourceId source = r.sources.add(name, text);
  const syntax::TokenList tokens = syntax::lex(r.sources, source, r.diagnostics);
  const syntax::SyntaxTree tree = syntax::parse(r.sources, source, tokens, r.symbols, r.diagnostics);
  r.scene = resolve::resolve(tree, r.sources, r.symbols, options, r.diagnostics);
  return r;
}

// What every scene needs, on a line of its own.
inline const std::string camera_and_light =
    "camera perspective { from: (0, 0, 5) to: (0, 0, 0) } light environment { radiance: 1 }\n";

// Resolves a text after camera_and_light; any message is a failure, but that the camera is inside of a thing:
// what is made here is not looked at.
inline Resolved resolve_clean(const std::string& text, const resolve::Options& options = {}) {
  Resolved r = resolve_text(camera_and_light + text, options);
  for (const Diagnostic& d : r.diagnostics.all())
    EXPECT_TRUE(d.message.starts_with("the camera is inside an opaque shape")) << r.messages();
  return r;
}

inline void expect_near(const Vec3d& found, const Vec3d& wanted, double tolerance = 1e-12) {
  EXPECT_NEAR(found.x, wanted.x, tolerance);
  EXPECT_NEAR(found.y, wanted.y, tolerance);
  EXPECT_NEAR(found.z, wanted.z, tolerance);
}

inline void expect_near(const Transform& found, const Transform& wanted, double tolerance = 1e-12) {
  expect_near(found.x, wanted.x, tolerance);
  expect_near(found.y, wanted.y, tolerance);
  expect_near(found.z, wanted.z, tolerance);
  expect_near(found.t, wanted.t, tolerance);
}

}  // namespace tyndall
