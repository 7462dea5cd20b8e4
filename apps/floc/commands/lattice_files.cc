#include "commands/lattice_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "floc/base/error.h"
#include "floc/picture/drawn_scale.h"
#include "floc/picture/lattice_picture.h"
#include "floc/structure/force_distribution.h"
#include "floc/tables/column.h"
#include "plots/gnuplot.h"
#include "process/cut_option.h"
#include "process/output_files.h"
#include "process/repeated_warnings.h"

namespace floc {
namespace {

constexpr Color kGrainColor = hex_color(0xC9C9C9);
constexpr Color kMatrixColor = hex_color(0xE69F00);
constexpr Color kVoidColor = hex_color(0xFFFFFF);

void write_table_whole(const std::string& path, const Table& table) {
  std::ostringstream out;
  write_table(out, table, TableFormat::csv);
  write_output(path, out.str());
}

std::string phase_name(Phase phase) {
  return phase == Phase::grain ? "grain" : phase == Phase::matrix ? "matrix" : "void";
}

template <int Dim>
std::vector<std::pair<int, int>> stress_components() {
  if constexpr (Dim == 2) return {{0, 0}, {1, 1}, {0, 1}};
  return {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
}

/// Returns the table of --stress. It has one row for each node that belongs to an element: position, phase and stress.
/// The state file of --output contains these nodes as grains, in the order of the rows.
template <int Dim>
Table node_table(const LoadedSample<Dim>& of) {
  Table table;
  table.columns = {"node"};
  for (int a = 1; a <= Dim; ++a) table.columns.push_back(fmt::format("x{}", a));
  table.columns.insert(table.columns.end(), {"phase", "grain", "volume", "pressure"});
  for (const auto& [a, b] : stress_components<Dim>())
    table.columns.push_back(fmt::format("stress{}{}", a + 1, b + 1));
  std::int64_t number = 0;
  for (int k = 0; k < of.network.n_nodes; ++k) {
    if (!of.network.present[k]) continue;
    std::vector<TableValue> row = {number++};
    for (int a = 0; a < Dim; ++a) row.emplace_back(of.sample.lattice.node[k][a]);
    row.emplace_back(phase_name(of.sample.phase[k]));
    const int owner = of.sample.owner[k];
    row.emplace_back(owner < 0 ? count(owner) : of.sample.grains.name(owner));
    row.emplace_back(of.sample.lattice.volume[k]);
    row.emplace_back(of.stress[k].trace() / Dim);
    for (const auto& [a, b] : stress_components<Dim>()) row.emplace_back(of.stress[k](a, b));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Values of a stress or of forces, their name, and a summary of their distribution, for a table or a plot.
struct Named {
  std::string name;
  std::vector<double> values;
  const StressDistribution& distribution;
};

template <int Dim>
std::vector<Named> distributions(const LatticeRow& row, const LoadedSample<Dim>& of) {
  return {{"nodes", stresses_of(of, row.axis, std::nullopt), row.all},
          {"grain", stresses_of(of, row.axis, Phase::grain), row.grain},
          {"matrix", stresses_of(of, row.axis, Phase::matrix), row.matrix},
          {"forces", of.pair_force, row.forces}};
}

/// Returns values with zeros in place of rounding errors. A bin at zero contains zero, but the sign of a rounding error
/// is random.
/// @param least  smallest magnitude of a value that is not a rounding error
std::vector<double> without_rounding(std::vector<double> values, double least) {
  for (double& value : values)
    if (std::abs(value) < least) value = 0.0;
  return values;
}

Table distribution_table(const std::vector<Named>& all, double width) {
  Table table{{"of", "low", "high", "count", "n", "density", "unit", "n_outside"}, {}};
  for (const Named& named : all) {
    // The histogram contains values divided by `unit`, and zeros instead of rounding errors. This unit is the mean of
    // those values that have the sign of the load. If no value has this sign, `unit` is zero.
    const double unit = named.distribution.unit;
    if (unit == 0.0) continue;
    const ForceDistribution h =
        distribution_of(without_rounding(named.values, named.distribution.least), unit, width);
    if (h.n_outside > 0)
      printed_remarks().warn("distribution of " + named.name, outside_bins(h, "values", "--bin-width"));
    for (int b = 0; b < static_cast<int>(h.counts.size()); ++b)
      if (h.counts[b] > 0)
        table.rows.push_back(
            {named.name, h.low(b), h.low(b + 1), h.counts[b], h.n, h.density(b), unit, h.n_outside});
  }
  return table;
}

/// Returns the two end points of the line that shows a fitted exponential tail, from the threshold of the tail to the
/// largest value. The fitted distribution is normalised to 1 for the values above the threshold. Its density is
/// therefore multiplied by the fraction of all values that are above the threshold.
/// @param n        number of all values
/// @param largest  largest value, expressed in the unit of the abscissa
/// @param sign     factor of the abscissas: 1 for a tail of values with the sign of the load, -1 for a tail of the
/// other values
std::vector<std::vector<double>> tail_points(const StressTail& tail, int n, double largest, double sign) {
  std::vector<std::vector<double>> rows;
  if (!tail.beta) return rows;
  const double at_threshold = static_cast<double>(tail.n) / n * *tail.beta;
  for (const double x : {tail.from, std::max(largest, tail.from + 1.0)})
    rows.push_back({sign * x, at_threshold * std::exp(-*tail.beta * (x - tail.from))});
  return rows;
}

Plot stress_plot(const LatticeRow& row, const std::vector<Named>& all, double width) {
  constexpr const char* kColors[] = {"#202020", "#0072b2", "#e69f00", "#00b377"};
  Plot plot;
  std::string curves;
  const char* axis_names[] = {"11", "22", "33"};
  for (std::size_t s = 0; s < all.size(); ++s) {
    const StressDistribution& d = all[s].distribution;
    // The unit is zero if no value has the sign of the load. The abscissa x = stress/unit is then undefined, and
    // nothing is plotted.
    if (d.unit == 0.0) continue;
    const ForceDistribution h = distribution_of(without_rounding(all[s].values, d.least), d.unit, width);
    std::vector<std::vector<double>> points;
    // Empty bins are not plotted, because the axis of the probability density is logarithmic.
    for (int b = 0; b < static_cast<int>(h.counts.size()); ++b)
      if (h.counts[b] > 0) points.push_back({h.middle(b), h.density(b)});
    const int of_points = plot.add(all[s].name + ": x density", std::move(points));
    const int of_tail = plot.add(all[s].name + ": fitted tail from x = 1: x density",
                                 tail_points(d.loaded_1, d.n, d.largest, 1.0));
    std::string title = all[s].name;
    if (d.loaded_1.beta)
      title += fmt::format(": beta = {}", value_and_error(*d.loaded_1.beta, d.loaded_1.error.value_or(0.0)));
    curves += fmt::format(
        "{}data index {} using 1:2 with points pointtype 7 pointsize 0.4 linecolor rgb '{}' title {}, \\\n     "
        "data index {} using 1:2 with lines linewidth 1.5 linecolor rgb '{}' notitle",
        curves.empty() ? "" : ", \\\n     ", of_points, kColors[s], gnuplot_quoted(title), of_tail, kColors[s]);
  }
  plot.script = fmt::format(R"(set logscale y
set format y '10^{{%T}}'
set xlabel 'stress {} over the mean of its sign, x'
set ylabel 'probability density'
set key top right
plot {}
)",
                            axis_names[row.axis], curves);
  return plot;
}

PictureFormat format_of(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".pdf") return PictureFormat::pdf;
  if (extension == ".png") return PictureFormat::png;
  if (extension == ".svg") return PictureFormat::svg;
  throw InputError(path,
                   "the name of the picture does not say its format: expected a name that ends in "
                   ".svg, .pdf or .png");
}

LatticeSheetOptions sheet_of(const LatticeArguments& arguments, const std::string& path) {
  LatticeSheetOptions sheet;
  sheet.cut = parse_cut(arguments.cut);
  sheet.format = format_of(path);
  sheet.pixels_a_node = arguments.pixels;
  return sheet;
}

std::string caption_of(const LatticeRow& row) {
  return fmt::format("ρₘ = {}   kₚ/kₘ = {}   {}", short_number(row.matrix_content),
                     short_number(row.k_grain / row.k_matrix), row.load);
}

template <int Dim>
LatticePicture<Dim> phase_picture(const LatticeRow& row, const LoadedSample<Dim>& of) {
  LatticePicture<Dim> picture;
  for (const Phase phase : of.sample.phase)
    picture.color.push_back(phase == Phase::grain    ? kGrainColor
                            : phase == Phase::matrix ? kMatrixColor
                                                     : kVoidColor);
  picture.meanings = {{kGrainColor, "grains"}, {kMatrixColor, "matrix"}, {kVoidColor, "voids"}};
  picture.caption =
      fmt::format("ρₚ = {}   ρₘ = {}", short_number(row.grain_content), short_number(row.matrix_content));
  return picture;
}

template <int Dim>
void draw_map(const LatticeArguments& arguments, const LatticeRow& row, const LoadedSample<Dim>& of) {
  LatticePicture<Dim> picture;
  std::vector<double> value;
  const double unit = std::abs(row.all.unit) > 0.0 ? std::abs(row.all.unit) : 1.0;
  for (const Mat<Dim>& stress : of.stress) value.push_back(stress(row.axis, row.axis) / unit);
  picture.bar_largest = arguments.largest > 0.0 ? arguments.largest : 4.0;
  picture.color = stress_colors(value, of.network.present, picture.bar_largest);
  picture.meanings = {{palette::kBackground, "void"}};
  picture.bar_name = fmt::format("stress {0}{0} / mean stress,", row.axis + 1);
  picture.caption = caption_of(row);
  write_output(arguments.map, draw_lattice(of.sample.lattice, picture, sheet_of(arguments, arguments.map)));
}

}  // namespace

template <int Dim>
std::vector<double> stresses_of(const LoadedSample<Dim>& of, int axis, std::optional<Phase> phase) {
  std::vector<double> values;
  for (int k = 0; k < of.network.n_nodes; ++k)
    if (of.network.present[k] && (!phase || of.sample.phase[k] == *phase))
      values.push_back(of.stress[k](axis, axis));
  return values;
}

template <int Dim>
void check_lattice_pictures(const LatticeArguments& arguments, const Cell<Dim>& cell) {
  (void)parse_cut(arguments.cut);
  const bool drawn = !(arguments.map.empty() && arguments.phases.empty() && arguments.cracks.empty());
  if (drawn && !can_be_drawn(cell))
    throw InputError(arguments.file,
                     "the cell of this state cannot be drawn by --map, --phases and --cracks: expected a cell "
                     "whose first lattice vector is along x and whose second is in the plane of x and y, for "
                     "example a right-angled cell or one skewed by simple shear");
  for (const std::string& path : {arguments.map, arguments.phases, arguments.cracks})
    if (!path.empty()) (void)format_of(path);
  if (!arguments.plot.empty()) format_of(arguments.plot);
  if (arguments.strength.empty() && !(arguments.curve.empty() && arguments.cracks.empty()))
    throw InputError("floc lattice",
                     "the options --curve and --cracks show broken elements, but nothing breaks without "
                     "--strength: give --strength too");
}

template <int Dim>
void write_lattice_files(const LatticeArguments& arguments, const LatticeRow& row,
                         const LoadedSample<Dim>& of) {
  if (!arguments.stress.empty()) write_table_whole(arguments.stress, node_table(of));
  if (!arguments.pdf.empty() || !arguments.plot.empty()) {
    const std::vector<Named> all = distributions(row, of);
    if (!arguments.pdf.empty()) write_table_whole(arguments.pdf, distribution_table(all, arguments.bin_width));
    if (!arguments.plot.empty()) write_plot(arguments.plot, stress_plot(row, all, arguments.bin_width));
  }
  if (!arguments.map.empty()) draw_map(arguments, row, of);
  if (!arguments.phases.empty())
    write_output(arguments.phases, draw_lattice(of.sample.lattice, phase_picture(row, of),
                                                sheet_of(arguments, arguments.phases)));
}

template <int Dim>
void write_fracture_files(const LatticeArguments& arguments, const LatticeRow& row,
                          const LoadedSample<Dim>& of) {
  if (!arguments.curve.empty()) {
    // The nodes have the numbers that they have in the table of --stress and in the state of --output.
    std::vector<int> number(of.network.present.size(), -1);
    int n_present = 0;
    for (std::size_t k = 0; k < number.size(); ++k)
      if (of.network.present[k]) number[k] = n_present++;
    Table table{{"broken", "strain", "stress", "kind", "node1", "node2"}, {}};
    for (std::size_t b = 0; b < row.fracture->broken.size(); ++b) {
      const Breakage& breakage = row.fracture->broken[b];
      const LatticeElement<Dim>& element = of.network.elements[breakage.element];
      table.rows.push_back({count(static_cast<std::int64_t>(b) + 1), breakage.strain, breakage.stress,
                            std::string(name_of(element.kind)), count(number[element.i]),
                            count(number[element.j])});
    }
    write_table_whole(arguments.curve, table);
  }
  if (arguments.cracks.empty()) return;
  LatticePicture<Dim> picture = phase_picture(row, of);
  const std::vector<Breakage>& broken = row.fracture->broken;
  for (const Breakage& b : broken) picture.faces.push_back(of.network.elements[b.element].bond);
  picture.meanings.emplace_back(palette::kArrow, fmt::format("broken: {} elements", broken.size()));
  picture.caption = caption_of(row);
  write_output(arguments.cracks,
               draw_lattice(of.sample.lattice, picture, sheet_of(arguments, arguments.cracks)));
}

template void check_lattice_pictures(const LatticeArguments&, const Cell<2>&);
template void check_lattice_pictures(const LatticeArguments&, const Cell<3>&);
template std::vector<double> stresses_of(const LoadedSample<2>&, int, std::optional<Phase>);
template std::vector<double> stresses_of(const LoadedSample<3>&, int, std::optional<Phase>);
template void write_lattice_files(const LatticeArguments&, const LatticeRow&, const LoadedSample<2>&);
template void write_lattice_files(const LatticeArguments&, const LatticeRow&, const LoadedSample<3>&);
template void write_fracture_files(const LatticeArguments&, const LatticeRow&, const LoadedSample<2>&);
template void write_fracture_files(const LatticeArguments&, const LatticeRow&, const LoadedSample<3>&);

}  // namespace floc
