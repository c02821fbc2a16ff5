// What a glTF file names its buffers and images by: data in the text itself, or other files.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall::gltf {

bool is_data_uri(std::string_view uri);
// The bytes of "data:…;base64,…"; nothing with the reason in `why`.
std::optional<std::vector<std::byte>> decoded_data_uri(std::string_view uri, std::string& why);
// The relative path that a URI spells, its %20 and the like written out; nothing for "http:" and its like.
std::optional<std::string> decoded_uri(std::string_view uri, std::string& why);

}  // namespace tyndall::gltf
