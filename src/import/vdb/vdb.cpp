// Loads the module around OpenVDB.
#include "import/vdb/vdb.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "import/vdb/module.h"

namespace tyndall::import {

namespace {

// Found beside the program by its run path; null with a reason when it is not there.
struct LoadedModule {
  const VdbModule* module = nullptr;
  std::string problem;
};
const LoadedModule& load_module() {
  static const LoadedModule loaded = [] {
    LoadedModule result;
    void* library = ::dlopen(TYNDALL_OPENVDB_FILE, RTLD_NOW | RTLD_LOCAL);
    if (library != nullptr) result.module = static_cast<const VdbModule*>(::dlsym(library, vdb_symbol));
    if (result.module == nullptr) result.problem = ::dlerror();
    return result;
  }();
  return loaded;
}

}  // namespace

GridResult read_grid(const std::string& path, const GridEntry& entry, std::uint64_t most_bytes,
                     const GridUse& use) {
  const LoadedModule& loaded = load_module();
  GridResult result;
  result.error = loaded.problem;
  if (loaded.module != nullptr) result = loaded.module->read(path, entry, most_bytes, use);
  if (!result.error.empty()) result.error = fmt::format("cannot read '{}': {}", path, result.error);
  return result;
}

}  // namespace tyndall::import
