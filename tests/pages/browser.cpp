#include "pages/browser.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "cli/run_program.h"

namespace tyndall::test {
namespace {

namespace fs = std::filesystem;

std::string unescaped(std::string text) {
  for (const auto& [name, sign] : {std::pair("&lt;", "<"), {"&gt;", ">"}, {"&quot;", "\""}, {"&amp;", "&"}})
    for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos; ++at)
      text.replace(at, std::string(name).size(), sign);
  return text;
}

// Between the tags of the element that holds what was found.
std::string text_of_probe(const std::string& document) {
  const std::string begin = "<pre id=\"probe\">";
  const std::size_t at = document.rfind(begin);
  if (at == std::string::npos) return {};
  const std::size_t from = at + begin.size();
  return unescaped(document.substr(from, document.find("</pre>", from) - from));
}

}  // namespace

std::string chromium() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const fs::path file = fs::path(folder) / "chromium"; fs::exists(file)) return file.string();
  return {};
}

OpenedPage open_page(const std::string& page, const std::string& expression, const std::string& folder,
                     int width) {
  const std::string copy = (fs::path(folder) / "opened.html").string();
  std::ofstream(copy, std::ios::binary)
      << read_file(page) << "<script>addEventListener('load', () => { const found = JSON.stringify(("
      << expression
      << ")()), pre = document.createElement('pre'); pre.id = 'probe'; pre.textContent = found; "
         "document.body.append(pre); });</script>\n";
  // The pages are our own: the sandbox, which root cannot have, is not needed.
  const Outcome outcome =
      run(chromium(), {"--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run",
                       "--user-data-dir=" + (fs::path(folder) / "chromium").string(),
                       "--window-size=" + std::to_string(width) + ",900", "--enable-logging=stderr",
                       "--virtual-time-budget=2000", "--dump-dom", "file://" + copy});
  OpenedPage opened;
  opened.told = outcome.err;
  opened.found = nlohmann::json::parse(text_of_probe(outcome.out), nullptr, false);
  const std::regex line(R"(:CONSOLE[^\]]*\] (.*))");
  for (std::sregex_iterator it(outcome.err.begin(), outcome.err.end(), line), end; it != end; ++it)
    opened.console.push_back((*it)[1]);
  return opened;
}

}  // namespace tyndall::test
