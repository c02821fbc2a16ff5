#include "tools/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace tyndall::tools {

namespace {

// A line of a source; nowhere comes first.
struct Line {
  std::uint32_t source = 0, line = 0;
  auto operator<=>(const Line&) const = default;
};

struct ShaderCost {
  std::string shader;
  double cost = 0;
  std::map<Line, double> lines;
};

std::string line_text(const Line& line, const Sources& sources) {
  if (line.line == 0) return "(what has no line of its own)";
  const Source& source = sources[SourceId(line.source)];
  std::string_view text = source.line(line.line);
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  return fmt::format("{}:{}: {}", source.name(), line.line, text);
}

}  // namespace

std::string profile_text(const std::vector<ProgramLanes>& programs, const Sources& sources) {
  std::vector<ShaderCost> shaders;
  double all = 0;
  for (const ProgramLanes& p : programs) {
    auto shader = std::find_if(shaders.begin(), shaders.end(),
                               [&](const ShaderCost& s) { return s.shader == p.shader; });
    if (shader == shaders.end()) shader = shaders.insert(shaders.end(), ShaderCost{p.shader, 0, {}});
    for (std::size_t i = 0; i < p.program->lane_code.size(); ++i) {
      const vm::Instruction& instruction = p.program->lane_code[i];
      const double cost = static_cast<double>(p.lanes[i]) * vm::op_cost(instruction.op, instruction.count);
      const Span& span = p.program->lane_spans[i];
      const Line line =
          span.valid() ? Line{span.source.index, sources[span.source].locate(span.begin).line} : Line{};
      shader->cost += cost;
      shader->lines[line] += cost;
      all += cost;
    }
  }
  if (!(all > 0)) return "no shader computed anything: all are the same everywhere\n";
  std::stable_sort(shaders.begin(), shaders.end(),
                   [](const ShaderCost& a, const ShaderCost& b) { return a.cost > b.cost; });
  std::string text =
      "share of the shaders' time by source line (instructions x lanes x cost of the operation)\n";
  for (const ShaderCost& shader : shaders) {
    text += fmt::format("{:5.1f} % {}\n", 100 * shader.cost / all, shader.shader);
    for (const auto& [line, cost] : shader.lines)
      text += fmt::format("  {:5.1f} % {}\n", 100 * cost / all, line_text(line, sources));
  }
  return text;
}

}  // namespace tyndall::tools
