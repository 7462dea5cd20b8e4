#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <map>
#include <memory>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/return_freed_memory.h"
#include "floc/base/sha256.h"
#include "floc/base/split.h"
#include "floc/imports/complete_import.h"
#include "floc/imports/conversion_summary.h"
#include "floc/io/export.h"
#include "floc/io/import.h"
#include "floc/io/law_text.h"
#include "floc/io/lmgc90.h"
#include "floc/packing/overlaps.h"
#include "process/command.h"
#include "process/output.h"
#include "process/output_files.h"

namespace floc {
namespace {

struct ConvertArguments {
  std::vector<std::string> files;  ///< input files IN..., followed by the output file OUT
  std::string from;
  std::string to;
  std::string law;
  std::string columns;
  std::string contact_columns;
  std::string cell;
  std::string contacts;
  std::string stress;
  std::string units = "reduced";
  std::string walls;
  std::string wall_masses;
  std::string wall_law;
  std::string wall_ids;
  std::string gravity;
  std::string bonds;
  double touch_gap = 0.0;
  bool pairs_twice = false;
  std::optional<int> dimension;
  std::optional<int> index;
  std::optional<double> tolerance;
  bool drop_tensile = false;
  bool strict = false;
  bool overwrite = false;
};

std::vector<double> parse_numbers(const std::string& option, const std::string& text) {
  std::vector<double> values;
  for (const std::string& item : split(text, ',')) {
    const auto value = parse_number<double>(item);
    if (!value)
      throw InputError(
          option, fmt::format("\"{}\" is not a finite number: expected numbers separated by commas", item));
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
      throw InputError(
          option,
          fmt::format(
              "\"{}\" does not assign a column to a name: expected name=column, for example x=X,y=Y,radius=R",
              item));
    const std::string name(trimmed(item.substr(0, equals)));
    if (!columns.emplace(name, trimmed(item.substr(equals + 1))).second)
      throw InputError(option, fmt::format("{} is given twice: expected one column per name", name));
  }
  return columns;
}

/// Parses the option `--wall-ids`, such as "0=x-,1=x+". Each item is the identifier of a body and the wall that this
/// body forms.
std::map<std::int64_t, WallSide> parse_wall_ids(const std::string& text) {
  std::map<std::int64_t, WallSide> walls;
  for (const auto& [id, name] : parse_columns("--wall-ids", text)) {
    const auto number = parse_number<std::int64_t>(id);
    const auto side = wall_side(name);
    if (!number || !side)
      throw InputError(
          "--wall-ids",
          fmt::format("\"{}={}\": expected the id of a body and a wall, for example 0=x-", id, name));
    walls.emplace(*number, *side);
  }
  return walls;
}

/// Parses the option `--wall-masses`, such as "x+=2,y+=3".
std::vector<std::pair<WallSide, double>> parse_wall_masses(const std::string& text) {
  std::vector<std::pair<WallSide, double>> masses;
  for (const auto& [name, number] : parse_columns("--wall-masses", text)) {
    const auto side = wall_side(name);
    const auto mass = parse_number<double>(number);
    if (!side || !mass || !(*mass > 0.0))
      throw InputError("--wall-masses",
                       fmt::format("\"{}={}\": expected a wall and its mass, a positive number, for example "
                                   "x+=2.5",
                                   name, number));
    masses.emplace_back(*side, *mass);
  }
  return masses;
}

ImportOptions import_options(const ConvertArguments& arguments) {
  ImportOptions options;
  if (!arguments.law.empty()) options.law = parse_law("--law", arguments.law);
  if (!arguments.cell.empty())
    for (const std::string& vector : split(arguments.cell, ';'))
      options.cell.push_back(parse_numbers("--cell", vector));
  if (!arguments.wall_law.empty()) options.wall_law = parse_law("--wall-law", arguments.wall_law);
  if (!arguments.gravity.empty()) options.gravity = parse_numbers("--gravity", arguments.gravity);
  options.walls = arguments.walls;
  options.wall_masses = parse_wall_masses(arguments.wall_masses);
  options.wall_ids = parse_wall_ids(arguments.wall_ids);
  options.bonds = arguments.bonds;
  options.touch_gap = arguments.touch_gap;
  options.pairs_twice = arguments.pairs_twice;
  options.columns = parse_columns("--columns", arguments.columns);
  options.contact_columns = parse_columns("--contact-columns", arguments.contact_columns);
  options.contacts = arguments.contacts;
  options.dimension = arguments.dimension;
  options.index = arguments.index;
  options.units = arguments.units;
  options.drop_tensile = arguments.drop_tensile;
  if (options.dimension && !options.cell.empty() && *options.dimension != static_cast<int>(options.cell.size()))
    throw InputError("--dimension", fmt::format("the dimension of the packing is {}, but --cell has {} lattice "
                                                "vectors: expected one lattice vector per dimension",
                                                *options.dimension, options.cell.size()));
  return options;
}

/// Completes a state that was read from a file of another program. Adds the provenance of the state, and the quantities
/// that floc needs but the file lacks, such as the contact law and the imposed stress.
template <int Dim>
void complete(const std::string& in, const Imported& imported, const ConvertArguments& arguments,
              State<Dim>& state) {
  ImportCompletion completion;
  completion.law_place = arguments.law.empty() ? in : "--law";
  if (!arguments.stress.empty()) completion.stress = parse_numbers("--stress", arguments.stress);
  completion.stress_place = "--stress";
  completion.tolerance = arguments.tolerance;
  completion.touch_gap = arguments.touch_gap;
  const std::string remark = complete_import(in, imported, completion, state);
  if (!remark.empty()) spdlog::info("{}: {}", in, remark);
  const std::filesystem::path source(in);
  // A packing of LMGC90 is a directory, which contains a file of bodies.
  const std::string file = std::filesystem::is_directory(in) ? lmgc90_bodies(in) : in;
  state.provenance.source =
      in == "-" ? "stdin" : fmt::format("{}, SHA-256 {}", source.filename().string(), sha256_of_file(file));
}

template <int Dim>
void report(const std::string& out, const State<Dim>& state) {
  spdlog::info(
      "{}: {} grains in {}D, {} contacts, solid fraction {:.6g}, pressure {:.6g}, largest net force on a grain "
      "{:.2g} times the larger of the pull-off force and P a^(d-1) (P: pressure, a: largest diameter, d: "
      "dimension)",
      out, state.packing.grains.size(), Dim, state.packing.contacts.size(), solid_fraction(state.packing),
      state.stress.diagonal().mean(), state.residuals.force);
  if (const std::string warning = overlap_warning(state.packing); !warning.empty())
    spdlog::warn("{}: warning: {}", out, warning);
}

int convert(const std::string& in, const std::string& out, const ExportFormat& to,
            const ConvertArguments& arguments) {
  std::vector<std::filesystem::path> outputs = {out};
  if (!to.second_extension.empty())
    outputs.push_back(std::filesystem::path(out).replace_extension(to.second_extension));
  for (const std::filesystem::path& output : outputs) require_new_file(output, arguments.overwrite);
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
    spdlog::error(
        "{}: this file was not converted, because --strict accepts no inconsistencies in it; they are listed "
        "above",
        in);
    return kVerificationFailed;
  }
  return_freed_memory();
  to.write(out, imported.state);
  for (const std::string& remark : imported.remarks) spdlog::info("{}: {}", out, remark);
  if (to.lost != nullptr)
    if (const std::vector<std::string> lost = to.lost(imported.state); !lost.empty())
      spdlog::info("{}: files of this format do not hold {}; a state file (.h5) does", out,
                   fmt::join(lost, ", "));
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
      throw InputError(
          out, fmt::format("this is not a directory, but the {} input files need one output file each: give an "
                           "existing directory as the last argument",
                           inputs.size()));
    return convert(inputs[0], out, find_export_format(arguments.to, out), arguments);
  }
  const ExportFormat& to = find_export_format(arguments.to.empty() ? "state" : arguments.to, out);
  if (inputs.size() > 1 && !arguments.contacts.empty())
    throw InputError("--contacts",
                     "the file of contacts belongs to a single packing, but several packings are to be "
                     "converted: convert them one by one");
  const auto output_of = [&](const std::string& in) {
    return (std::filesystem::path(out) / (std::filesystem::path(in).stem().string() + to.extension)).string();
  };
  std::map<std::string, std::string> inputs_of;  // input file of each output file
  for (const std::string& in : inputs)
    if (const auto [first, is_new] = inputs_of.try_emplace(output_of(in), in); !is_new)
      throw InputError(
          first->first,
          fmt::format("both {} and {} would be written to this file: convert one of them to another "
                      "directory",
                      first->second, in));
  return for_each_file(inputs,
                       [&](const std::string& in) { return convert(in, output_of(in), to, arguments); });
}

