// A glTF file as it is stored: its JSON, and the bytes that it refers to, read when they are first asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "import/find_file.h"
#include "import/gltf/json.h"

namespace tyndall::gltf {

using Bytes = std::span<const std::byte>;

class Document {
 public:
  // Reads the JSON of a .gltf or .glb and checks the version and the extensions that are required. Throws
  // Malformed, as all that follows does.
  Document(std::vector<std::byte> file, FindFile find_file);
  ~Document();

  Element root() const;
  // The lists at the top of a document ("nodes", "meshes"): empty where there is none.
  std::size_t count(std::string_view list) const;
  Element item(std::string_view list, std::size_t i) const;
  // The index in such a list that `holder` has under `key`.
  std::optional<std::uint32_t> index(const Element& holder, std::string_view key,
                                     std::string_view list) const;

  // The bytes of bufferViews[i], decompressed.
  Bytes view(std::uint32_t i);
  // The bytes of images[i], as stored.
  Bytes image(std::uint32_t i);

  // Counts bytes that are made of the file, so that a few claims cannot fill the memory.
  void take(const Element& what, double bytes);

  // Counts anew: what is made from now on is for another frame of the scene, in place of what was made.
  void begin_frame() { bytes_made_ = 0; }

  // What is told once, for the user: of optional extensions that are not supported, and the like.
  void warn(std::string message);
  // Of several with one key the first is told.
  void warn_once(std::string_view key, std::string message);
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  using Owned = std::vector<std::byte>;
  void read_container(Owned file);
  void check_asset() const;
  void check_extensions();
  Bytes buffer(std::uint32_t i);
  Bytes part_of_buffer(const Element& holder);
  Owned resource(const Element& uri);

  FindFile find_file_;
  std::unique_ptr<nlohmann::json> json_;
  Owned file_;
  std::optional<Bytes> binary_;  // of a .glb
  std::map<std::uint32_t, Owned> buffers_, views_, images_;
  double bytes_read_ = 0, bytes_made_ = 0;
  std::vector<std::string> warnings_;
  std::set<std::string, std::less<>> told_;
};

// The name under which messages and scenes know an element: its own, or "nodes[3]".
std::string name_of(const Element& element);

}  // namespace tyndall::gltf
