#include "floc/tables/lattice_row.h"

#include <fmt/format.h>

#include <array>

#include "floc/tables/column.h"

namespace floc {
namespace {

/// Builds a table with a single row, one column after another.
class Cells {
 public:
  void add(const std::string& name, TableValue value) {
    table_.columns.push_back(name);
    values_.push_back(std::move(value));
  }
  void add_count(const std::string& name, std::int64_t n) { add(name, n); }

  Table take() {
    table_.rows.push_back(std::move(values_));
    return std::move(table_);
  }

 private:
  Table table_;
  std::vector<TableValue> values_;
};

/// Returns the names of the components of strain and stress. A name consists of the numbers of the two axes: "11",
/// "22", "12" in 2D, and "11", "22", "33", "23", "13", "12" in 3D.
std::vector<std::string> component_names(int dimension) {
  if (dimension == 2) return {"11", "22", "12"};
  return {"11", "22", "33", "23", "13", "12"};
}

void add_sample(const LatticeRow& r, Cells& cells) {
  cells.add("file", r.file);
  cells.add_count("dimension", r.dimension);
  cells.add_count("n_grains", r.n_grains);
  cells.add_count("n_nodes", r.n_nodes);
  cells.add_count("n_unknowns", r.n_unknowns);
  cells.add_count("n_elements", r.n_elements);
  cells.add("spacing", r.spacing);
  cells.add("nodes_a_diameter", r.nodes_a_diameter);
  cells.add("fit_strain", r.fit_strain);
  cells.add("rho_p", r.grain_content);
  cells.add("rho_m", r.matrix_content);
  cells.add("bridge_width", r.bridge_width);
  cells.add_count("n_bridges", r.n_bridges);
  cells.add_count("n_removed", r.n_removed);
  cells.add_count("n_islands", r.n_islands);
  cells.add("k_grain", r.k_grain);
  cells.add("k_matrix", r.k_matrix);
  cells.add("k_interface", r.k_interface);
  cells.add("k_contact", r.k_contact);
}

void add_solution(const LatticeRow& r, Cells& cells) {
  cells.add("load", r.load);
  cells.add("axis", std::string(1, static_cast<char>('x' + r.axis)));
  cells.add("boundary", r.boundary);
  cells.add("holds", r.report.holds);
  cells.add("converged", r.report.converged);
  cells.add_count("n_bare", r.n_bare);
  cells.add_count("n_open", r.n_open);
  cells.add_count("n_rounds", r.report.n_rounds + 1);
  cells.add_count("n_steps", r.report.n_steps);
  cells.add_count("n_factors", r.report.n_factors);
  cells.add("imbalance", r.report.imbalance);
  const std::vector<std::string> names = component_names(r.dimension);
  for (std::size_t a = 0; a < names.size(); ++a) cells.add("strain" + names[a], r.strain[a]);
  for (std::size_t a = 0; a < names.size(); ++a) cells.add("stress" + names[a], r.stress[a]);
  const double strain = r.strain[static_cast<std::size_t>(r.axis)];
  cells.add("E", r.loaded_along_axis && strain != 0.0
                     ? TableValue{r.stress[static_cast<std::size_t>(r.axis)] / strain}
                     : TableValue{});
}

void add_distribution(const std::string& of, const StressDistribution& d, Cells& cells) {
  cells.add_count("count_" + of, d.n);
  cells.add("mean_" + of, d.mean);
  cells.add("spread_" + of, d.spread);
  cells.add("other_share_" + of, d.other_share);
  cells.add("largest_" + of, d.unit != 0.0 ? TableValue{d.largest} : TableValue{});
  cells.add("beta1_" + of, or_undefined(d.loaded_1.beta));
  cells.add("beta1_error_" + of, or_undefined(d.loaded_1.error));
  cells.add("beta2_" + of, or_undefined(d.loaded_2.beta));
  cells.add("beta2_error_" + of, or_undefined(d.loaded_2.error));
  cells.add("beta1_other_" + of, or_undefined(d.other_1.beta));
}

void add_moduli(const LatticeRow& r, Cells& cells) {
  const int n = r.dimension * (r.dimension + 1) / 2;
  const auto entry = [&](int a, int b) { return r.moduli ? TableValue{(*r.moduli)(a, b)} : TableValue{}; };
  for (int a = 0; a < n; ++a)
    for (int b = a; b < n; ++b) cells.add(fmt::format("C{}{}", a + 1, b + 1), entry(a, b));
  TableValue B, G;
  if (r.moduli) {
    B = r.moduli->topLeftCorner(r.dimension, r.dimension).mean();
    G = r.moduli->diagonal().tail(n - r.dimension).mean();
  }
  cells.add("B", B);
  cells.add("G_shear", G);
  using Bound = double ModulusBounds::*;
  const std::array<std::pair<const char*, Bound>, 4> bounds = {
      {{"voigt", &ModulusBounds::voigt},
       {"hs_upper", &ModulusBounds::hashin_shtrikman_upper},
       {"hs_lower", &ModulusBounds::hashin_shtrikman_lower},
       {"reuss", &ModulusBounds::reuss}}};
  const auto bound_cell = [&](ModulusBounds CompositeBounds::*of, Bound bound) {
    if (!r.bounds) return TableValue{};
    const double value = ((*r.bounds).*of).*bound;
    const bool is_upper = bound == &ModulusBounds::voigt || bound == &ModulusBounds::hashin_shtrikman_upper;
    // A modulus is never below zero, so that a lower bound of zero always holds.
    const bool holds = is_upper ? r.bounds_hold.upper : r.bounds_hold.lower || value == 0.0;
    return holds ? TableValue{value} : TableValue{};
  };
  for (const auto& [name, bound] : bounds) {
    cells.add(fmt::format("B_{}", name), bound_cell(&CompositeBounds::K, bound));
    cells.add(fmt::format("G_{}", name), bound_cell(&CompositeBounds::G, bound));
  }
}

void add_fracture(const LatticeRow& r, Cells& cells) {
  cells.add("strength", r.fracture ? TableValue{r.fracture->strength} : TableValue{});
  cells.add("strain_at_strength", r.fracture ? TableValue{r.fracture->strain_at_strength} : TableValue{});
  cells.add("n_broken",
            r.fracture ? count(static_cast<std::int64_t>(r.fracture->broken.size())) : TableValue{});
  cells.add("fracture_end", r.fracture ? TableValue{r.fracture->end} : TableValue{});
}

}  // namespace

Table table_of(const LatticeRow& r) {
  Cells cells;
  add_sample(r, cells);
  add_solution(r, cells);
  add_distribution("nodes", r.all, cells);
  add_distribution("grain", r.grain, cells);
  add_distribution("matrix", r.matrix, cells);
  add_distribution("forces", r.forces, cells);
  cells.add_count("n_pairs", r.n_pairs);
  cells.add("pearson_bonded", or_undefined(r.pearson_bonded));
  cells.add("pearson_state", or_undefined(r.pearson_state));
  add_moduli(r, cells);
  add_fracture(r, cells);
  cells.add("seconds_lattice", r.seconds_lattice);
  cells.add("seconds_solve", r.seconds_solve);
  cells.add("seconds", r.seconds);
  cells.add("n_compared", r.n_compared ? count(*r.n_compared) : TableValue{});
  return cells.take();
}

}  // namespace floc