/// Returns the keywords of the formats, separated by commas.
template <class Format>
std::string keywords(const std::vector<Format>& formats) {
  std::string list;
  for (const Format& format : formats) list += (list.empty() ? "" : ", ") + format.keyword;
  return list;
}

void add_reading_options(CommandLine app, ConvertArguments& arguments) {
  // Each help text ends with the default of the option, in brackets. The default cannot be printed from the variable of
  // the option: the variable is empty in most cases, because the reader of the format of IN sets the default later.
  app.add_option(
      "--from", arguments.from,
      "format of the file IN: " + keywords(import_formats()) + " [recognised from the name and content of IN]");
  app.add_option(
      "--law", arguments.law,
      "contact law, given by keys of the table contact of a scene and their values, separated by commas: "
      "normal.stiffness=1e5,friction.coefficient=0.5");
  app.add_option(
      "--cell", arguments.cell,
      "lattice vectors of the periodic cell, separated by semicolons, e.g. \"9.5,0;0.06,9.57\" (length)");
  app.add_option(
      "--walls", arguments.walls,
      "axes that are not periodic, separated by commas: x (walls at both faces of the box across x), z- or "
      "z+ (a wall at the lower or upper face, and a free surface), z=0:5 (walls at these places), z=0: (a "
      "floor at 0 and a free surface); or an input script of LAMMPS or LIGGGHTS, or an STL file, that has the "
      "walls [the walls given in IN; without walls the packing is periodic or ends in free space]");
  app.add_option("--wall-masses", arguments.wall_masses,
                 "WALL=MASS,...: masses of the walls that forces move, e.g. y+=2.5 for a lid under a load [all "
                 "walls stay where they are]");
  app.add_option("--wall-law", arguments.wall_law,
                 "contact law between grains and walls, given as for --law [the law between grains]");
  app.add_option(
      "--wall-ids", arguments.wall_ids,
      "ID=WALL,...: identifiers of the bodies that are walls in the file of contacts, e.g. 0=x-,1=x+,2=z-");
  app.add_option("--gravity", arguments.gravity,
                 "components of the acceleration due to gravity, separated by commas, e.g. 0,0,-9.81 "
                 "[as given in IN, otherwise none]");
  app.add_option("--columns", arguments.columns,
                 "NAME=COLUMN,...: header of the column that contains each quantity, for a csv file of grains, "
                 "e.g. x=X,y=Y,radius=R")
      .joined(',');
  app.add_option("--contacts", arguments.contacts,
                 "file of the contacts: csv with the columns id1, id2 and optionally image1.., normal_force, "
                 "shear_force1.., rolling_moment.., twisting_moment; or a LAMMPS dump of style local; or YADE "
                 "interactions [contacts are found from the positions and radii]");
  app.add_option("--bonds", arguments.bonds,
                 "file of bonds, which has the formats of a file of contacts: bonds act across gaps with their "
                 "own stiffnesses kn, kt, kr and ktw; a bond without a given force is unstressed");
  app.add_option("--touch-gap", arguments.touch_gap,
                 "largest gap (length) at which grains and walls count as touching if contacts are found from "
                 "the geometry; contacts with a gap get no force [0]")
      .non_negative();
  app.add_flag("--pairs-twice", arguments.pairs_twice,
               "merge contacts that IN or the file of contacts lists twice, once from each grain");
  app.add_option(
         "--contact-columns", arguments.contact_columns,
         "NAME=COLUMN,...: header of the column that contains each quantity, for the file of contacts, e.g. "
         "id1=c_pair[1],id2=c_pair[2],force1=c_force[1],...")
      .joined(',');
  app.add_option("--stress", arguments.stress,
                 "diagonal components of the imposed stress, separated by commas, positive in compression [the "
                 "stress given in IN or, without it, the stress carried by the contacts]");
  app.add_option(
         "--tolerance", arguments.tolerance,
         "tolerance within which the packing in IN counts as being in equilibrium: largest net force in units "
         "of "
         "F1, net moment in units of F1 a, and "
         "error of the stress in units of F1/a^(d-1); F1 is the larger of the pull-off force F0 and P a^(d-1) "
         "(P: pressure, a: largest diameter, d: dimension) [1e-3; for the format jambashbulk 1e-5]")
      .positive();
  app.add_flag("--drop-tensile", arguments.drop_tensile,
               "leave out contacts that are in tension although the contact law has no adhesion [a file with "
               "such contacts is rejected]");
  app.add_flag("--strict", arguments.strict,
               "write nothing and exit with code 5 if the listed contacts, the geometry, the forces, the "
               "contact law and the equilibrium in IN contradict each other [print a warning]");
  app.add_option("--units", arguments.units, "system of units of IN: reduced or SI [reduced]")
      .one_of({"reduced", "SI"});
  app.add_option("--dimension", arguments.dimension,
                 "dimension of the packing: 2 or 3 [2 if all grains have equal z coordinates, otherwise 3]")
      .one_of_integers({2, 3});
  app.add_option(
         "--index", arguments.index,
         "number, counted from 0, of the packing or frame to read from a file with several of them [the last "
         "one; for the format jambashbulk the first one]")
      .non_negative();
}

}  // namespace

Command add_convert(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "convert", "Convert a packing of another program to a state file, or a state file to another format");
  const auto arguments = std::make_shared<ConvertArguments>();
  app.add_option(
         "IN... OUT", arguments->files,
         "input files (- for stdin), followed by the output file; with several input files, OUT is a directory")
      .required()
      .expected(2, -1);
  app.add_option("--to", arguments->to,
                 "format of the output: " + keywords(export_formats()) +
                     " [according to the extension of OUT; state if OUT is a directory]");
  add_reading_options(app, *arguments);
  app.add_flag("--overwrite", arguments->overwrite, "replace output files that exist already");
  return {app, [arguments] { return run_convert(*arguments); }};
}

}  // namespace floc
