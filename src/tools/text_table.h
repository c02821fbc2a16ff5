// Tables as text, and as lines of CSV.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tyndall::tools {

using TextRow = std::vector<std::string>;

// A line for each row, columns as wide as their widest cell; the first one is flush left, the others right.
std::string text_table(const std::vector<TextRow>& rows);

// A field of RFC 4180.
std::string csv_field(const std::string& text);
// Empty where it is infinite or not a number: what reads CSV does not agree on those.
std::string csv_number(double value);

}  // namespace tyndall::tools
