#include "floc/fitting/pressure_cycle.h"

#include <algorithm>
#include <cmath>

namespace floc {
namespace {

/// Returns the loading that ends at the row `turn`. The loading consists of this row and of the rows directly before
/// it, as long as the pressure is positive and does not fall.
Loading loading_up_to(const std::vector<PathRow>& rows, int turn) {
  int first = turn;
  while (first > 0 && rows[first - 1].P_star > 0.0 && rows[first - 1].P_star <= rows[first].P_star) --first;
  Loading up;
  for (int i = first; i <= turn; ++i) {
    up.curve.P_star.push_back(rows[i].P_star);
    up.curve.phi.push_back(rows[i].phi);
    up.rows.push_back(i);
  }
  return up;
}

/// Returns the index of the last point of a curve that has the pressure `P`; absent if there is no such point.
std::optional<std::size_t> last_at(const ConsolidationCurve& curve, double P) {
  for (std::size_t k = curve.P_star.size(); k-- > 0;)
    if (std::abs(curve.P_star[k] - P) <= kSamePressure * P) return k;
  return std::nullopt;
}

/// Returns the work of a cycle that starts and ends at the lowest pressure common to loading and unloading.
double closed_work(const PressureCycle& cycle) {
  const std::size_t start = *last_at(cycle.up.curve, cycle.P.front());
  const std::size_t end = *last_at(cycle.down.curve, cycle.P.front());
  ConsolidationCurve whole;
  const auto append = [&whole](const ConsolidationCurve& curve, std::size_t first, std::size_t last) {
    for (std::size_t k = first; k <= last; ++k) {
      whole.P_star.push_back(curve.P_star[k]);
      whole.phi.push_back(curve.phi[k]);
    }
  };
  append(cycle.up.curve, start, cycle.up.curve.phi.size() - 1);
  append(cycle.down.curve, 1, end);
  return work_of_path(whole);
}

}  // namespace

double work_of_path(const ConsolidationCurve& path) {
  double work = 0.0;
  for (std::size_t k = 1; k < path.phi.size(); ++k)
    work += 0.5 * (path.P_star[k - 1] + path.P_star[k]) * (1.0 / path.phi[k - 1] - 1.0 / path.phi[k]);
  return work;
}

std::vector<PressureCycle> pressure_cycles(const std::vector<PathRow>& rows) {
  std::vector<PressureCycle> cycles;
  for (Loading& down : unloadings(rows)) {
    PressureCycle cycle;
    cycle.up = loading_up_to(rows, down.rows.front());
    cycle.down = std::move(down);
    if (cycle.up.rows.size() < 2) continue;
    const ConsolidationCurve& falling = cycle.down.curve;
    for (std::size_t k = falling.phi.size(); k-- > 1;) {
      const auto before = last_at(cycle.up.curve, falling.P_star[k]);
      if (!before || *before + 1 == cycle.up.curve.phi.size()) continue;
      cycle.P.push_back(falling.P_star[k]);
      cycle.phi_up.push_back(cycle.up.curve.phi[*before]);
      cycle.phi_down.push_back(falling.phi[k]);
    }
    if (!cycle.P.empty()) cycle.work = closed_work(cycle);
    cycles.push_back(std::move(cycle));
  }
  return cycles;
}

}  // namespace floc
