// What importers throw at a file that is not as its format has it. Caught where a file is opened or read,
// never above this layer.
#pragma once

#include <string>
#include <utility>

namespace tyndall {

struct Malformed {
  std::string element;  // "nodes[3].mesh"; empty: the file itself
  std::string reason;   // what is wrong, as the rest of a sentence: "is 7, but there are 2"
};

// Why something was not read, for messages; `file` is its name alone.
inline std::string describe(const Malformed& m, const std::string& file) {
  return m.element.empty() ? "'" + file + "' " + m.reason : "'" + file + "': " + m.element + " " + m.reason;
}

}  // namespace tyndall
