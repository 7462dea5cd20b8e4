#include "floc/run/path_row.h"

#include <fmt/ranges.h>

#include <array>
#include <sstream>

#include "floc/io/table.h"
#include "floc/packing/equilibrium.h"
#include "floc/structure/coordination.h"

namespace floc {
namespace {

const std::vector<std::string> kColumns = {"step",
                                           "branch",
                                           "P_star",
                                           "P",
                                           "phi",
                                           "void_ratio",
                                           "L1",
                                           "L2",
                                           "z",
                                           "z_plus",
                                           "z_minus",
                                           "z_zero",
                                           "n_contacts",
                                           "n_distant",
                                           "x0",
                                           "residual_force",
                                           "residual_moment",
                                           "residual_stress",
                                           "kinetic_energy",
                                           "n_negative",
                                           "time",
                                           "n_steps",
                                           "seconds",
                                           "state",
                                           "ending"};

std::vector<std::string> columns_of(int dimension) {
  std::vector<std::string> columns = kColumns;
  if (dimension == 3) columns.emplace_back("L3");
  return columns;
}

}  // namespace

std::string path_header(int dimension) {
  return fmt::format("{}", fmt::join(columns_of(dimension), ","));
}

template <int Dim>
std::string path_row(const State<Dim>& state, std::optional<double> seconds, const std::string& file) {
  const double pressure = state.target_stress.mean();
  const double phi = solid_fraction(state.packing);
  const double zero_force = state.tolerance.force * force_scale(state.packing, state.target_stress).force;
  const Coordination c = coordination(state.packing, zero_force);
  Table table;
  table.columns = columns_of(Dim);
  table.rows = {{std::int64_t{state.path.step},
                 state.path.branch,
                 reduced_pressure(state.packing, pressure),
                 pressure,
                 phi,
                 1.0 / phi - 1.0,
                 state.packing.cell.matrix(0, 0),
                 state.packing.cell.matrix(1, 1),
                 c.z,
                 c.z_plus,
                 c.z_minus,
                 c.z_zero,
                 std::int64_t{c.n_contacts},
                 std::int64_t{c.n_distant},
                 c.rattler_fraction,
                 state.residuals.force,
                 state.residuals.moment,
                 state.residuals.stress,
                 state.residuals.energy,
                 std::int64_t{state.n_negative},
                 state.path.time,
                 state.path.n_steps,
                 or_undefined(seconds),
                 file,
                 or_undefined(state.path.ending)}};
  if constexpr (Dim == 3) table.rows[0].emplace_back(state.packing.cell.matrix(2, 2));
  std::stringstream text;
  write_table(text, table, TableFormat::csv);
  std::string line;
  std::getline(text, line);  // the header
  std::getline(text, line);
  return line;
}

template std::string path_row(const State<2>&, std::optional<double>, const std::string&);
template std::string path_row(const State<3>&, std::optional<double>, const std::string&);

}  // namespace floc
