// Scenes of tests that differ in a few words: written whole, with `$NAME` where something is filled in.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace tyndall::support {

// What stands for `$name`, a name of capitals: text, or a number with all its digits.
struct Word {
  std::string_view name;
  std::string text;

  Word(std::string_view word, std::string value) : name(word), text(std::move(value)) {}
  template <class Number>
  requires std::is_arithmetic_v<Number> Word(std::string_view word, Number value)
      : name(word), text(fmt::format("{}", value)) {}
};

// Appends `form` with text_of(NAME) for each `$NAME` in it.
template <class TextOf>
void append_filled(std::string& out, std::string_view form, TextOf&& text_of) {
  while (true) {
    const std::size_t mark = form.find('$');
    out += form.substr(0, mark);
    if (mark == std::string_view::npos) return;
    form.remove_prefix(mark + 1);
    const auto end = std::find_if(form.begin(), form.end(), [](char c) { return c < 'A' || c > 'Z'; });
    const auto length = static_cast<std::size_t>(end - form.begin());
    fmt::format_to(std::back_inserter(out), "{}", text_of(form.substr(0, length)));
    form.remove_prefix(length);
  }
}

// `form` with its words filled in, all of them; none is given that does not stand in it.
inline std::string filled(std::string_view form, std::initializer_list<Word> words) {
  std::string out;
  std::vector<bool> stands(words.size());
  append_filled(out, form, [&](std::string_view name) -> const std::string& {
    const auto word = std::find_if(words.begin(), words.end(), [&](const Word& w) { return w.name == name; });
    if (word == words.end())
      throw std::invalid_argument(fmt::format("nothing is given for ${} in {}", name, form));
    stands[static_cast<std::size_t>(word - words.begin())] = true;
    return word->text;
  });
  const auto missing = std::find(stands.begin(), stands.end(), false);
  if (missing != stands.end())
    throw std::invalid_argument(
        fmt::format("${} does not stand in {}", words.begin()[missing - stands.begin()].name, form));
  return out;
}

// The text this many times.
inline std::string repeated(std::string_view text, std::int64_t times) {
  std::string out;
  for (std::int64_t i = 0; i < times; ++i) out += text;
  return out;
}

// A form once for each number from `first` to `last`, which is `$I` in it; the one before is `$BEFORE`.
inline std::string numbered(std::string_view form, std::int64_t last, std::int64_t first = 1) {
  std::string out;
  for (std::int64_t i = first; i <= last; ++i)
    append_filled(out, form, [&](std::string_view name) {
      if (name != "I" && name != "BEFORE")
        throw std::invalid_argument(fmt::format("${} in a numbered form", name));
      return name == "I" ? i : i - 1;
    });
  return out;
}

}  // namespace tyndall::support
