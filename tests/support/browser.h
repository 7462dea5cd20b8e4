#pragma once

#include <cstdlib>
#include <regex>
#include <sstream>
#include <string>

#include "support/run_arguments.h"

namespace floc::test {

/// Returns the name of the browser program; empty if no browser is installed (.ci/deps installs one).
inline std::string browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (std::system(("command -v " + std::string(name) + " >/dev/null 2>&1").c_str()) == 0) return name;
  return "";
}

/// Page as rendered by a browser.
struct RenderedPage {
  std::string document;  ///< HTML after loading and running all scripts
  std::string console;   ///< lines that the page wrote to the console, including errors
  int n_images = 0;
  int n_shown = 0;  ///< pictures that are loaded and have a size
};

/// Loads a copy of a page in a headless browser. The copy contains an additional script, which counts the pictures
/// after the page has been loaded.
/// @param extra  text appended to the copy
inline RenderedPage render_in_browser(const std::string& page, const std::string& directory,
                                      const std::string& extra = "") {
  const std::string script =
      "<script>addEventListener('load', () => { const all = Array.from(document.images);"
      "document.body.setAttribute('data-seen', all.length + ' ' +"
      "all.filter(i => i.complete && i.naturalWidth > 1 && i.getBoundingClientRect().width > 50).length); "
      "});</script>";
  write_text(directory + "/looked-at.html", page + script + extra);
  const Outcome o = run_arguments(
      browser(), {"--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                  "--user-data-dir=" + directory + "/profile", "--enable-logging=stderr",
                  "--virtual-time-budget=20000", "--dump-dom", "file://" + directory + "/looked-at.html"});
  RenderedPage rendered;
  rendered.document = o.out;
  std::istringstream lines(o.err);
  for (std::string line; std::getline(lines, line);)
    if (line.find("CONSOLE") != std::string::npos) rendered.console += line + "\n";
  std::smatch match;
  if (std::regex_search(o.out, match, std::regex("data-seen=\"([0-9]+) ([0-9]+)\""))) {
    rendered.n_images = std::stoi(match[1]);
    rendered.n_shown = std::stoi(match[2]);
  }
  return rendered;
}

}  // namespace floc::test
