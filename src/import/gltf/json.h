// Values of a glTF file's JSON that know where they stand, so that every complaint names its element.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "base/vec.h"

namespace tyndall::gltf {

// Refers to a value of the document, which must stay. Reading what is not there, or of another type, throws
// Malformed.
class Element {
 public:
  Element(const nlohmann::json& value, std::string path) : value_(&value), path_(std::move(path)) {}

  const std::string& path() const { return path_; }
  const nlohmann::json& json() const { return *value_; }
  [[noreturn]] void fail(std::string reason) const;

  // Of an object.
  std::optional<Element> find(std::string_view key) const;
  Element operator[](std::string_view key) const;
  // Of an object's `extensions`.
  std::optional<Element> extension(std::string_view name) const;
  // Of a list.
  std::size_t size() const;
  Element at(std::size_t i) const;

  double number() const;                                              // finite
  std::uint64_t count() const;                                        // a whole number from 0, below 2^53
  std::uint32_t index(std::size_t end, std::string_view what) const;  // a count below `end`
  bool flag() const;
  const std::string& text() const;
  template <std::size_t n>
  std::array<double, n> numbers() const {
    std::array<double, n> out;
    expect_numbers(out.data(), n);
    return out;
  }
  Vec3d vec() const {
    const auto [x, y, z] = numbers<3>();
    return {x, y, z};
  }

  // Of an object's value, or what stands for it where it is not given.
  double number(std::string_view key, double standard) const;
  std::uint64_t count(std::string_view key, std::uint64_t standard) const;
  bool flag(std::string_view key, bool standard) const;
  std::string text(std::string_view key, std::string_view standard = {}) const;
  Vec3d vec(std::string_view key, const Vec3d& standard) const;

 private:
  void expect_numbers(double* to, std::size_t n) const;

  const nlohmann::json* value_;
  std::string path_;
};

}  // namespace tyndall::gltf
