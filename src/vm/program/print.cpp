// The listing of a program.
#include <fmt/format.h>

#include <iterator>

#include "vm/program/program.h"

namespace tyndall::vm {

namespace {

// c0 constants, names for inputs, u0 uniforms, r0 rows.
std::string operand_name(const Program& program, Operand operand) {
  if (operand < program.first_input()) return fmt::format("c{}", operand);
  if (operand < program.first_uniform())
    return std::string(input_name(program.inputs[operand - program.first_input()]));
  if (operand < program.first_row()) return fmt::format("u{}", operand - program.first_uniform());
  return fmt::format("r{}", operand - program.first_row());
}

std::string instruction_text(const Program& program, const Instruction& instruction) {
  const OpInfo& info = op_info(instruction.op);
  std::string text = fmt::format("{} = {}", operand_name(program, instruction.destination), info.name);
  for (int k = 0; k < info.operands; ++k)
    text += ' ' + operand_name(program, instruction.operands[static_cast<std::size_t>(k)]);
  if (info.has(OpTrait::octaves)) text += fmt::format("  octaves {}", instruction.count);
  if (info.has(OpTrait::voxels)) text += fmt::format("  voxels {}", instruction.immediate);
  if (info.has(OpTrait::plane)) text += fmt::format("  plane {}", instruction.immediate);
  if (info.has(OpTrait::seed)) text += fmt::format("  seed {}", instruction.immediate);
  return text;
}

// "  // file:line: text of the line", or empty when the place is unknown.
std::string source_line(const Span& span, const Sources* sources) {
  if (sources == nullptr || !span.valid()) return {};
  const Source& source = (*sources)[span.source];
  const LineColumn place = source.locate(span.begin);
  std::string_view line = source.line(place.line);
  while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
  return fmt::format("  // {}:{}: {}\n", source.name(), place.line, line);
}

void print_code(std::string& out, const Program& program, std::string_view title,
                const std::vector<Instruction>& code, const std::vector<Span>& spans,
                const std::vector<Guard>& guards, const Sources* sources) {
  if (code.empty()) return;
  out += fmt::format("{}\n", title);
  std::string last_line, indent = "  ";
  auto guard = guards.begin();
  std::vector<std::uint32_t> ends;
  const auto close = [&](std::size_t i) {
    for (; !ends.empty() && ends.back() == i; ends.pop_back()) {
      indent.resize(indent.size() - 2);
      out += indent + "}\n";
    }
  };
  for (std::size_t i = 0; i < code.size(); ++i) {
    close(i);
    const std::string line = source_line(spans[i], sources);
    if (line != last_line) out += line;
    last_line = line;
    for (; guard != guards.end() && guard->first == i; ++guard) {
      out += fmt::format("{}where {}{} {{\n", indent, guard->when ? "" : "not ",
                         operand_name(program, guard->condition));
      indent += "  ";
      ends.push_back(guard->last);
    }
    out += fmt::format("{}{}\n", indent, instruction_text(program, code[i]));
  }
  close(code.size());
}

void print_tables(std::string& out, const Tables& tables) {
  if (!tables.planes.empty()) out += "planes\n";
  for (std::size_t i = 0; i < tables.planes.size(); ++i) {
    const Plane& plane = *tables.planes[i];
    out += fmt::format("  {} = {}, {} x {}, {:016x}\n", i, plane.name, plane.width, plane.height, plane.hash);
  }
  if (!tables.voxels.empty()) out += "voxels\n";
  for (std::size_t i = 0; i < tables.voxels.size(); ++i) {
    const Voxels& voxels = *tables.voxels[i];
    out += fmt::format("  {} = {}, {} x {} x {}, {:016x}\n", i, voxels.name, voxels.size[0], voxels.size[1],
                       voxels.size[2], voxels.hash);
  }
}

}  // namespace

std::string print(const Program& program, const Sources* sources) {
  std::string out;
  if (!program.constants.empty()) {
    out += "constants\n";
    for (std::size_t i = 0; i < program.constants.size(); ++i)
      out += fmt::format("  c{} = {}\n", i, program.constants[i]);
  }
  if (!program.inputs.empty()) {
    out += "inputs\n ";
    for (const Input input : program.inputs) out += fmt::format(" {}", input_name(input));
    out += '\n';
  }
  print_tables(out, program.tables);
  print_code(out, program, "once a batch", program.uniform_code, program.uniform_spans, {}, sources);
  print_code(out, program, fmt::format("every lane, {} rows", program.row_count), program.lane_code,
             program.lane_spans, program.guards, sources);
  out += "outputs\n ";
  for (const Operand output : program.outputs) out += ' ' + operand_name(program, output);
  out += '\n';
  return out;
}

}  // namespace tyndall::vm
