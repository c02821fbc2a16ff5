#include "import/gltf/json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "import/malformed.h"

namespace tyndall::gltf {

namespace {

std::string below(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

}  // namespace

void Element::fail(std::string reason) const { throw Malformed{path_, std::move(reason)}; }

std::optional<Element> Element::find(std::string_view key) const {
  if (!value_->is_object()) fail(fmt::format("is no object but {}", value_->type_name()));
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return Element(*found, below(path_, key));
}

Element Element::operator[](std::string_view key) const {
  const auto found = find(key);
  if (!found) throw Malformed{below(path_, key), "is missing"};
  return *found;
}

std::optional<Element> Element::extension(std::string_view name) const {
  const auto extensions = find("extensions");
  return extensions ? extensions->find(name) : std::nullopt;
}

std::size_t Element::size() const {
  if (!value_->is_array()) fail(fmt::format("is no list but {}", value_->type_name()));
  return value_->size();
}

Element Element::at(std::size_t i) const {
  if (i >= size()) fail(fmt::format("has {} parts, where more are wanted", size()));
  return Element((*value_)[i], fmt::format("{}[{}]", path_, i));
}

double Element::number() const {
  if (!value_->is_number()) fail(fmt::format("is no number but {}", value_->type_name()));
  const double number = value_->get<double>();
  if (!std::isfinite(number)) fail("is not finite");
  return number;
}

std::uint64_t Element::count() const {
  constexpr double end = 9007199254740992;  // 2^53: doubles hold every whole number below
  const double n = number();
  if (!(n >= 0 && n < end && n == std::floor(n)))
    fail(fmt::format("must be a whole number from 0, found {}", n));
  return static_cast<std::uint64_t>(n);
}

std::uint32_t Element::index(std::size_t end, std::string_view what) const {
  const std::uint64_t i = count();
  if (i >= end) fail(fmt::format("is {}, but the file has {} {}", i, end, what));
  return static_cast<std::uint32_t>(i);
}

bool Element::flag() const {
  if (!value_->is_boolean()) fail(fmt::format("is no boolean but {}", value_->type_name()));
  return value_->get<bool>();
}

const std::string& Element::text() const {
  if (!value_->is_string()) fail(fmt::format("is no string but {}", value_->type_name()));
  return value_->get_ref<const std::string&>();
}

void Element::expect_numbers(double* to, std::size_t n) const {
  if (size() != n) fail(fmt::format("must have {} numbers, found {}", n, size()));
  for (std::size_t i = 0; i < n; ++i) to[i] = at(i).number();
}

double Element::number(std::string_view key, double standard) const {
  const auto found = find(key);
  return found ? found->number() : standard;
}

std::uint64_t Element::count(std::string_view key, std::uint64_t standard) const {
  const auto found = find(key);
  return found ? found->count() : standard;
}

bool Element::flag(std::string_view key, bool standard) const {
  const auto found = find(key);
  return found ? found->flag() : standard;
}

std::string Element::text(std::string_view key, std::string_view standard) const {
  const auto found = find(key);
  return found ? found->text() : std::string(standard);
}

Vec3d Element::vec(std::string_view key, const Vec3d& standard) const {
  const auto found = find(key);
  return found ? found->vec() : standard;
}

}  // namespace tyndall::gltf
