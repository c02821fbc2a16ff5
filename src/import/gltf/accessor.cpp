#include "import/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

#include "import/gltf/component.h"

namespace tyndall::gltf {

namespace {

int width_of_type(const Element& type) {
  struct Row {
    std::string_view name;
    int width;
  };
  static constexpr std::array<Row, 7> rows{
      {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};
  for (const Row& row : rows)
    if (row.name == type.text()) return row.width;
  type.fail(fmt::format("is '{}', which is none of glTF's", type.text()));
}

// Elements in a buffer view, checked to lie in it.
struct Elements {
  const std::byte* first = nullptr;
  std::size_t stride = 0;
};

Elements elements_in(Document& document, const Element& holder, std::size_t count,
                     std::size_t element_bytes) {
  const std::uint32_t index = holder["bufferView"].index(document.count("bufferViews"), "bufferViews");
  const Bytes bytes = document.view(index);
  const std::uint64_t offset = holder.count("byteOffset", 0);
  const Element view = document.item("bufferViews", index);
  const std::uint64_t stride = view.count("byteStride", element_bytes);
  if (stride < element_bytes || stride > 256)
    view["byteStride"].fail(fmt::format("is {} where elements have {} bytes", stride, element_bytes));
  const bool fits = offset <= bytes.size() &&
                    (count == 0 || (element_bytes <= bytes.size() - offset &&
                                    count - 1 <= (bytes.size() - offset - element_bytes) / stride));
  if (!fits)
    holder.fail(fmt::format("takes {} elements of {} bytes from byte {} on of bufferViews[{}], which has {}",
                            count, stride, offset, index, bytes.size()));
  return {bytes.data() + offset, stride};
}

// Calls number(i, k, value) for component k of element i, twice for those that sparse ones replace.
class Reader {
 public:
  Reader(Document& document, std::uint32_t index, int width)
      : document_(document),
        accessor_(document.item("accessors", index)),
        width_(static_cast<std::size_t>(width)),
        count_(accessor_["count"].count()),
        component_(component_of(accessor_["componentType"])),
        normalized_(accessor_.flag("normalized", false)) {
    const int own = width_of_type(accessor_["type"]);
    if (own != width) accessor_["type"].fail(fmt::format("has {} numbers where {} are wanted", own, width));
    constexpr std::size_t most_without_bytes = 1 << 24;
    if (!accessor_.find("bufferView") && count_ > most_without_bytes)
      accessor_["count"].fail(
          fmt::format("is {}: without a bufferView it may be {}", count_, most_without_bytes));
  }
  std::size_t count() const { return count_; }
  const Component& component() const { return component_; }
  const Element& accessor() const { return accessor_; }

  template <class T>
  std::vector<T> read() {
    // Nothing is taken before the bytes are known to be there.
    std::optional<Elements> stored;
    if (accessor_.find("bufferView")) stored = elements_in(document_, accessor_, count_, element_bytes());
    document_.take(accessor_, static_cast<double>(count_ * width_ * sizeof(T)));
    std::vector<T> out(count_ * width_);
    if (stored)
      for (std::size_t i = 0; i < count_; ++i)
        read_element(stored->first + i * stored->stride, &out[i * width_]);
    if (const auto sparse = accessor_.find("sparse")) replace(*sparse, out);
    return out;
  }

 private:
  std::size_t element_bytes() const { return width_ * component_.bytes; }
  void read_element(const std::byte* from, float* to) const {
    for (std::size_t k = 0; k < width_; ++k)
      to[k] = component_.read(from + k * component_.bytes, normalized_);
  }
  void read_element(const std::byte* from, std::uint32_t* to) const {
    for (std::size_t k = 0; k < width_; ++k) to[k] = component_.read_count(from + k * component_.bytes);
  }

  template <class T>
  void replace(const Element& sparse, std::vector<T>& out) {
    const std::uint64_t replaced = sparse["count"].count();
    if (replaced > count_) sparse["count"].fail(fmt::format("is {} of {} elements", replaced, count_));
    const Element indices = sparse["indices"], values = sparse["values"];
    const Component index_type = component_of(indices["componentType"]);
    if (!index_type.is_count()) indices["componentType"].fail("is no type of indices");
    const Elements places = elements_in(document_, indices, replaced, index_type.bytes);
    const Elements elements = elements_in(document_, values, replaced, element_bytes());
    for (std::size_t i = 0; i < replaced; ++i) {
      const std::uint32_t place = index_type.read_count(places.first + i * places.stride);
      if (place >= count_)
        indices.fail(fmt::format("has {} at {}, but there are {} elements", place, i, count_));
      read_element(elements.first + i * elements.stride, &out[place * width_]);
    }
  }

  Document& document_;
  Element accessor_;
  std::size_t width_, count_;
  Component component_;
  bool normalized_;
};

}  // namespace

std::size_t count_of(const Document& document, std::uint32_t accessor) {
  return document.item("accessors", accessor)["count"].count();
}

int width_of(const Document& document, std::uint32_t accessor) {
  return width_of_type(document.item("accessors", accessor)["type"]);
}

std::vector<float> read_floats(Document& document, std::uint32_t accessor, int width) {
  Reader reader(document, accessor, width);
  std::vector<float> out = reader.read<float>();
  const auto bad = std::find_if(out.begin(), out.end(), [](float f) { return !std::isfinite(f); });
  if (bad != out.end())
    reader.accessor().fail(fmt::format("holds {} in element {}", *bad, (bad - out.begin()) / width));
  return out;
}

std::vector<std::uint32_t> read_counts(Document& document, std::uint32_t accessor, int width) {
  Reader reader(document, accessor, width);
  if (!reader.component().is_count()) reader.accessor()["componentType"].fail("is no type of indices");
  return reader.read<std::uint32_t>();
}

std::vector<Vec3d> read_vecs(Document& document, std::uint32_t accessor) {
  const std::vector<float> floats = read_floats(document, accessor, 3);
  std::vector<Vec3d> out(floats.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = {double{floats[3 * i]}, double{floats[3 * i + 1]}, double{floats[3 * i + 2]}};
  return out;
}

std::vector<Transform> read_matrices(Document& document, std::uint32_t accessor) {
  const std::vector<float> floats = read_floats(document, accessor, 16);
  std::vector<Transform> out(floats.size() / 16);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const float* const m = &floats[16 * i];  // by columns
    const auto column = [&](std::size_t c) { return Vec3d(Vec3f(m[4 * c], m[4 * c + 1], m[4 * c + 2])); };
    out[i] = {column(0), column(1), column(2), column(3)};
  }
  return out;
}

}  // namespace tyndall::gltf
