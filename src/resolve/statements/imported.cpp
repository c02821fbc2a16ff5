#include "resolve/statements/imported.h"

#include <fmt/format.h>

#include <algorithm>

namespace tyndall::resolve {

std::string help_of_names(const std::string& wanted, const std::vector<std::string>& names) {
  if (names.empty()) return "it has none with a name";
  std::string help = did_you_mean(wanted, {names.begin(), names.end()});
  if (!help.empty()) return help;
  constexpr std::size_t most = 20;
  const auto shown = static_cast<std::ptrdiff_t>(std::min(names.size(), most));
  return fmt::format("it has: {}{}", fmt::join(names.begin(), names.begin() + shown, ", "),
                     names.size() > most ? ", …" : "");
}

std::optional<Overrides> overrides_of(Run& run, Reader& reader, const std::string& file,
                                      const std::vector<std::string>& names, const MaterialOverrides& given) {
  Overrides out;
  for (const MaterialOverrides::Entry& entry : given.entries) {
    const scene::MaterialId material = material_of(run, entry.material);
    if (!material.valid()) return std::nullopt;
    const auto count = std::count(names.begin(), names.end(), entry.name);
    if (count == 0) {
      reader.error(reader.place("materials"),
                   fmt::format("'{}' has no material called '{}'", file, entry.name),
                   help_of_names(entry.name, names));
      return std::nullopt;
    }
    if (count > 1)
      run.diagnostics.warning(reader.place("materials"),
                              fmt::format("'{}' has {} materials called '{}': all of them are replaced", file,
                                          count, entry.name));
    for (std::uint32_t i = 0; i < names.size(); ++i)
      if (names[i] == entry.name) out[i] = material;
  }
  return out;
}

}  // namespace tyndall::resolve
