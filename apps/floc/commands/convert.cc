#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/return_freed_memory.h"
#include "floc/base/sha256.h"
#include "floc/imports/complete_import.h"
#include "floc/imports/conversion_summary.h"
#include "floc/io/export.h"
#include "floc/io/import.h"
#include "floc/io/law_text.h"
#include "floc/packing/overlaps.h"
#include "process/command.h"
#include "process/output.h"

namespace floc {
namespace {

struct ConvertArguments {
  std::vector<std::string> files;  ///< IN..., then OUT
  std::string from;
  std::string to;
  std::string law;
  std::string columns;
  std::string contact_columns;
  std::string cell;
  std::string contacts;
  std::string stress;
  std::string units = "reduced";
  std::optional<int> dimension;
  std::optional<int> index;
  std::optional<double> tolerance;
  bool drop_tensile = false;
  bool strict = false;
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
  for (const std::string& item : split(text, ',')) {
    const auto value = parse_number<double>(item);
    if (!value) throw InputError(option, fmt::format("\"{}\", expected a finite number", item));
    values.push_back(*value);
  }
  return values;
}

std::map<std::string, std::string> parse_columns(const std::string& option, const std::string& text) {
  std::map<std::string, std::string> columns;
  if (text.empty()) return columns;
  for (const std::string& item : split(text, ',')) {
    const std::size_t equals = item.find('=');
    if (equals == std::string::npos || equals + 1 == item.size())
      throw InputError(option, fmt::format("\"{}\", expected name=column, as in x=X,y=Y,radius=R", item));
    const std::string name(trimmed(item.substr(0, equals)));
    if (!columns.emplace(name, trimmed(item.substr(equals + 1))).second)
      throw InputError(option, fmt::format("{} is given twice", name));
  }
  return columns;
}

ImportOptions import_options(const ConvertArguments& arguments) {
  ImportOptions options;
  if (!arguments.law.empty()) options.law = parse_law("--law", arguments.law);
  if (!arguments.cell.empty())
    for (const std::string& vector : split(arguments.cell, ';'))
      options.cell.push_back(parse_numbers("--cell", vector));
  options.columns = parse_columns("--columns", arguments.columns);
  options.contact_columns = parse_columns("--contact-columns", arguments.contact_columns);
  options.contacts = arguments.contacts;
  options.dimension = arguments.dimension;
  options.index = arguments.index;
  options.units = arguments.units;
  options.drop_tensile = arguments.drop_tensile;
  if (options.dimension && !options.cell.empty() && *options.dimension != static_cast<int>(options.cell.size()))
    throw InputError("--dimension",
                     fmt::format("{}, but --cell has {} vectors", *options.dimension, options.cell.size()));
  return options;
}

/// Completes a state with quantities that the file lacks and an analysis needs, and with its provenance.
template <int Dim>
void complete(const std::string& in, const Imported& imported, const ConvertArguments& arguments,
              State<Dim>& state) {
  ImportCompletion completion;
  completion.law_place = arguments.law.empty() ? in : "--law";
  if (!arguments.stress.empty()) completion.stress = parse_numbers("--stress", arguments.stress);
  completion.stress_place = "--stress";
  completion.tolerance = arguments.tolerance;
  const std::string remark = complete_import(in, imported, completion, state);
  if (!remark.empty()) spdlog::info("{}: {}", in, remark);
  const std::filesystem::path source(in);
  state.provenance.source =
      in == "-" ? "stdin" : fmt::format("{}, SHA-256 {}", source.filename().string(), sha256_of_file(in));
}

template <int Dim>
void report(const std::string& out, const State<Dim>& state) {
  spdlog::info(
      "{}: {} grains in {}D, {} contacts, phi = {:.6g}, pressure = {:.6g}, largest net force = {:.2g} F1", out,
      state.packing.grains.size(), Dim, state.packing.contacts.size(), solid_fraction(state.packing),
      state.stress.diagonal().mean(), state.residuals.force);
  if (const std::string warning = overlap_warning(state.packing); !warning.empty())
    spdlog::warn("{}: warning: {}", out, warning);
}

int convert(const std::string& in, const std::string& out, const ExportFormat& to,
            const ConvertArguments& arguments) {
  if (!arguments.overwrite && std::filesystem::exists(out))
    throw InputError(out, "exists already; --overwrite replaces it");
  const ImportFormat& from = find_import_format(arguments.from, in);
  Imported imported = from.read(in, import_options(arguments));
  ConversionSummary summary;
  std::visit(
      [&](auto& state) {
        if (!imported.complete) complete(in, imported, arguments, state);
        summary = summarize(imported, state);
      },
      imported.state);
  if (arguments.strict && !summary.inconsistencies.empty()) {
    for (const std::string& doubt : summary.inconsistencies) spdlog::error("{}: {}", in, doubt);
    spdlog::error("{}: not converted: --strict accepts none of this", in);
    return kVerificationFailed;
  }
  return_freed_memory();
  to.write(out, imported.state);
  for (const std::string& remark : imported.remarks) spdlog::info("{}: {}", out, remark);
  for (const std::string& line : summary.lines) spdlog::info("{}: {}", out, line);
  std::visit([&](const auto& state) { report(out, state); }, imported.state);
  for (const std::string& doubt : summary.inconsistencies) spdlog::warn("{}: warning: {}", out, doubt);
  return kDone;
}

int run_convert(const ConvertArguments& arguments) {
  const std::vector<std::string> inputs(arguments.files.begin(), arguments.files.end() - 1);
  const std::string& out = arguments.files.back();
  if (!std::filesystem::is_directory(out)) {
    if (inputs.size() > 1)
      throw InputError(out, fmt::format("is not a directory: {} packings can only be written into a directory",
                                        inputs.size()));
    return convert(inputs[0], out, find_export_format(arguments.to, out), arguments);
  }
  const ExportFormat& to = find_export_format(arguments.to.empty() ? "state" : arguments.to, out);
  if (inputs.size() > 1 && !arguments.contacts.empty())
    throw InputError("--contacts", "belongs to one packing: convert them one by one");
  return for_each_file(inputs, [&](const std::string& in) {
    const std::string name = std::filesystem::path(in).stem().string() + to.extension;
    return convert(in, (std::filesystem::path(out) / name).string(), to, arguments);
  });
}

/// Returns the keywords of a list of formats.
template <class Format>
std::string keywords(const std::vector<Format>& formats) {
  std::string list;
  for (const Format& format : formats) list += (list.empty() ? "" : ", ") + format.keyword;
  return list;
}

void add_reading_options(CommandLine app, ConvertArguments& arguments) {
  // Brackets at the end of a help text hold the default. Defaults that depend on the format of IN are set by its
  // reader, so most variables begin empty.
  app.add_option("--from", arguments.from,
                 "format of IN: " + keywords(import_formats()) + " [by name and content]");
  app.add_option("--law", arguments.law,
                 "contact law, e.g. normal.stiffness=1e5,friction.coefficient=0.5,friction.stiffness=1e5");
  app.add_option("--cell", arguments.cell, "lattice vectors of the periodic cell, e.g. \"9.5,0;0.06,9.57\"");
  app.add_option("--columns", arguments.columns, "columns of the grains, e.g. x=X,y=Y,radius=R").joined(',');
  app.add_option(
      "--contacts", arguments.contacts,
      "file of contacts [found by geometry]: csv with id1, id2[, image1.., normal_force, shear_force1.., "
      "rolling_moment.., twisting_moment]; a LAMMPS dump of style local; YADE interactions");
  app.add_option("--contact-columns", arguments.contact_columns,
                 "columns of the contacts, e.g. id1=c_pair[1],id2=c_pair[2],force1=c_force[1],...")
      .joined(',');
  app.add_option("--stress", arguments.stress,
                 "diagonal of the imposed stress, positive in compression [as IN says, otherwise what the "
                 "contacts carry]");
  app.add_option(
         "--tolerance", arguments.tolerance,
         "how far from equilibrium IN may be: net force / F1, net moment / (F1 a), stress / (F1/a^(d-1)) "
         "[1e-3; jambashbulk: 1e-5]")
      .positive();
  app.add_flag("--drop-tensile", arguments.drop_tensile,
               "leave out listed contacts that pull under a law without adhesion [they are refused]");
  app.add_flag("--strict", arguments.strict,
               "write nothing and exit with code 5 if list, geometry, forces, law and equilibrium disagree [a "
               "warning is printed]");
  app.add_option("--units", arguments.units, "reduced or SI").one_of({"reduced", "SI"});
  app.add_option("--dimension", arguments.dimension, "2 or 3 [2 if every z is the same]")
      .one_of_integers({2, 3});
  app.add_option(
         "--index", arguments.index,
         "which packing or frame of a file that holds several, from 0 [the last; jambashbulk: the first]")
      .non_negative();
}

}  // namespace

Command add_convert(CommandLine program) {
  CommandLine app =
      program.add_subcommand("convert", "Make a state file from another program's packing, or the reverse");
  const auto arguments = std::make_shared<ConvertArguments>();
  app.add_option(
         "IN... OUT", arguments->files,
         "files to read, - for stdin, and the file to write; several are written into the directory OUT")
      .required()
      .expected(2, -1);
  app.add_option("--to", arguments->to,
                 "format of OUT: " + keywords(export_formats()) + " [by its extension; state in a directory]");
  add_reading_options(app, *arguments);
  app.add_flag("--overwrite", arguments->overwrite, "replace existing files");
  return {app, [arguments] { return run_convert(*arguments); }};
}

}  // namespace floc
