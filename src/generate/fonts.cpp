#include "generate/fonts.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace tyndall::generate {

namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// By their paths.
std::vector<fs::path> found_fonts() {
  std::vector<fs::path> fonts;
  for (const char* folder : {"/usr/share/fonts", "/usr/local/share/fonts"}) {
    std::error_code ignored;
    const auto any = fs::directory_options::skip_permission_denied;
    for (fs::recursive_directory_iterator file(folder, any, ignored), end; file != end;
         file.increment(ignored)) {
      const std::string ending = lower(file->path().extension().string());
      if (ending == ".ttf" || ending == ".otf") fonts.push_back(file->path());
    }
  }
  std::sort(fonts.begin(), fonts.end());
  return fonts;
}

// They are looked for once.
const std::vector<fs::path>& fonts() {
  static const std::vector<fs::path> all = found_fonts();
  return all;
}

}  // namespace

fs::path system_font(std::string_view name) {
  const std::string wanted = lower(std::string(name));
  const auto font = std::find_if(fonts().begin(), fonts().end(),
                                 [&](const fs::path& path) { return lower(path.stem().string()) == wanted; });
  return font == fonts().end() ? fs::path() : *font;
}

fs::path standard_font() {
  for (const std::string_view name : {"DejaVuSans", "LiberationSans-Regular", "NotoSans-Regular"})
    if (const fs::path font = system_font(name); !font.empty()) return font;
  return fonts().empty() ? fs::path() : fonts().front();
}

}  // namespace tyndall::generate
