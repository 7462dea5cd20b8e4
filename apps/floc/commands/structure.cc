#include <memory>

#include "floc/base/error.h"
#include "floc/structure/axis_profile.h"
#include "floc/structure/porosity_probe.h"
#include "floc/tables/structure_columns.h"
#include "floc/tables/structure_rows.h"
#include "process/command.h"
#include "process/output.h"
#include "process/printing.h"
#include "process/repeated_warnings.h"

namespace floc {
namespace {

struct StructureCommand {
  std::vector<std::string> files;
  StructureTableOptions options;
  std::string profile_axis;  ///< axis of the profile, "x", "y" or "z"; if empty, the last axis
  /// Names of the csv files of the tables that are written in addition to the printed table; a table with an empty name
  /// is not written.
  std::string intensity, pairs, gaps, pores, map, prediction, porosity, profile;
  Printing printing;
};

/// Converts the command line to the options of the library. In addition to the printed table, only the tables for which
/// the command line names a file are computed.
/// @throws InputError that names the invalid option
StructureTableOptions options_of(const StructureCommand& command) {
  StructureTableOptions options = command.options;
  for (const auto& [asked, path] : {std::pair{&options.intensity, &command.intensity},
                                    {&options.pairs, &command.pairs},
                                    {&options.gaps, &command.gaps},
                                    {&options.pores, &command.pores},
                                    {&options.map, &command.map},
                                    {&options.prediction, &command.prediction},
                                    {&options.porosity, &command.porosity},
                                    {&options.profile, &command.profile}})
    *asked = !path->empty();
  if (!command.profile_axis.empty())
    options.profile_axis = static_cast<int>(std::string("xyz").find(command.profile_axis));
  for (const std::string& fault : options.validate()) throw InputError("floc structure", "--" + fault);
  return options;
}

int run_structure(const StructureCommand& command) {
  const StructureTableOptions options = options_of(command);
  std::vector<StructureRow> rows;
  Series series;
  const int code = for_each_state(command.files, [&](const std::string& file, const AnyState& any,
                                                     const Remarks& remarks) {
    std::visit([&](const auto& state) { rows.push_back(structure_row(file, state, options, series, remarks)); },
               any);
    return int{kDone};
  });
  if (series.average && rows.size() > 1) rows.push_back(averaged(rows, options, series, printed_remarks()));
  for (const auto& [path, table] : {std::pair{&command.intensity, &series.intensity},
                                    {&command.pairs, &series.pairs},
                                    {&command.gaps, &series.gaps},
                                    {&command.pores, &series.pores},
                                    {&command.map, &series.map},
                                    {&command.prediction, &series.prediction},
                                    {&command.porosity, &series.porosity},
                                    {&command.profile, &series.profile}})
    if (!path->empty()) write_csv_unless_failed(*path, *table, code);
  print_table(to_table(structure_columns(), rows), command.printing);
  return code;
}

}  // namespace

Command add_structure(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "structure",
      "Describe the structure of saved states: scattered intensity I(k) with correlation length xi and fractal "
      "dimension dF, pores, pair correlation g(r), neighbours z(h) within a gap h, local solid fraction");
  const auto command = std::make_shared<StructureCommand>();
  add_states_argument(app, command->files);
  app.add_flag("--average", command->options.average,
               "add a last row with averages over all states, which are taken as samples of one ensemble");
  app.add_option(
         "--fit-range", command->options.fit_range,
         "LOW,HIGH: range of wave numbers in which I(k) is fitted, in units of 2 pi/a (a: largest diameter)")
      .delimiter(',')
      .expected(2)
      .show_default();
  app.add_option("--largest-k", command->options.scattering.largest,
                 "largest wave number k of I(k), in units of 2 pi/a (a: largest diameter)")
      .positive()
      .show_default();
  app.add_option("--cells-per-wave", command->options.scattering.cells_per_wave,
                 "number of mesh cells per wavelength at the largest wave number of I(k) (at least 4)")
      .within(ScatteringOptions::kCellsPerWave)
      .show_default();
  // Each of the following options names the file for a table. A table without a file is not computed, see options_of().
  app.add_option("--intensity", command->intensity,
                 "csv file to write, with one row per bin of the wave number k: scattered intensity I(k)");
  app.add_option("--pair-correlation", command->pairs,
                 "csv file to write, with one row per bin of the distance r: pair correlation function g(r)");
  app.add_option("--reach", command->options.reach, "largest distance r of g(r), in largest diameters")
      .positive()
      .show_default();
  app.add_option("--gaps", command->gaps,
                 "csv file to write: mean number z(h) of neighbours within a gap h, once with rattlers at "
                 "their positions in the state, "
                 "once with rattlers pushed against other grains");
  app.add_option("--prediction", command->prediction,
                 "csv file to write, with one row per state: its pressure P and coordination z, and "
                 "the P and z that the first state would have after a uniform deformation to the "
                 "solid fraction of this state");
  app.add_option("--pores", command->pores,
                 "csv file to write, with one row per pore (in 3D, per ball that fits in the voids): its "
                 "position and size");
  app.add_option(
      "--map", command->map,
      "csv file to write, with one row per mesh cell (in 3D, per Voronoi cell): local solid fraction");
  app.add_option("--map-size", command->options.map_size,
                 "number of mesh cells of --map along each lattice vector, in 2D")
      .delimiter(',')
      .expected(2)
      .within(kMapSide)
      .show_default();
  app.add_option("--porosity", command->porosity,
                 "csv file to write: porosity in cubes of different sizes around the centre of the cell, and "
                 "in smaller copies of the cell around its centre");
  app.add_option("--probes", command->options.n_probes, "number of different sizes of the cubes of --porosity")
      .within(kPorosityProbes)
      .show_default();
  app.add_option("--profile", command->profile,
                 "csv file to write, with one row per slice of the cell: solid fraction, coordination and "
                 "particle pressure");
  app.add_option("--profile-axis", command->profile_axis,
                 "lattice vector along which the cell is divided into slices [the last one]")
      .one_of({"x", "y", "z"});
  app.add_option("--slices", command->options.n_slices, "number of slices of --profile")
      .within(kProfileSlices)
      .show_default();
  add_printing_options(app, command->printing);
  return {app, [command] { return run_structure(*command); }};
}

}  // namespace floc
