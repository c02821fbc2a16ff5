// Any bytes at all: words and comments stand in order, without overlap, inside the text.
#include "base/check.h"
#include "input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tyndall;
  const fuzz::Input input(data, size);
  std::uint32_t end = 0;
  for (const syntax::Token& token : input.tokens.tokens) {
    CHECK_LE(end, token.span.begin);
    CHECK_LE(token.span.begin, token.span.end);
    end = token.span.end;
  }
  CHECK_EQ(std::size_t{end}, size);
  CHECK(input.tokens.tokens.back().kind == syntax::TokenKind::end_of_file);
  end = 0;
  for (const Span& comment : input.tokens.comments) {
    CHECK_LE(end, comment.begin);
    CHECK_LT(comment.begin, comment.end);
    end = comment.end;
  }
  CHECK_LE(std::size_t{end}, size);
  syntax::print(input.tokens, input.sources);
  render_text(input.diagnostics, input.sources, true);
  return 0;
}
