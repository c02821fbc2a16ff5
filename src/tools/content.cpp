#include "tools/content.h"

#include <sys/stat.h>

#include <cstddef>
#include <fstream>
#include <map>
#include <mutex>
#include <span>
#include <tuple>
#include <vector>

#include "base/content_hash.h"
#include "tools/view_options.h"

namespace tyndall::tools {

namespace {

std::string read_and_hash(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return {};
  ContentHash hash;
  std::vector<char> buffer(std::size_t{1} << 20);
  while (file.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || file.gcount() > 0)
    hash.add(std::as_bytes(std::span(buffer.data(), static_cast<std::size_t>(file.gcount()))));
  return file.bad() ? std::string() : hash.text();
}

// The parameters of cameras that say how their pictures are shown, found in the words of a scene.
class ViewWords {
 public:
  ViewWords(const syntax::TokenList& tokens, const Sources& sources) : tokens_(tokens), sources_(sources) {}

  std::vector<bool> find() {
    std::vector<bool> found(tokens_.tokens.size());
    int depth = 0, camera_depth = 0;  // of braces; 0: in no camera
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (kind(i) == Kind::left_brace && ++depth && camera_depth == 0 && is_camera(i)) camera_depth = depth;
      if (kind(i) == Kind::right_brace && depth-- == camera_depth) camera_depth = 0;
      if (camera_depth == 0 || depth != camera_depth || !is_parameter(i)) continue;
      if (!is_view_setting(text(i))) continue;
      const std::size_t end = end_of_plain_value(i + 2);
      for (std::size_t k = i; k < end; ++k) found[k] = true;
      if (end > 0 && kind(end) == Kind::comma) found[end] = true;
    }
    return found;
  }

 private:
  using Kind = syntax::TokenKind;

  Kind kind(std::size_t i) const {
    return i < tokens_.tokens.size() ? tokens_.tokens[i].kind : Kind::end_of_file;
  }
  std::string_view text(std::size_t i) const {
    return i < tokens_.tokens.size() ? sources_.text(tokens_.tokens[i].span) : std::string_view();
  }
  bool is_parameter(std::size_t i) const { return syntax::is_word(kind(i)) && kind(i + 1) == Kind::colon; }
  // Whether the brace begins one: camera KIND {, camera gltf "file" {.
  bool is_camera(std::size_t brace) const {
    for (std::size_t back = 2; back <= 3 && back <= brace; ++back)
      if (text(brace - back) == "camera") return true;
    return false;
  }
  std::size_t after_number(std::size_t i) const {
    if (kind(i) == Kind::minus) ++i;
    return kind(i) == Kind::number ? i + 1 : 0;
  }
  // 0: it may depend on anything.
  std::size_t end_of_plain_value(std::size_t i) const {
    std::size_t end = after_number(i);
    if (text(i) == "auto" && kind(i + 1) == Kind::left_paren) {
      end = after_number(i + 2);
      end = kind(end) == Kind::right_paren ? end + 1 : 0;
    } else if (text(i) == "auto" || image::read_tonemap(text(i))) {
      end = i + 1;
    }
    return kind(end) == Kind::comma || kind(end) == Kind::right_brace || is_parameter(end) ? end : 0;
  }

  const syntax::TokenList& tokens_;
  const Sources& sources_;
};

}  // namespace

std::string hash_of_text(std::string_view text) {
  ContentHash hash;
  hash.add(text);
  return hash.text();
}

// Whether a word is the first of its line is part of it: some ends of items are told by that.
WordsHashes hash_of_words(const syntax::TokenList& tokens, const Sources& sources) {
  const std::vector<bool> is_view = ViewWords(tokens, sources).find();
  ContentHash light, view;
  std::uint32_t last_end = 0;
  bool any_view = false;
  for (std::size_t i = 0; i < tokens.tokens.size(); ++i) {
    const syntax::Token& token = tokens.tokens[i];
    if (token.kind == syntax::TokenKind::end_of_file) break;
    const std::string_view text = sources.text(token.span);
    if (is_view[i]) {
      any_view = true;
      view.add(" ");
      view.add(text);
      continue;
    }
    const Source& source = sources[token.span.source];
    const std::string_view between = source.text().substr(last_end, token.span.begin - last_end);
    light.add(between.find('\n') == std::string_view::npos ? " " : "\n");
    light.add(text);
    last_end = token.span.end;
  }
  return {light.text(), any_view ? view.text() : std::string()};
}

std::string hash_of_file(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  static std::mutex mutex;
  static std::map<std::tuple<dev_t, ino_t, off_t, std::time_t, long>, std::string> known;
  const std::scoped_lock lock(mutex);
  std::string& hash =
      known[{status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec}];
  if (hash.empty()) hash = read_and_hash(path);
  return hash;
}

}  // namespace tyndall::tools
