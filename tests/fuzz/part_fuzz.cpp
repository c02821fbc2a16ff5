// Any bytes at all as the file of a part: what is read is a film of the size that it tells.
#include <sstream>

#include "base/check.h"
#include "render/film/part_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tyndall;
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  const render::PartResult result = render::read_part(in, size);
  CHECK(result.part.has_value() == result.error.empty());
  if (result.part) result.part->film.image();
  return 0;
}
