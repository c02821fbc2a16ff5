#include "render/context/bad_values.h"

#include <algorithm>
#include <cmath>

namespace tyndall::render {

namespace {

// What the medium or material is given, each with the statements that set it; null when there is none.
const std::vector<scene::GivenNumber>* given_of(const compile::CompiledScene& world, bool of_material,
                                                std::uint32_t shader) {
  if (shader >= (of_material ? world.scene.materials.size() : world.media.size())) return nullptr;
  return of_material ? &world.scene.materials[shader].given : &world.media[shader].given;
}

}  // namespace

void BadValueCounts::save(ByteWriter& out) const {
  out.put(counts_.size());
  for (const auto& [key, count] : counts_) {
    out.put(key.of_material);
    out.put(key.shader);
    out.put(key.output);
    out.put(key.branch);
    out.put(static_cast<std::uint8_t>(key.kind));
    out.put(count);
  }
}

bool BadValueCounts::restore(ByteReader& in, const compile::CompiledScene& world) {
  for (auto left = in.take<std::size_t>(); left > 0; --left) {
    Key key{};
    in.take(key.of_material);
    in.take(key.shader);
    in.take(key.output);
    in.take(key.branch);
    key.kind = static_cast<BadValue::Kind>(in.take<std::uint8_t>());
    const auto count = in.take<std::uint64_t>();
    const std::vector<scene::GivenNumber>* given = given_of(world, key.of_material, key.shader);
    if (!in.good() || !given || key.kind > BadValue::Kind::coarse) return false;
    if (key.output < given->size()) {
      const auto& branches = (*given)[key.output].branches;
      if (!branches.empty() && key.branch >= branches.size()) return false;
    } else if (key.of_material || key.output - given->size() >= world.media[key.shader].output_spans.size()) {
      return false;
    }
    counts_[key] += count;
  }
  return in.good();
}

// What one statement gave is told once, whichever components it was.
std::vector<BadValue> BadValueCounts::list(const compile::CompiledScene& world) const {
  std::vector<BadValue> out;
  const auto add = [&out](const BadValue& bad) {
    const auto same = std::find_if(out.begin(), out.end(), [&bad](const BadValue& other) {
      return other.kind == bad.kind && other.span == bad.span && other.shader == bad.shader &&
             other.output == bad.output;
    });
    if (same == out.end())
      out.push_back(bad);
    else
      same->count += bad.count;
  };
  for (const auto& [key, count] : counts_) {
    const std::string& shader =
        key.of_material ? world.scene.materials[key.shader].name : world.media[key.shader].name;
    const std::vector<scene::GivenNumber>& all =
        key.of_material ? world.scene.materials[key.shader].given : world.media[key.shader].given;
    if (key.output < all.size()) {
      const scene::GivenNumber& given = all[key.output];
      BadValue bad{key.kind,     given.branches.empty() ? given.span : given.branches[key.branch],
                   shader,       count,
                   given.name,   given.lowest,
                   given.highest};
      if (key.of_material && std::isinf(given.highest)) bad.instead = "the shape's own normal";
      add(bad);
    } else {
      add({key.kind,
           world.media[key.shader].output_spans[key.output - all.size()],
           shader,
           count,
           {},
           0,
           double{largest_value}});
    }
  }
  return out;
}

}  // namespace tyndall::render
