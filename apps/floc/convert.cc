#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

#include "command.h"
#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/sha256.h"
#include "floc/base/version.h"
#include "floc/io/import.h"
#include "floc/io/law_text.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/balance.h"

namespace floc {
namespace {

struct ConvertArguments {
  std::string in;
  std::string out;
  std::string from;
  std::string law;
  std::string columns;
  std::string cell;
  std::string contacts;
  std::string stress;
  std::string units = "reduced";
  int index = 0;
  bool overwrite = false;
};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.emplace_back(trimmed(std::string_view(text).substr(begin, end - begin)));
    begin = end + 1;
  }
  return parts;
}

std::vector<double> parse_numbers(const std::string& option, const std::string& text) {
  std::vector<double> values;
  for (const std::string& word : split(text, ',')) {
    const auto value = parse_number<double>(word);
    if (!value) throw InputError(option, fmt::format("\"{}\", expected a finite number", word));
    values.push_back(*value);
  }
  return values;
}

std::map<std::string, std::string> parse_columns(const std::string& text) {
  std::map<std::string, std::string> columns;
  for (const std::string& word : split(text, ',')) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals + 1 == word.size())
      throw InputError("--columns", fmt::format("\"{}\", expected name=column, as in x=X,y=Y,radius=R", word));
    columns[std::string(trimmed(word.substr(0, equals)))] = trimmed(word.substr(equals + 1));
  }
  return columns;
}

ImportOptions import_options(const ConvertArguments& arguments) {
  ImportOptions options;
  if (!arguments.law.empty()) options.law = parse_law("--law", arguments.law);
  if (!arguments.cell.empty())
    for (const std::string& vector : split(arguments.cell, ';'))
      options.cell.push_back(parse_numbers("--cell", vector));
  if (!arguments.columns.empty()) options.columns = parse_columns(arguments.columns);
  options.contacts = arguments.contacts;
  options.index = arguments.index;
  options.units = arguments.units;
  return options;
}

/// Fills in what the file did not say and an analysis needs.
template <int Dim>
void complete(State<Dim>& state, const Imported& imported, const ConvertArguments& arguments) {
  if (!imported.contacts_known) find_contacts(state.packing);
  if (!arguments.stress.empty()) {
    const std::vector<double> stress = parse_numbers("--stress", arguments.stress);
    if (stress.size() != Dim)
      throw InputError("--stress", fmt::format("has {} numbers, expected {}", stress.size(), Dim));
    for (int a = 0; a < Dim; ++a) state.target_stress[a] = stress[a];
  } else if (!imported.target_stress_known) {
    state.target_stress = static_stress(state.packing).diagonal();
  }
  state.residuals = residuals(state.packing, state.target_stress);
  state.provenance.program = "floc " + version();
  state.provenance.commit = commit();
  state.provenance.compiler = compiler();
  const std::filesystem::path source(arguments.in);
  state.provenance.source = arguments.in == "-" ? "stdin"
                                                : fmt::format("{}, SHA-256 {}", source.filename().string(),
                                                              sha256_of_file(arguments.in));
}

int convert(const ConvertArguments& arguments) {
  if (std::filesystem::path(arguments.out).extension() != ".h5")
    throw InputError(arguments.out, "expected a name that ends in .h5: states are what can be written");
  if (!arguments.overwrite && std::filesystem::exists(arguments.out))
    throw InputError(arguments.out, "exists already; --overwrite replaces it");
  const ImportFormat& format = find_import_format(arguments.from, arguments.in);
  Imported imported = format.read(arguments.in, import_options(arguments));
  std::visit(
      [&](auto& state) {
        complete(state, imported, arguments);
        write_state(arguments.out, state);
        spdlog::info(
            "{}: {} grains, {} contacts, phi = {:.6g}, pressure = {:.6g}, largest net force = {:.2g} F1",
            arguments.out, state.packing.grains.size(), state.packing.contacts.size(),
            solid_fraction(state.packing), static_stress(state.packing).diagonal().mean(),
            state.residuals.force);
      },
      imported.state);
  return kDone;
}

}  // namespace

Command add_convert(CLI::App& program) {
  CLI::App* app = program.add_subcommand("convert", "make a state file from a packing of another program");
  const auto arguments = std::make_shared<ConvertArguments>();
  app->add_option("IN", arguments->in, "file to read, - for stdin")->required();
  app->add_option("OUT", arguments->out, "state file to write, NAME.h5")->required();
  app->add_option("--from", arguments->from, "format of IN: csv or jambashbulk [by name and content]");
  app->add_option("--law", arguments->law,
                  "contact law, e.g. normal.stiffness=1e5,friction.coefficient=0.5,friction.stiffness=1e5");
  app->add_option("--cell", arguments->cell, "lattice vectors of the periodic cell, e.g. \"9.5,0;0.06,9.57\"");
  app->add_option("--columns", arguments->columns, "columns of a csv file, e.g. x=X,y=Y,radius=R");
  app->add_option("--contacts", arguments->contacts,
                  "csv file of contacts: id1, id2[, image1.., normal_force, shear_force1.., rolling_moment] "
                  "[found by geometry]");
  app->add_option(
      "--stress", arguments->stress,
      "diagonal of the stress imposed, compression positive [what IN says, else what the contacts carry]");
  app->add_option("--units", arguments->units, "reduced or SI")->check(CLI::IsMember({"reduced", "SI"}));
  app->add_option("--index", arguments->index, "which packing of a file that holds several")
      ->check(CLI::NonNegativeNumber);
  app->add_flag("--overwrite", arguments->overwrite, "replace OUT if it exists");
  return {app, [arguments] { return convert(*arguments); }};
}

}  // namespace floc
