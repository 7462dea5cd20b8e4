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
  std::string profile_axis;  ///< axis of the profile; empty: the last
  /// Files of the tables beside the main one; empty: none.
  std::string intensity, pairs, gaps, pores, map, prediction, porosity, profile;
  Printing printing;
};

/// Returns the options of the library, with the tables whose files the command line names.
/// @throws InputError naming the option at fault
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
    if (!path->empty()) write_csv(*path, *table);
  print_table(to_table(structure_columns(), rows), command.printing);
  return code;
}

}  // namespace

Command add_structure(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "structure",
      "Describe the structure of saved states: I(k) with xi and dF, pores, g(r), z(h), local "
      "solid fraction");
  const auto command = std::make_shared<StructureCommand>();
  add_states_argument(app, command->files);
  app.add_flag("--average", command->options.average,
               "add a last row for all states together, as samples of one ensemble");
  app.add_option("--fit-range", command->options.fit_range,
                 "LOW,HIGH: wave numbers fitted, in 2 pi over the largest diameter")
      .delimiter(',')
      .expected(2)
      .show_default();
  app.add_option("--largest-k", command->options.scattering.largest,
                 "largest wave number, in 2 pi over the largest diameter")
      .positive()
      .show_default();
  app.add_option("--cells-per-wave", command->options.scattering.cells_per_wave,
                 "mesh cells per wavelength at the largest wave number, at least 4")
      .within(ScatteringOptions::kCellsPerWave)
      .show_default();
  // A table beside the main one is computed only if its file is named: see options_of().
  app.add_option("--intensity", command->intensity, "file for I(k), one row per bin of k");
  app.add_option("--pair-correlation", command->pairs, "file for g(r), one row per bin of r");
  app.add_option("--reach", command->options.reach, "largest r of g(r), in largest diameters")
      .positive()
      .show_default();
  app.add_option("--gaps", command->gaps,
                 "file for z(h), neighbours within a gap h: rattlers as found, and pushed against the others");
  app.add_option("--prediction", command->prediction,
                 "file for P and z that the first state would have if it were uniformly shrunk or expanded to "
                 "the solid fraction of each state");
  app.add_option("--pores", command->pores, "file for the pores (3D: balls in the voids), one row each");
  app.add_option("--map", command->map,
                 "file for the local solid fraction, one row per mesh cell (3D: Voronoi cell)");
  app.add_option("--map-size", command->options.map_size, "mesh cells along each lattice vector")
      .delimiter(',')
      .expected(2)
      .within(kMapSide)
      .show_default();
  app.add_option("--porosity", command->porosity,
                 "file for the porosity of cubes about the centre of the cell against their size, and of the "
                 "cell itself, shrunk about its centre");
  app.add_option("--probes", command->options.n_probes, "number of sizes of these cubes")
      .within(kPorosityProbes)
      .show_default();
  app.add_option(
      "--profile", command->profile,
      "file for solid fraction, coordination and particle pressure in slices of the cell, one row each");
  app.add_option("--profile-axis", command->profile_axis,
                 "lattice vector along which the slices follow each other; the last one unless given")
      .one_of({"x", "y", "z"});
  app.add_option("--slices", command->options.n_slices, "number of slices of the profile")
      .within(kProfileSlices)
      .show_default();
  add_printing_options(app, command->printing);
  return {app, [command] { return run_structure(*command); }};
}

}  // namespace floc
