// Any bytes at all through every stage of the text: what comes out without an error obeys the laws of
// programs.
#include "base/check.h"
#include "input.h"
#include "resolve/resolve.h"
#include "vm/program/program.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tyndall;
  resolve::Options few_rounds;
  few_rounds.max_repetitions = 2000;  // a mutation is not to run for minutes
  fuzz::Input input(data, size);
  input.parse();
  if (input.includes()) return 0;
  const scene::Scene scene =
      resolve::resolve(input.tree, input.sources, input.symbols, few_rounds, input.diagnostics);
  render_text(input.diagnostics, input.sources, true);
  if (input.diagnostics.has_errors()) return 0;
  scene::print(scene);
  for (const scene::Medium& medium : scene.media) {
    CHECK_EQ(vm::verify(medium.full), std::string());
    CHECK_EQ(vm::verify(medium.extinction), std::string());
  }
  for (const scene::Material& material : scene.materials)
    CHECK_EQ(vm::verify(material.program), std::string());
  return 0;
}
