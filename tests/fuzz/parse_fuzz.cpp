// Any bytes at all: the parser ends, and gives a tree that can be printed.
#include "input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tyndall;
  fuzz::Input input(data, size);
  input.parse();
  syntax::print(input.tree, input.symbols);
  render_text(input.diagnostics, input.sources, true);
  return 0;
}
