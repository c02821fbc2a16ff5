// The fonts of the system.
#pragma once

#include <filesystem>
#include <string_view>

namespace tyndall::generate {

// The file of that name without its ending, whatever the case; empty: there is none.
std::filesystem::path system_font(std::string_view name);
// A sans-serif one: the same one for the same fonts. Empty: there is none at all.
std::filesystem::path standard_font();

}  // namespace tyndall::generate
