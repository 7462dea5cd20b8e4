#include <memory>

#include "command.h"
#include "floc/structure/axis_profile.h"
#include "floc/structure/porosity_probe.h"
#include "output.h"
#include "structure_columns.h"
#include "structure_rows.h"

namespace floc {
namespace {

int run_structure(const StructureCommand& command) {
  require_fit_range(command);
  std::vector<StructureRow> rows;
  Series series;
  const int code = for_each_state(command.files, [&](const std::string& file, const AnyState& any) {
    std::visit([&](const auto& state) { rows.push_back(structure_row(file, state, command, series)); }, any);
    return int{kDone};
  });
  if (series.average && rows.size() > 1) rows.push_back(averaged(rows, command, series));
  for (const auto& [path, table] : {std::pair{&command.intensity, &series.intensity},
                                    {&command.pairs, &series.pairs},
                                    {&command.gaps, &series.gaps},
                                    {&command.pores, &series.pores},
                                    {&command.map, &series.map},
                                    {&command.prediction, &series.prediction},
                                    {&command.porosity, &series.porosity},
                                    {&command.profile, &series.profile}})
    if (!path->empty()) write_csv(*path, *table);
  print_table(to_table(structure_columns(), rows), command.format);
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
  app.add_flag("--average", command->average,
               "add a last row for all states together, as samples of one ensemble");
  app.add_option("--fit-range", command->fit_range,
                 "LOW,HIGH: wave numbers fitted, in 2 pi over the largest diameter")
      .delimiter(',')
      .expected(2)
      .show_default();
  app.add_option("--largest-k", command->scattering.largest,
                 "largest wave number, in 2 pi over the largest diameter")
      .positive()
      .show_default();
  app.add_option("--cells-per-wave", command->scattering.cells_per_wave,
                 "mesh cells per wavelength at the largest wave number, at least 4")
      .within(ScatteringOptions::kCellsPerWave)
      .show_default();
  app.add_option("--intensity", command->intensity, "file for I(k), one row per bin of k");
  app.add_option("--pair-correlation", command->pairs, "file for g(r), one row per bin of r");
  app.add_option("--reach", command->reach, "largest r of g(r), in largest diameters")
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
  app.add_option("--map-size", command->map_size, "mesh cells along each lattice vector")
      .delimiter(',')
      .expected(2)
      .within(kMapSide)
      .show_default();
  app.add_option("--porosity", command->porosity,
                 "file for the porosity of cubes about the centre of the cell against their size, and of the "
                 "cell itself, shrunk about its centre");
  app.add_option("--probes", command->n_probes, "number of sizes of these cubes")
      .within(kPorosityProbes)
      .show_default();
  app.add_option(
      "--profile", command->profile,
      "file for solid fraction, coordination and particle pressure in slices of the cell, one row each");
  app.add_option("--profile-axis", command->profile_axis,
                 "lattice vector along which the slices follow each other; the last one unless given")
      .one_of({"x", "y", "z"});
  app.add_option("--slices", command->n_slices, "number of slices of the profile")
      .within(kProfileSlices)
      .show_default();
  add_format_option(app, command->format);
  return {app, [command] { return run_structure(*command); }};
}

}  // namespace floc
