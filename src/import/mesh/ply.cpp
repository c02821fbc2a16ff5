// Stanford's polygon format: text, or binary of either byte order. Faces of any number of corners become
// fans.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

#include "import/malformed.h"
#include "import/mesh/mesh_file.h"

namespace tyndall::mesh_file {

namespace {

enum class Type : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class Order : std::uint8_t { text, little, big };

struct Property {
  std::string name;
  Type type{};
  std::optional<Type> count_type{};  // of lists
};
struct ElementKind {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};
struct Header {
  Order order{};
  std::vector<ElementKind> kinds;
  std::size_t end = 0;  // where the data begins
};

struct TypeRow {
  std::string_view name, other_name;
  std::size_t bytes;
};
constexpr std::array<TypeRow, 8> types{{{"char", "int8", 1},
                                        {"uchar", "uint8", 1},
                                        {"short", "int16", 2},
                                        {"ushort", "uint16", 2},
                                        {"int", "int32", 4},
                                        {"uint", "uint32", 4},
                                        {"float", "float32", 4},
                                        {"double", "float64", 8}}};
std::size_t bytes_of(Type type) { return types[static_cast<std::size_t>(type)].bytes; }

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> out;
  while (true) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return out;
    const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
    out.push_back(line.substr(begin, end - begin));
    line.remove_prefix(end);
  }
}

class HeaderReader {
 public:
  explicit HeaderReader(std::string_view text) : text_(text) {}

  Header read() {
    if (next() != "ply") throw Malformed{"", "is no PLY: it does not begin with 'ply'"};
    bool has_format = false;
    while (true) {
      const std::vector<std::string_view> words = words_of(next());
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format") {
        read_format(words);
        has_format = true;
      } else if (words[0] == "element") {
        read_element(words);
      } else if (words[0] == "property") {
        read_property(words);
      } else {
        fail(fmt::format("has '{}', which PLY does not know", words[0]));
      }
    }
    if (!has_format) fail("names no format");
    header_.end = at_;
    return header_;
  }

 private:
  [[noreturn]] void fail(std::string reason) const {
    throw Malformed{fmt::format("line {}", line_), std::move(reason)};
  }

  std::string_view next() {
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string_view::npos) throw Malformed{"", "ends within its header"};
    ++line_;
    std::string_view line = text_.substr(at_, end - at_);
    at_ = end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }
  void read_format(const std::vector<std::string_view>& words) {
    constexpr std::array<std::string_view, 3> orders{"ascii", "binary_little_endian", "binary_big_endian"};
    const auto found = words.size() > 1 ? std::find(orders.begin(), orders.end(), words[1]) : orders.end();
    if (found == orders.end()) fail("names a format that PLY does not know");
    header_.order = static_cast<Order>(found - orders.begin());
  }
  void read_element(const std::vector<std::string_view>& words) {
    ElementKind kind;
    if (words.size() != 3) fail("is no 'element name count'");
    kind.name = words[1];
    const auto [end, error] = std::from_chars(words[2].data(), words[2].data() + words[2].size(), kind.count);
    if (error != std::errc{} || end != words[2].data() + words[2].size())
      fail(fmt::format("has the count '{}'", words[2]));
    header_.kinds.push_back(std::move(kind));
  }
  Type type_of(std::string_view word) const {
    for (std::size_t i = 0; i < types.size(); ++i)
      if (types[i].name == word || types[i].other_name == word) return static_cast<Type>(i);
    fail(fmt::format("has the type '{}', which PLY does not know", word));
  }
  void read_property(const std::vector<std::string_view>& words) {
    if (header_.kinds.empty()) fail("has a property before any element");
    const bool list = words.size() == 5 && words[1] == "list";
    if (!list && words.size() != 3) fail("is no 'property type name'");
    Property property{std::string(words.back()), type_of(words[list ? 3 : 1]), {}};
    if (list) property.count_type = type_of(words[2]);
    header_.kinds.back().properties.push_back(std::move(property));
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 0;
  Header header_;
};

// The numbers behind the header, in order.
class Numbers {
 public:
  Numbers(std::string_view data, Order order) : data_(data), order_(order) {}

