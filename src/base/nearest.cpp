// "Did you mean": the known word nearest to a mistyped one.
#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "base/diagnostics.h"

namespace tyndall {

namespace {

constexpr std::size_t longest_word = 64;  // longer words are nobody's typing mistake
constexpr std::size_t shortest_beginning =
    3;  // letters of a word that may stand for its rest: 'pos', 'position'

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

// Insertions, deletions, replacements and swaps of neighbours that turn a into b ("optimal string
// alignment").
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

// The text with each run of one letter as a single one: what a stuck or skipped key leaves unchanged.
std::string without_doubles(std::string text) {
  text.erase(std::unique(text.begin(), text.end()), text.end());
  return text;
}

// True if the words differ by what a hand does wrong, not by their letters: a key that is stuck or skipped
// where it comes twice, two keys in the wrong order.
bool is_slip(const std::string& a, const std::string& b) {
  if (without_doubles(a) == without_doubles(b)) return true;
  std::string x = a, y = b;
  std::sort(x.begin(), x.end());
  std::sort(y.begin(), y.end());
  return x == y && edit_distance(a, b) == 1;
}

// Whether a word at that distance may have been meant. One letter in three may be wrong; but words of up to
// three letters are all alike (mie, min, sin, sign, pi, i): there only a slip is one.
bool may_be_meant(const std::string& wanted, const std::string& known, std::size_t distance) {
  constexpr std::size_t short_word = 3;
  if (std::min(wanted.size(), known.size()) <= short_word) return distance <= 1 && is_slip(wanted, known);
  return distance <= std::max(wanted.size(), known.size()) / 3;
}

}  // namespace

std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates) {
  if (word.empty() || word.size() > longest_word) return {};
  const std::string wanted = lower(word);
  std::string_view best;
  constexpr std::size_t far = std::numeric_limits<std::size_t>::max();
  // Letters that differ, whether more than doubled ones do ('pp' is 'p' rather than 'up'), then those that
  // differ in case too: 'P' is nearer to 'PP' than 'p' is.
  using Distance = std::tuple<std::size_t, bool, std::size_t>;
  Distance best_distance{far, true, far};
  for (const std::string_view candidate : candidates) {
    if (candidate == word || candidate.size() > longest_word) continue;
    const std::string known = lower(candidate);
    std::size_t distance = edit_distance(wanted, known);
    if (!may_be_meant(wanted, known, distance)) {
      if (wanted.size() < shortest_beginning || !known.starts_with(wanted)) continue;
      distance = longest_word + known.size();  // a beginning: only when nothing is alike
    }
    if (distance > std::get<0>(best_distance)) continue;
    const Distance whole{distance, without_doubles(wanted) != without_doubles(known),
                         edit_distance(word, candidate)};
    if (whole < best_distance) {
      best = candidate;
      best_distance = whole;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates) {
  const std::string_view best = nearest(word, candidates);
  return best.empty() ? std::string() : "did you mean '" + std::string(best) + "'?";
}

}  // namespace tyndall
