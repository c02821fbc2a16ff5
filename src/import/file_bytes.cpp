#include "import/file_bytes.h"

#include <fstream>

#include "import/malformed.h"

namespace tyndall {

std::vector<std::byte> read_file_bytes(const std::filesystem::path& path) {
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (!std::filesystem::exists(status)) throw Malformed{"", "is not there"};
  // Pipes and devices may never end.
  if (!std::filesystem::is_regular_file(status)) throw Malformed{"", "is no plain file"};
  const std::uintmax_t size = std::filesystem::file_size(path, failed);
  std::ifstream file(path, std::ios::binary);
  if (failed || !file) throw Malformed{"", "cannot be opened"};
  std::vector<std::byte> bytes(size);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(file.gcount()) != size) throw Malformed{"", "cannot be read to its end"};
  return bytes;
}

}  // namespace tyndall
