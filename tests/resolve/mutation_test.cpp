// Broken scenes: whatever a scene is turned into, resolving it ends, and what is no scene has an error.
#include <fstream>
#include <random>
#include <sstream>

#include "resolved.h"

namespace tyndall {
namespace UNNAMED {

// The words of a scene that uses everything, comments left out.
std::vector<std::string> words_of_a_scene() {
  std::ifstream file(TYNDALL_SOURCE_DIR "/tests/language/correct.tyn");
  std::vector<std::string> words;
  for (std::string line; std::getline(file, line);) {
    line = line.substr(0, line.find("//"));
    std::string word;
    for (const char c : line + " ") {
      const bool joins = std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.' || c == '#';
      if (joins) {
        word += c;
        continue;
      }
      if (!word.empty()) words.push_back(std::exchange(word, {}));
      if (c != ' ') words.emplace_back(1, c);
    }
  }
  return words;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += word + " ";
  return text;
}

TEST(Mutations, WordsLeftOutDoubledAndExchangedNeverCrash) {
  const std::vector<std::string> original = words_of_a_scene();
  ASSERT_GT(original.size(), 500u);
  std::mt19937 random(20240607);
  const auto pick = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  int broken = 0;
  for (int round = 0; round < 400; ++round) {
    std::vector<std::string> words = original;
    for (std::size_t changes = 1 + pick(3); changes > 0; --changes) {
      const std::size_t at = pick(words.size());
      const auto place = words.begin() + static_cast<std::ptrdiff_t>(at);
      switch (pick(3)) {
        case 0:
          words.erase(place);
          break;
        case 1:
          words.insert(place, words[at]);
          break;
        case 2:
          words[at] = original[pick(original.size())];
          break;
      }
    }
    const Resolved r = resolve_text(joined(words));
    broken += r.diagnostics.has_errors();
    for (const Diagnostic& d : r.diagnostics.all()) EXPECT_TRUE(d.span.valid()) << d.message;
  }
  // Most such changes are mistakes; were none found, the test would not read what it thinks.
  EXPECT_GT(broken, 200);
}

// A broken scene may lack things, but what there is can be printed: ids point at what is there.
TEST(Mutations, WhatWasReadIsWhole) {
  const std::vector<std::string> original = words_of_a_scene();
  for (std::size_t keep = 0; keep < original.size(); keep += 7) {
    const Resolved r =
        resolve_text(joined({original.begin(), original.begin() + static_cast<std::ptrdiff_t>(keep)}));
    for (const scene::ShapeInstance& shape : r.scene.shapes)
      EXPECT_LT(shape.material.index, r.scene.materials.size());
    for (const scene::Volume& volume : r.scene.volumes) EXPECT_LT(volume.medium.index, r.scene.media.size());
    EXPECT_FALSE(scene::print(r.scene).empty());
  }
}

}  // namespace
}  // namespace tyndall
