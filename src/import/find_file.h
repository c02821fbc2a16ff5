// How importers ask for files that a file names, without knowing which it may.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace tyndall {

// Where a file stands that another one names; nothing, with the reason in `why` as the rest of a sentence,
// where there is none or it may not be read.
using FindFile =
    std::function<std::optional<std::filesystem::path>(const std::string& name, std::string& why)>;

}  // namespace tyndall
