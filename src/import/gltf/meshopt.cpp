// The one file that knows meshoptimizer.
#include "import/gltf/meshopt.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <string>

#include "import/malformed.h"

namespace tyndall::gltf {

namespace {

// Undoes a filter in place.
void unfilter(const Element& extension, const std::string& filter, std::vector<std::byte>& bytes,
              std::size_t count, std::size_t stride) {
  const auto expect = [&](bool right) {
    if (!right) extension["byteStride"].fail(fmt::format("is {}, which {} does not take", stride, filter));
  };
  if (filter == "OCTAHEDRAL") {
    expect(stride == 4 || stride == 8);
    meshopt_decodeFilterOct(bytes.data(), count, stride);
  } else if (filter == "QUATERNION") {
    expect(stride == 8);
    meshopt_decodeFilterQuat(bytes.data(), count, stride);
  } else if (filter == "EXPONENTIAL") {
    expect(stride > 0 && stride % 4 == 0);
    meshopt_decodeFilterExp(bytes.data(), count, stride);
  } else if (filter != "NONE") {
    extension["filter"].fail(fmt::format("is '{}', which is none of glTF's", filter));
  }
}

}  // namespace

std::vector<std::byte> unpacked_meshopt(const Element& extension, std::span<const std::byte> packed) {
  const std::uint64_t count = extension["count"].count(), stride = extension["byteStride"].count();
  const std::string mode = extension["mode"].text(), filter = extension.text("filter", "NONE");
  if (stride == 0 || stride > 256)
    extension["byteStride"].fail(fmt::format("is {}: 1 to 256 are known", stride));
  // Nothing is packed denser: two bits for 16 bytes of attributes, a byte for three indices.
  constexpr std::uint64_t densest = 64, slack = 1 << 20;
  if (count > (densest * packed.size() + slack) / stride)
    extension["count"].fail(fmt::format("is {}: {} bytes cannot hold so much", count, packed.size()));
  std::vector<std::byte> bytes(count * stride);
  const auto* const from = reinterpret_cast<const unsigned char*>(packed.data());
  int failed = 0;
  if (mode == "ATTRIBUTES") {
    if (stride % 4 != 0) extension["byteStride"].fail(fmt::format("is {}: no multiple of 4", stride));
    failed = meshopt_decodeVertexBuffer(bytes.data(), count, stride, from, packed.size());
  } else if (mode == "TRIANGLES" || mode == "INDICES") {
    if (stride != 2 && stride != 4) extension["byteStride"].fail(fmt::format("is {}: no index's", stride));
    if (mode == "TRIANGLES" && count % 3 != 0) extension["count"].fail("is no multiple of 3");
    failed = mode == "TRIANGLES"
                 ? meshopt_decodeIndexBuffer(bytes.data(), count, stride, from, packed.size())
                 : meshopt_decodeIndexSequence(bytes.data(), count, stride, from, packed.size());
  } else {
    extension["mode"].fail(fmt::format("is '{}', which is none of glTF's", mode));
  }
  if (failed != 0) extension.fail("cannot be unpacked: its bytes are damaged");
  unfilter(extension, filter, bytes, count, stride);
  return bytes;
}

}  // namespace tyndall::gltf
