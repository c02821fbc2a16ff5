// Texts that are equal for equal values, and only for those: by them bodies are compiled once.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>

#include "eval/value.h"

namespace tyndall::eval {

// Keys of one run. Long contents are numbered: a list that a hundred bodies see, or that holds another one
// many times, is gone through once.
class Keys {
 public:
  // Appends the value's key.
  void append(std::string& key, const Value& value);
  // The key itself if it is short, else a number that stands for it.
  std::string shortened(std::string key);

 private:
  struct Known {
    std::weak_ptr<const Heavy> place;  // keeps the address from being used again, and nothing else
    std::string key;
  };
  void append_content(std::string& key, const Value& value);

  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::unordered_map<const Heavy*, Known> known_;
};

}  // namespace tyndall::eval