  std::size_t left() const { return data_.size() - at_; }
  double next(Type type) { return order_ == Order::text ? next_text() : next_binary(type); }

 private:
  [[noreturn]] static void ends() { throw Malformed{"", "ends before all that its header promises"}; }

  double next_text() {
    while (at_ < data_.size() && static_cast<unsigned char>(data_[at_]) <= ' ') ++at_;
    if (at_ == data_.size()) ends();
    double value = 0;
    const auto [end, error] = std::from_chars(data_.data() + at_, data_.data() + data_.size(), value);
    if (error != std::errc{}) throw Malformed{fmt::format("byte {} of the data", at_), "is no number"};
    at_ = static_cast<std::size_t>(end - data_.data());
    return value;
  }
  template <class T>
  double as(std::array<char, 8> bytes) const {
    T value;
    std::memcpy(&value, bytes.data(), sizeof(T));
    return static_cast<double>(value);
  }
  double next_binary(Type type) {
    const std::size_t size = bytes_of(type);
    if (left() < size) ends();
    std::array<char, 8> bytes{};
    std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(at_), size, bytes.begin());
    if (order_ == Order::big) std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    at_ += size;
    switch (type) {
      case Type::int8:
        return as<std::int8_t>(bytes);
      case Type::uint8:
        return as<std::uint8_t>(bytes);
      case Type::int16:
        return as<std::int16_t>(bytes);
      case Type::uint16:
        return as<std::uint16_t>(bytes);
      case Type::int32:
        return as<std::int32_t>(bytes);
      case Type::uint32:
        return as<std::uint32_t>(bytes);
      case Type::float32:
        return as<float>(bytes);
      case Type::float64:
        return as<double>(bytes);
    }
    return 0;
  }

  std::string_view data_;
  Order order_;
  std::size_t at_ = 0;
};

// What a property of a vertex is.
enum class Use : std::uint8_t { none, x, y, z, nx, ny, nz, u, v, red, green, blue, alpha };
Use use_of(std::string_view name) {
  struct Row {
    std::string_view name;
    Use use;
  };
  static constexpr std::array<Row, 21> rows{{{"x", Use::x},
                                             {"y", Use::y},
                                             {"z", Use::z},
                                             {"nx", Use::nx},
                                             {"ny", Use::ny},
                                             {"nz", Use::nz},
                                             {"u", Use::u},
                                             {"v", Use::v},
                                             {"s", Use::u},
                                             {"t", Use::v},
                                             {"texture_u", Use::u},
                                             {"texture_v", Use::v},
                                             {"red", Use::red},
                                             {"green", Use::green},
                                             {"blue", Use::blue},
                                             {"alpha", Use::alpha},
                                             {"diffuse_red", Use::red},
                                             {"diffuse_green", Use::green},
                                             {"diffuse_blue", Use::blue},
                                             {"r", Use::red},
                                             {"g", Use::green}}};
  for (const Row& row : rows)
    if (row.name == name) return row.use;
  return name == "b" ? Use::blue : Use::none;
}

// Scanners and painters store what a screen shows.
float linear_from_srgb(double srgb) {
  return static_cast<float>(srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4));
}

class Reader {
 public:
  Reader(const Header& header, std::string_view data) : header_(header), numbers_(data, header.order) {}

  scene::TriangleMesh read() {
    for (const ElementKind& kind : header_.kinds) {
      expect_room(kind);
      if (kind.name == "vertex")
        read_vertices(kind);
      else
        read_others(kind);
    }
    if (mesh_.triangles.empty()) throw Malformed{"", "has no faces"};
    return std::move(mesh_);
  }

 private:
  // No memory is taken for more than the file can hold: every number has a byte at least.
  void expect_room(const ElementKind& kind) const {
    std::size_t least = 0;
    for (const Property& p : kind.properties)
      least += header_.order == Order::text ? 1 : bytes_of(p.count_type.value_or(p.type));
    if (kind.count > 0 && (least == 0 || kind.count > numbers_.left() / least))
      throw Malformed{
          fmt::format("element {}", kind.name),
          fmt::format("is promised {} times, and {} bytes are left", kind.count, numbers_.left())};
  }

