#include <dlfcn.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "floc/base/error.h"
#include "floc/base/read_file.h"
#include "floc/prices/price_table.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

/// Possible paths of the folder of tables, relative to a folder above the program: the first in an installation, the
/// second in the build tree.
constexpr const char* kPlaces[] = {"share/floc/tables/tradeoff", "apps/share/floc/tables/tradeoff"};

/// Number of parent folders of the program or library that are searched for the folder of tables. For example, a module
/// of the Python package is a file in PREFIX/lib/python3/dist-packages/floc, so that its fifth parent folder is the
/// prefix of the installation.
constexpr int kFoldersAbove = 5;

/// Returns two paths: the path of the file that contains this code (the program or, in Python, a module), and the path
/// of the running program.
std::vector<fs::path> binaries() {
  std::vector<fs::path> found;
  std::error_code failed;
  Dl_info about{};
  if (dladdr(reinterpret_cast<const void*>(&price_folder), &about) != 0 && about.dli_fname != nullptr)
    if (const fs::path file = fs::canonical(about.dli_fname, failed); !failed) found.push_back(file);
  if (const fs::path file = fs::read_symlink("/proc/self/exe", failed); !failed) found.push_back(file);
  return found;
}

/// Whether a file is a table of prices: a csv file whose first column has the name that `floc tradeoff` writes.
bool is_price_table(const fs::path& file) {
  if (file.extension() != ".csv") return false;
  std::ifstream in(file);
  std::string line;
  return std::getline(in, line) && line.starts_with("knob,");
}

}  // namespace

std::string price_folder() {
  for (const fs::path& file : binaries()) {
    fs::path folder = file.parent_path();
    for (int k = 0; k < kFoldersAbove && folder.has_relative_path(); ++k, folder = folder.parent_path())
      for (const char* place : kPlaces)
        if (std::error_code failed; fs::is_directory(folder / place, failed)) return (folder / place).string();
  }
  throw InputError(
      "share/floc/tables/tradeoff",
      "the folder with the tables of errors and costs of numerical settings was not found in any folder above "
      "the program: install floc again, or give a table that floc tradeoff has written (--prices FILE)");
}

std::vector<std::string> priced_kinds() {
  std::vector<std::string> kinds;
  for (const fs::directory_entry& entry : fs::directory_iterator(price_folder()))
    if (is_price_table(entry.path())) kinds.push_back(entry.path().stem().string());
  std::sort(kinds.begin(), kinds.end());
  return kinds;
}

std::optional<PriceTable> shipped_prices(const std::string& kind) {
  // A campaign needs the table of its kind for each of its cases, so a table is read only once.
  static std::mutex mutex;
  static std::map<std::string, PriceTable> tables;
  const std::lock_guard lock(mutex);
  if (const auto known = tables.find(kind); known != tables.end()) return known->second;
  const fs::path file = fs::path(price_folder()) / (kind + ".csv");
  if (!fs::is_regular_file(file)) return std::nullopt;
  PriceTable table = read_price_table(read_file(file.string()), file.string());
  table.is_shipped = true;
  if (table.kind != kind)
    throw InputError(file.string(),
                     "this table describes scenes of the kind " + table.kind + ": expected " + kind);
  return tables.emplace(kind, std::move(table)).first->second;
}

}  // namespace floc
