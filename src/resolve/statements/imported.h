// What statements of imported files share.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "resolve/resolve_context.h"

namespace tyndall::resolve {

// The materials that stand for those of a file, by index.
using Overrides = std::map<std::uint32_t, scene::MaterialId>;

// Those given, of a file with these names; nothing after an error at `materials`.
std::optional<Overrides> overrides_of(Run& run, Reader& reader, const std::string& file,
                                      const std::vector<std::string>& names, const MaterialOverrides& given);

// "it has: a, b, …", or what one of the names resembles.
std::string help_of_names(const std::string& wanted, const std::vector<std::string>& names);

// Runs `fill` with the object taking what it makes; then puts it among the scene's prototypes.
template <class Fill>
KnownObject make_object(Run& run, const std::string& name, Fill&& fill) {
  BuiltObject object;
  object.things.name = name;
  struct Restore {
    Run& run;
    BuiltObject* outer;
    ~Restore() { run.building = outer; }
  };
  {
    const Restore restore{run, std::exchange(run.building, &object)};
    fill();
  }
  KnownObject known{{},
                    scene::PrototypeId(run.scene.prototypes.size()),
                    std::move(object.lights),
                    object.inherits_material,
                    object.placed + static_cast<double>(object.things.volumes.size()),
                    object.volumes};
  run.scene.prototypes.push_back(std::move(object.things));
  return known;
}

}  // namespace tyndall::resolve
