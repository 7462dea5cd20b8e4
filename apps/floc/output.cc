#include "output.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>

#include "command.h"
#include "floc/base/error.h"

namespace floc {

void add_format_option(CommandLine app, std::string& format) {
  app.add_option("--format", format, "table, csv or json [table on a terminal, csv otherwise]")
      .one_of({"table", "csv", "json"});
}

TableFormat chosen_format(const std::string& format) {
  if (format == "json") return TableFormat::json;
  if (format == "csv") return TableFormat::csv;
  if (format == "table") return TableFormat::table;
  return isatty(STDOUT_FILENO) ? TableFormat::table : TableFormat::csv;
}

void print_table(const Table& table, const std::string& format) {
  write_table(std::cout, table, chosen_format(format));
  std::cout.flush();
  if (!std::cout) throw IoError("standard output", "cannot be written");
}

void write_csv(const std::string& path, const Table& table) {
  std::ofstream out(path, std::ios::binary);
  write_table(out, table, TableFormat::csv);
  out.close();
  if (!out) throw IoError(path, "cannot be written");
}

int worse(int a, int b) {
  constexpr std::array<int, 6> kFromBest = {kDone,    kVerificationFailed, kNotConverged, kBadInput,
                                            kFailure, kInterrupted};
  const auto rank = [&](int code) { return std::find(kFromBest.begin(), kFromBest.end(), code); };
  return rank(a) < rank(b) ? b : a;
}

void add_states_argument(CommandLine app, std::vector<std::string>& files) {
  app.add_option("STATE", files, "state files, - for one on stdin").required();
}

int for_each_file(const std::vector<std::string>& files,
                  const std::function<int(const std::string& file)>& work) {
  int code = kDone;
  const auto report = [&code](int failure, const std::string& message) {
    std::cerr << "floc: " << message << '\n';
    code = worse(code, failure);
  };
  for (const std::string& file : files) {
    try {
      code = worse(code, work(file));
    } catch (const InputError& error) {
      const std::string message = error.what();  // what finds a fault in a packing may not know its file
      report(kBadInput, message.find(file) == std::string::npos ? file + ": " + message : message);
    } catch (const IoError& error) {
      report(kFailure, error.what());
    } catch (const std::exception& error) {
      report(kFailure, file + ": " + error.what());
    }
  }
  return code;
}

int for_each_state(const std::vector<std::string>& files,
                   const std::function<int(const std::string& file, const AnyState& state)>& work) {
  return for_each_file(files, [&](const std::string& file) { return work(file, read_state(file)); });
}

}  // namespace floc
