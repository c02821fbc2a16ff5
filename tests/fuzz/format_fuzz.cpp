// Any text that can be read is formatted to the same tree, and the second time to the same text.
#include "base/check.h"
#include "input.h"
#include "syntax/format.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tyndall;
  fuzz::Input before(data, size);
  before.parse();
  if (before.diagnostics.has_errors()) return 0;
  const std::string once = syntax::format(before.sources, before.source, before.tokens, before.tree);
  fuzz::Input after(reinterpret_cast<const std::uint8_t*>(once.data()), once.size());
  after.parse();
  CHECK(!after.diagnostics.has_errors());
  CHECK_EQ(syntax::print(after.tree, after.symbols), syntax::print(before.tree, before.symbols));
  CHECK_EQ(after.tokens.comments.size(), before.tokens.comments.size());
  CHECK_EQ(syntax::format(after.sources, after.source, after.tokens, after.tree), once);
  return 0;
}
