#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// Allowed includes between the folders of lib/floc, and a check of the #include lines of all sources.
namespace floc::test {

/// Maps each folder to the folders that its sources may include directly. The sources may also include every folder
/// that one of these folders may include.
using LayerOrder = std::map<std::string, std::set<std::string>>;

inline const LayerOrder& layer_order() {
  static const LayerOrder order = {
      {"base", {}},
      {"geometry", {"base"}},
      {"shape", {"geometry"}},
      {"contact", {"base", "geometry"}},
      {"linalg", {"base"}},
      {"fitting", {"base"}},
      {"packing", {"geometry", "shape", "contact"}},
      {"neighbors", {"packing"}},
      {"network", {"packing", "contact"}},
      {"petsc", {"base"}},
      {"elasticity", {"network", "linalg", "petsc"}},
      {"rigid", {"neighbors", "network", "linalg"}},
      {"relaxation", {"neighbors", "elasticity", "rigid"}},
      {"assembly", {"relaxation"}},
      {"loading", {"assembly", "relaxation"}},
      {"structure", {"packing", "neighbors", "network"}},
      {"lattice", {"elasticity", "structure"}},
      {"io", {"packing", "contact"}},
      {"prices", {"relaxation", "io"}},
      {"scene", {"contact", "assembly", "loading", "io", "prices"}},
      {"verification", {"scene", "io", "elasticity", "neighbors", "rigid"}},
      {"imports", {"io", "neighbors", "verification"}},
      {"run_directory", {"scene", "loading", "io", "structure", "elasticity", "neighbors"}},
      {"picture", {"structure", "elasticity", "packing", "lattice"}},
      {"tradeoff", {"scene", "loading", "elasticity", "structure", "fitting", "rigid", "io", "lattice"}},
      {"campaign", {"scene", "loading", "io"}},
      {"tables",
       {"elasticity", "fitting", "io", "lattice", "rigid", "run_directory", "structure", "verification"}},
      {"planning", {"campaign", "fitting", "prices", "run_directory", "scene", "tradeoff"}},
  };
  return order;
}

/// Beginnings of the names of headers of other libraries, each with the folders of lib/floc that may include these
/// headers; mostly a single folder. If the list of folders is empty, no folder may include them.
inline const std::vector<std::pair<std::string, std::set<std::string>>>& foreign_owners() {
  static const std::vector<std::pair<std::string, std::set<std::string>>> owners = {
      {"cholmod", {"linalg"}},
      {"umfpack", {"linalg"}},
      {"SuiteSparse", {"linalg"}},
      {"suitesparse/", {"linalg"}},
      {"petsc", {"petsc"}},
      {"mpi.h", {"petsc"}},
      {"cblas", {"linalg"}},
      {"Spectra/", {"linalg"}},
      {"ceres/", {"fitting"}},
      {"glog/", {"fitting"}},
      {"hdf5", {"io"}},
      {"H5", {"io"}},
      {"pugixml", {"io"}},
      {"zlib", {"base"}},
      {"toml", {"scene", "campaign"}},
      {"cairo", {"picture"}},
      {"fftw3", {"structure"}},
      {"voro++", {"structure"}},
      {"nlohmann/", {"io", "relaxation", "run_directory", "tables"}},
      {"CLI/", {}},
  };
  return owners;
}

/// Returns all folders that `folder` may include, itself included.
inline std::set<std::string> reachable(const LayerOrder& order, const std::string& folder) {
  std::set<std::string> found{folder};
  std::vector<std::string> open{folder};
  while (!open.empty()) {
    const std::string next = open.back();
    open.pop_back();
    for (const std::string& below : order.at(next))
      if (found.insert(below).second) open.push_back(below);
  }
  return found;
}

/// One #include line of a source.
struct Include {
  std::string name;  ///< text between the quotes or angle brackets
  bool quoted;
};

inline std::vector<Include> includes_of(const std::string& text) {
  static const std::regex line(R"re(^[ \t]*#[ \t]*include[ \t]*(["<])([^">]+)[">])re", std::regex::multiline);
  std::vector<Include> found;
  for (std::sregex_iterator m(text.begin(), text.end(), line), end; m != end; ++m)
    found.push_back({(*m)[2].str(), (*m)[1].str() == "\""});
  return found;
}

/// Describes how an include in a source of `folder` violates the order of layers. Absent if there is no violation.
inline std::optional<std::string> fault_of(const std::string& folder, const Include& include) {
  const LayerOrder& order = layer_order();
  if (!order.contains(folder)) return "folder " + folder + " has no place in the layer order";
  if (include.name.starts_with("floc/")) {
    const std::string rest = include.name.substr(5);
    const std::string target = rest.substr(0, rest.find('/'));
    if (!order.contains(target)) return include.name + ": no such folder in the layer order";
    if (!reachable(order, folder).contains(target)) return folder + " may not include " + include.name;
    return std::nullopt;
  }
  for (const auto& [prefix, owners] : foreign_owners()) {
    if (!include.name.starts_with(prefix) || owners.contains(folder)) continue;
    std::string fault = folder + " may not include <" + include.name + ">";
    for (const std::string& owner : owners) fault += (owner == *owners.begin() ? ", only " : " and ") + owner;
    return fault;
  }
  return std::nullopt;
}

/// Returns every wrong include below `root` (the folder lib/floc), as "folder/file: description".
inline std::vector<std::string> layer_faults(const std::filesystem::path& root) {
  std::vector<std::string> faults;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".h" && extension != ".cc") continue;
    const std::filesystem::path file = entry.path().lexically_relative(root);
    if (file.parent_path().empty()) continue;  // floc.h, the public header, is above all modules
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    for (const Include& include : includes_of(text)) {
      if (const auto fault = fault_of(file.begin()->string(), include))
        faults.push_back(file.string() + ": " + *fault);
      // A quoted header outside floc/ is allowed only if the build generates it. A generated header is not in the
      // source tree.
      else if (include.quoted && std::filesystem::exists(entry.path().parent_path() / include.name))
        faults.push_back(file.string() + ": \"" + include.name + "\" is to be included as \"floc/...\"");
    }
  }
  std::sort(faults.begin(), faults.end());
  return faults;
}

}  // namespace floc::test
