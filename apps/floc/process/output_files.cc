#include "process/output_files.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <system_error>

#include "floc/base/error.h"
#include "floc/base/read_file.h"
#include "floc/io/atomic_file.h"
#include "process/command.h"

namespace floc {
namespace {

std::vector<std::filesystem::path>& inputs() {
  static std::vector<std::filesystem::path> paths;
  return paths;
}

std::vector<std::filesystem::path>& outputs() {
  static std::vector<std::filesystem::path> paths;
  return paths;
}

/// Returns whether a path names the same file as one of the given paths.
bool is_one_of(const std::vector<std::filesystem::path>& paths, const std::string& path) {
  return std::ranges::any_of(paths, [&](const std::filesystem::path& other) {
    std::error_code error;
    return std::filesystem::equivalent(other, path, error) && !error;
  });
}

/// Returns whether a file exists and is in the format of state files. A file that cannot be read is no such file.
bool is_existing_state(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  try {
    return is_hdf5(path);
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

void remember_inputs(const std::vector<std::string>& paths) {
  std::error_code error;
  for (const std::string& path : paths)
    if (std::filesystem::is_regular_file(path, error)) inputs().emplace_back(path);
}

void write_once(const std::string& path, const std::function<void()>& write) {
  if (is_one_of(inputs(), path))
    throw InputError(path,
                     "this file is an input of the command, which the output would replace: expected another "
                     "name for the output");
  if (is_one_of(outputs(), path))
    throw InputError(
        path,
        "the command has already written another of its outputs to this file: expected a different "
        "name for each output");
  write();
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) outputs().emplace_back(path);
}

void write_output(const std::string& path, std::string_view bytes) {
  write_once(path, [&] {
    if (is_existing_state(path))
      throw InputError(path,
                       "this file is a state or another file of HDF5, which the output would replace: expected "
                       "another name for the output");
    write_bytes_atomically(path, bytes);
  });
}

void require_new_file(const std::filesystem::path& path, bool overwrite) {
  std::error_code error;
  if (!overwrite && std::filesystem::exists(path, error))
    throw InputError(path.string(), "this file exists already; give --overwrite to replace it");
}

void write_csv(const std::string& path, const Table& table) {
  if (path == "-")
    throw InputError(path,
                     "this name means standard output, which already receives the first table of this command: "
                     "expected the name of a file");
  std::ostringstream text;
  write_table(text, table, TableFormat::csv);
  write_output(path, text.str());
}

void write_csv_unless_failed(const std::string& path, const Table& table, int code) {
  if (code == kDone || !table.rows.empty()) write_csv(path, table);
}

}  // namespace floc
