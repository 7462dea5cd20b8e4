#include "plots/test_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "floc/base/error.h"
#include "floc/picture/drawn_scale.h"
#include "floc/structure/axial_test.h"

namespace floc {
namespace {

/// Indices of the columns of path.csv that axial_test_plot() needs.
struct TestColumns {
  explicit TestColumns(const CsvTable& path) : axis(path.column("axis")), branch(path.column("branch")) {
    stress.push_back(path.column("stress_1"));
    strain.push_back(path.column("strain_1"));
    for (int a = 2; path.has(fmt::format("stress_{}", a)); ++a) {
      stress.push_back(path.column(fmt::format("stress_{}", a)));
      strain.push_back(path.column(fmt::format("strain_{}", a)));
    }
  }

  int axis, branch;
  std::vector<int> stress, strain;
};

/// Returns three values for row `row` of a simple shear test that started in row `first`: the shear strain, the ratio
/// tau/sigma of shear to normal stress, and the volumetric strain.
/// @param axis  axis normal to the shear planes
std::vector<double> sheared_row(const CsvTable& path, const TestColumns& columns, int row, int first,
                                int axis) {
  double volumetric = 0.0;
  for (const int strain : columns.strain) volumetric += path.number(row, strain) - path.number(first, strain);
  return {path.number(row, path.column("shear_strain")),
          path.number(row, path.column("shear_stress")) / path.number(row, columns.stress[axis]), volumetric};
}

using Rows = std::vector<std::vector<double>>;

/// Computes the deviator q, the lateral stress ratio K0 and the strains of a test from the stresses and strains in a
/// row of path.csv. The columns q and K0 of the table are not used, because in the first row of a test they refer to
/// the driven axis of the previous stage.
template <int Dim>
AxialTest test_at(const CsvTable& path, const TestColumns& columns, int row, int axis, int first) {
  Vec<Dim> stress, strain;
  for (int a = 0; a < Dim; ++a) {
    stress[a] = path.number(row, columns.stress[a]);
    strain[a] = path.number(row, columns.strain[a]) - path.number(first, columns.strain[a]);
  }
  return measure_axial_test<Dim>(axis, stress, strain, nullptr);
}

/// Returns the gnuplot commands for the panel with the stress ratio and the volumetric strain against the strain.
/// @param any_axial    whether a test with a driven axis is drawn
/// @param any_sheared  whether a simple shear test is drawn
std::string test_panel(bool any_axial, bool any_sheared) {
  const char* strain = !any_sheared ? "axial strain" : !any_axial ? "shear strain" : "axial or shear strain";
  const char* ratio = !any_sheared ? "q/p" : !any_axial ? "τ/σ" : "q/p or τ/σ";
  return fmt::format(R"(set xlabel '{0} since the start of the test'
set ylabel '{1}'
set ytics nomirror
set y2label 'volumetric strain'
set y2tics
set key outside top center horizontal
plot data index 0 using 1:2 with linespoints pointtype 7 pointsize 0.7 linecolor rgb '#d55e00' title '{1}', \
     data index 0 using 1:3 axes x1y2 with lines linewidth 2 dashtype 2 linecolor rgb '#0072b2' title 'volumetric strain (compression positive)'
)",
                     strain, ratio);
}

/// gnuplot commands for the panel that shows the lateral stress ratio K0 against the driven stress. For simple shear
/// there is no such panel, because no axis is driven by a stress.
constexpr const char* kLateralPanel = R"(unset y2tics
unset y2label
set ytics mirror
set xlabel 'driven stress'
set ylabel 'K_0 = lateral/driven stress'
unset key
set format x '%g'
plot data index 1 using 1:2 with linespoints pointtype 7 pointsize 0.7 linecolor rgb '#202020'
)";

/// Returns the gnuplot command that marks about four round values on the axis of the driven stress.
std::string driven_stress_tics(const Plot& plot) {
  const auto [low, high] = value_range(plot, {1}, 0, false);
  return low < high ? fmt::format("set xtics {}\n", 2.0 * round_number_below((high - low) / 8.0)) : "";
}

}  // namespace

