#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "floc/io/table.h"

namespace floc {

/// Remembers files that the command reads, so that write_output() does not replace them. Names that are not the names
/// of existing regular files are ignored.
void remember_inputs(const std::vector<std::string>& paths);

/// Calls a function that writes a result of a command to a file.
/// @throws InputError if the file is an input of the command (remember_inputs()), or a regular file to which the
/// command has already written another result
void write_once(const std::string& path, const std::function<void()>& write);

/// Writes a result of a command to a file, as write_bytes_atomically() does.
/// @throws InputError under the conditions of write_once(), and if the file is a state file, which a table or a picture
/// would destroy
/// @throws IoError if the file cannot be written
void write_output(const std::string& path, std::string_view bytes);

/// Checks, before anything is computed, that an output may be written.
/// @param overwrite  whether the user allows to replace the file
/// @throws InputError if the file exists and may not be replaced
void require_new_file(const std::filesystem::path& path, bool overwrite);

/// Writes a table as csv, as write_output() does.
void write_csv(const std::string& path, const Table& table);

/// Writes a table as csv, except if the command failed and the table has no rows. The file then keeps what it
/// contained.
/// @param code  exit code of the command
void write_csv_unless_failed(const std::string& path, const Table& table, int code);

}  // namespace floc
