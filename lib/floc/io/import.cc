#include "floc/io/import.h"

#include <fmt/format.h>

#include <filesystem>

#include "floc/base/error.h"
#include "floc/io/csv_packing.h"
#include "floc/io/jambashbulk.h"

namespace floc {
namespace {

bool is_csv(const std::string& path) {
  return path == "-" || std::filesystem::path(path).extension() == ".csv";
}

}  // namespace

const std::vector<ImportFormat>& import_formats() {
  static const std::vector<ImportFormat> formats = {
      {"csv", "one grain a line, columns x, y[, z] and radius or diameter[, mass, id]", is_csv,
       read_csv_packing},
      {"jambashbulk", "text of the jamBashbulk code (2D, linear repulsion)", is_jambashbulk, read_jambashbulk},
  };
  return formats;
}

const ImportFormat& find_import_format(const std::string& keyword, const std::string& path) {
  std::string known;
  for (const ImportFormat& format : import_formats()) {
    if (keyword.empty() ? format.recognises(path) : format.keyword == keyword) return format;
    known += fmt::format("{}{} ({})", known.empty() ? "" : ", ", format.keyword, format.description);
  }
  if (keyword.empty())
    throw InputError(path, fmt::format("its format is not recognised; say one of {}", known));
  throw InputError("--from", fmt::format("\"{}\" is no format; they are {}", keyword, known));
}

}  // namespace floc
