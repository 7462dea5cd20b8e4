#include "floc/scene/starting_scene.h"

#include <algorithm>
#include <cassert>
#include <cctype>

#include "demo_scene.h"
#include "floc/base/error.h"

namespace floc {

std::string starting_scene(const std::string& name) {
  const auto allowed = [](unsigned char c) { return std::isalnum(c) || c == '.' || c == '_' || c == '-'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), allowed))
    throw InputError("", "'" + name + "': expected a name that consists of letters, digits, '.', '_' and '-'");
  std::string text = kDemoScene;
  const std::string demo_name = "\"demo\"";
  const auto at = text.find(demo_name);
  assert(at != std::string::npos);
  text.replace(at, demo_name.size(), "\"" + name + "\"");
  // The first line of the demo scene is a comment about the demo. This line is replaced by a title.
  const std::string title =
      "# Starting point for a scene of your own: `floc scene check` lists its faults and its dimensionless "
      "numbers.";
  return title + text.substr(text.find('\n'));
}

}  // namespace floc
