// Headless Chromium: pages are opened as people open them, and asked what they show.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tyndall::test {

// Its path; empty where it is not installed.
std::string chromium();

struct OpenedPage {
  nlohmann::json found;              // what the expression gave
  std::vector<std::string> console;  // what the page wrote to the console, errors included
  std::string told;                  // all that Chromium said, for messages of failures
};

// Opens a page in a window of that width, and evaluates a JavaScript expression there when it is loaded.
// Copies of the page and Chromium's own files are put into the folder.
OpenedPage open_page(const std::string& page, const std::string& expression, const std::string& folder,
                     int width = 1280);

}  // namespace tyndall::test