  void read_vertices(const ElementKind& kind) {
    std::vector<Use> uses;
    for (const Property& p : kind.properties) {
      if (p.count_type) throw Malformed{"element vertex", fmt::format("has the list '{}'", p.name)};
      uses.push_back(use_of(p.name));
    }
    const auto has = [&](Use use) { return std::find(uses.begin(), uses.end(), use) != uses.end(); };
    const bool normals = has(Use::nx) && has(Use::ny) && has(Use::nz), uvs = has(Use::u) && has(Use::v);
    const bool colors = has(Use::red) && has(Use::green) && has(Use::blue);
    mesh_.points.reserve(kind.count);
    for (std::uint64_t i = 0; i < kind.count; ++i) {
      std::array<double, 13> values{};
      values[static_cast<std::size_t>(Use::alpha)] = 1;
      for (std::size_t k = 0; k < uses.size(); ++k) {
        const Type type = kind.properties[k].type;
        double value = numbers_.next(type);
        if (uses[k] >= Use::red && type == Type::uint8) value /= 255;
        if (uses[k] >= Use::red && type == Type::uint16) value /= 65535;
        if (uses[k] != Use::none && !std::isfinite(value))
          throw Malformed{fmt::format("vertex {}", i),
                          fmt::format("has {} {}", kind.properties[k].name, value)};
        values[static_cast<std::size_t>(uses[k])] = value;
      }
      const auto at = [&](Use use) { return values[static_cast<std::size_t>(use)]; };
      mesh_.points.emplace_back(at(Use::x), at(Use::y), at(Use::z));
      if (normals) mesh_.normals.emplace_back(at(Use::nx), at(Use::ny), at(Use::nz));
      if (uvs) mesh_.uvs.push_back({at(Use::u), at(Use::v)});
      if (colors)
        mesh_.colors.push_back({linear_from_srgb(at(Use::red)), linear_from_srgb(at(Use::green)),
                                linear_from_srgb(at(Use::blue)), static_cast<float>(at(Use::alpha))});
    }
  }

  void read_others(const ElementKind& kind) {
    for (std::uint64_t i = 0; i < kind.count; ++i)
      for (const Property& p : kind.properties) {
        const bool corners = kind.name == "face" && (p.name == "vertex_indices" || p.name == "vertex_index");
        if (!p.count_type) {
          numbers_.next(p.type);
          continue;
        }
        const double count = numbers_.next(*p.count_type);
        const std::size_t least = header_.order == Order::text ? 1 : bytes_of(p.type);
        if (!(count >= 0 && count <= static_cast<double>(numbers_.left() / least)))
          throw Malformed{fmt::format("{} {}", kind.name, i), fmt::format("has a list of {}", count)};
        if (corners)
          read_face(i, static_cast<std::size_t>(count), p.type);
        else
          for (double k = 0; k < count; ++k) numbers_.next(p.type);
      }
  }

  void read_face(std::uint64_t face, std::size_t count, Type type) {
    std::array<std::uint32_t, 3> fan{};
    for (std::size_t k = 0; k < count; ++k) {
      const double index = numbers_.next(type);
      if (!(index >= 0 && index < static_cast<double>(mesh_.points.size()) && index == std::floor(index)))
        throw Malformed{fmt::format("face {}", face),
                        fmt::format("names vertex {}, and there are {}", index, mesh_.points.size())};
      fan[std::min<std::size_t>(k, 2)] = static_cast<std::uint32_t>(index);
      if (k < 2) continue;
      mesh_.triangles.push_back(fan);
      fan[1] = fan[2];
    }
  }

  const Header& header_;
  Numbers numbers_;
  scene::TriangleMesh mesh_;
};

}  // namespace

MeshFile read_ply(std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const Header header = HeaderReader(text).read();
  MeshFile out;
  out.parts.push_back({Reader(header, text.substr(header.end)).read(), {}});
  if (!out.parts[0].mesh.colors.empty()) {
    pbr::Material painted;
    painted.name = "painted";
    painted.metallic = 0;
    painted.specular = 0;
    out.materials.push_back(painted);
    out.parts[0].material = 0;
  }
  return out;
}

}  // namespace tyndall::mesh_file
