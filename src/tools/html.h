// Pieces of pages that need no other file.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tyndall::tools {

// RFC 4648.
std::string base64(std::span<const unsigned char> bytes);

// The text as HTML and XML write it, between tags and in quoted attributes. What XML does not have, control
// characters and bytes that are no UTF-8, are question marks.
std::string escaped_text(std::string_view text);

}  // namespace tyndall::tools
