// One page with all of the language.
#include <fmt/format.h>

#include <utility>

#include "tools/reference.h"

namespace tyndall::tools {

namespace {

constexpr std::string_view language = R"(# Cheat sheet

All of the language on a page. `tyndall help NAME` says more of each word; [the manual](language.md) explains it.

```text
let a = 1    var b = 2    b = b + 1              a name for a value; one that changes
def f(x, n = 3) = x * n                          a function; = { … return … } with statements
def lamp(at) { light point { position: at … } }  a template places things: lamp((0, 1, 0))
medium fog(amount = 1) { density = amount * fbm(p) }    material red() { base_color = (1, 0, 0) }
object tree(seed) { … }    place tree(seed: 1) { transform: translate((1, 0, 0)) }
for i in 0..<8 { … }    if a > 1 { … } else { … }    include "file.tyn"
if a then b else c    [f(i) for i in 0..<8 if i != 3]    list[0]    list + [x]    "name{i:03}.png"
2cm  30deg  50%  3200K  20ms    (1, 2, 3)    #ff8800    p.xz    0..4  0..<4  10..0..-2
+ - * / ^    < <= > >= == !=    and or not
in media: p (place in the volume), P (in the scene), time    in materials: uv, n, N as well
```
)";

// Names side by side, in lines of a page's width.
void add_wrapped(std::string& out, const std::vector<std::string>& names) {
  constexpr std::size_t width = 112;
  std::size_t column = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string word = names[i] + (i + 1 < names.size() ? "," : "");
    if (column + word.size() + 1 > width) out += "\n ", column = 1;
    if (column > 0) out += ' ';
    out += word;
    column += word.size() + 1;
  }
  out += '\n';
}

// A parameter with a mark where it must be given.
std::string marked(const ReferenceParameter& p) {
  return p.required ? fmt::format("**`{}`**", p.name) : fmt::format("`{}`", p.name);
}

}  // namespace

std::string cheat_sheet() {
  std::string out(language);
  out += "\n## Statements\n\nThose in bold type must be given.\n\n";
  for (const ReferenceStatement& statement : reference_statements()) {
    std::vector<std::string> names;
    for (const ReferenceParameter& p : statement.parameters) names.push_back(marked(p));
    if (!names.empty()) names.front() = fmt::format("- `{}`: {}", statement.name, names.front());
    add_wrapped(out, names);
  }
  out += "\n## Outputs\n\n";
  for (const auto& [body, outputs] : {std::pair{"media", &reference_medium_outputs()},
                                      std::pair{"materials", &reference_material_outputs()}}) {
    std::vector<std::string> names;
    for (const ReferenceOutput& output : *outputs)
      names.push_back(fmt::format("{}`{}`", names.empty() ? fmt::format("- {}: ", body) : "", output.name));
    add_wrapped(out, names);
  }
  out += "\n## Functions\n\n| call | gives |\n| --- | --- |\n";
  for (const ReferenceFunction& function : reference_functions())
    out += fmt::format("| `{}` | {} |\n", function.call, function.result);
  return out;
}

}  // namespace tyndall::tools
