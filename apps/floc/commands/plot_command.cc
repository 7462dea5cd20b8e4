#include "commands/plot_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace floc {

std::string plot_command(const Plot& plot, const std::vector<Curve>& curves) {
  std::string text;
  for (const Curve& curve : curves) {
    const auto& rows = plot.blocks[static_cast<std::size_t>(curve.block)].rows;
    const bool drawn = std::ranges::any_of(rows, [](const std::vector<double>& row) {
      return row.size() > 1 && std::isfinite(row[0]) && std::isfinite(row[1]);
    });
    if (!drawn) continue;
    text += fmt::format("{}{}{}data index {} {}", text.empty() ? "plot " : ", \\\n     ", curve.loop,
                        curve.loop.empty() ? "" : " ", curve.block, curve.how);
  }
  // gnuplot fails if there is no curve to plot. Empty axes are drawn instead.
  return (text.empty() ? "set xrange [0.1:1]\nset yrange [0.1:1]\nplot NaN notitle" : text) + "\n";
}

}  // namespace floc