Plot axial_test_plot(const CsvTable& path) {
  const TestColumns columns(path);
  const int dimension = static_cast<int>(columns.stress.size());
  const auto axis_of = [&](int i) -> int {
    if (path.is_empty(i, columns.axis)) return -1;
    const std::int64_t axis = path.integer(i, columns.axis);
    if (axis < 1 || axis > dimension)
      throw InputError(path.place(i),
                       fmt::format("axis = {}: expected the number of an axis, 1 to {}", axis, dimension));
    return static_cast<int>(axis) - 1;
  };
  const auto is_sheared = [&](int i) {
    return path.has("shear_strain") && !path.is_empty(i, path.column("shear_strain"));
  };
  Rows test, lateral;
  const auto add = [&](int row, int axis, int first) {
    const AxialTest measured = dimension == 2 ? test_at<2>(path, columns, row, axis, first)
                                              : test_at<3>(path, columns, row, axis, first);
    const double strain = path.number(row, columns.strain[axis]) - path.number(first, columns.strain[axis]);
    test.push_back({strain, measured.deviator / measured.mean_stress, measured.volumetric_strain});
    lateral.push_back({path.number(row, columns.stress[axis]), measured.lateral_ratio});
  };
  bool any_sheared = false;
  int first = 0;  // row in which the present test starts
  for (int i = 1; i < path.n_rows(); ++i) {
    const int axis = axis_of(i);
    if (axis < 0) continue;
    if (axis_of(i - 1) != axis || path.text(i, columns.branch) != path.text(i - 1, columns.branch)) {
      if (!test.empty()) {
        test.emplace_back(3, std::nan(""));
        lateral.emplace_back(2, std::nan(""));
      }
      first = i - 1;
      if (!is_sheared(i)) add(first, axis, first);
    }
    if (is_sheared(i)) {
      any_sheared = true;
      test.push_back(sheared_row(path, columns, i, first, axis));
    } else {
      add(i, axis, first);
    }
  }
  if (test.empty()) throw InputError("--show test", "no row of the path belongs to a test with a driven axis");
  const bool any_lateral = std::any_of(lateral.begin(), lateral.end(),
                                       [](const std::vector<double>& row) { return std::isfinite(row[0]); });
  Plot plot;
  if (any_lateral) plot.height *= 2;
  plot.add("test: axial_strain q/p volumetric_strain", std::move(test));
  plot.add("lateral: driven_stress K0", std::move(lateral));
  const std::string panel = test_panel(any_lateral, any_sheared);
  plot.script = any_lateral ? fmt::format("set multiplot layout 2,1\n{}{}{}unset multiplot\n", panel,
                                          driven_stress_tics(plot), kLateralPanel)
                            : panel;
  return plot;
}

Plot fabric_plot(const std::vector<std::pair<std::string, ContactDirections>>& states) {
  Plot plot;
  std::string drawn;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const ContactDirections& d = states[k].second;
    Rows rows;
    // Contacts with directions n and -n are equivalent, so the bins from 0 to 180 degrees are drawn a second time for
    // 180 to 360 degrees. Each bin is drawn as an arc between its two edges. The first point is repeated at the end,
    // which closes the curve.
    for (int turn = 0; turn < 2; ++turn)
      for (int b = 0; b < d.n_bins; ++b)
        for (const int edge : {b, b + 1})
          rows.push_back({180.0 * (static_cast<double>(edge) / d.n_bins + turn), d.all[b], d.strong[b]});
    if (!rows.empty()) rows.push_back(rows.front());
    plot.add("direction all strong, " + states[k].first, std::move(rows));
    drawn += fmt::format(
        "{}data index {} using 1:2 with lines linewidth 2.5 linetype {} title {}, data index {} using 1:3 with "
        "lines dashtype 2 linetype {} notitle",
        k == 0 ? "" : ", ", k, k + 1, gnuplot_quoted(states[k].first), k, k + 1);
  }
  plot.height = plot.width;
  plot.script = fmt::format(R"(set polar
set angles degrees
set size square
set grid polar 30
unset border
unset xtics
unset ytics
set rtics format '%.2f'
set key outside bottom center horizontal
set title 'directions of contacts (density; dashed: strong contacts; isotropic: {:.3f})' font ',15'
plot {}
)",
                            1.0 / std::numbers::pi, drawn);
  return plot;
}

}  // namespace floc
