#include "floc/fitting/loading_path.h"

#include <algorithm>
#include <cmath>

namespace floc {
namespace {

void add_point(const std::vector<PathRow>& rows, std::size_t i, Loading& loading) {
  loading.curve.P_star.push_back(rows[i].P_star);
  loading.curve.phi.push_back(rows[i].phi);
  loading.rows.push_back(static_cast<int>(i));
}

/// Returns whether row `i` is superseded by the next row, because both are isotropic rows of one branch at one
/// pressure. A superseded row is not used.
bool is_superseded(const std::vector<PathRow>& rows, std::size_t i) {
  if (i + 1 >= rows.size() || rows[i].P_star == 0.0) return false;
  const PathRow &row = rows[i], &next = rows[i + 1];
  return row.P_star == next.P_star && row.branch == next.branch && row.load == PathLoad::isotropic &&
         next.load == PathLoad::isotropic;
}

/// Returns the indices of the rows that are not superseded (see is_superseded()).
std::vector<std::size_t> counted_rows(const std::vector<PathRow>& rows) {
  std::vector<std::size_t> counted;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!is_superseded(rows, i)) counted.push_back(i);
  return counted;
}

}  // namespace

std::vector<PathStep> path_steps(const std::vector<PathRow>& rows) {
  std::vector<PathStep> steps;
  double largest = 0.0;
  double before = 0.0;
  bool turned = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const PathRow& row = rows[i];
    const double P = row.P_star;
    if (is_superseded(rows, i)) {
      steps.push_back(PathStep::hold);
      continue;
    }
    PathStep step = PathStep::first_loading;
    if (row.load == PathLoad::other)
      step = PathStep::test;
    else if (P == 0.0)
      step = PathStep::zero_pressure;
    else if (P == before)
      step = PathStep::hold;
    else if (P < before)
      step = PathStep::unloading;
    else if (turned)
      step = P > largest * (1 + kSamePressure) ? PathStep::later_virgin : PathStep::reloading;
    // A row with P* = 0 belongs to the assembly if no row before it has a positive pressure; otherwise it belongs to an
    // unloading.
    turned = turned || step == PathStep::unloading || step == PathStep::test || (P == 0.0 && largest > 0.0);
    largest = std::max(largest, P);
    before = P;
    steps.push_back(step);
  }
  return steps;
}

std::vector<int> superseded_rows(const std::vector<PathRow>& rows) {
  const std::vector<PathStep> steps = path_steps(rows);
  std::vector<int> found;
  for (std::size_t i = 0, first = 0; i < rows.size(); ++i) {
    if (is_superseded(rows, i)) continue;
    // Of successive rows at one pressure, the last row is a point of a curve. There is one exception: if all rows of a
    // branch are at the last pressure of the previous branch, none of these rows is a point of a curve.
    for (; first < i; ++first)
      if (steps[i] != PathStep::hold) found.push_back(static_cast<int>(first));
    first = i + 1;
  }
  return found;
}

int count_reversals(const std::vector<PathRow>& rows) {
  int n = 0, direction = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double change = rows[i].P_star - rows[i - 1].P_star;
    if (change == 0.0) continue;
    const int step = change > 0.0 ? 1 : -1;
    n += direction == -step;
    direction = step;
  }
  return n;
}

std::optional<PathFault> path_fault(const std::vector<PathRow>& rows) {
  int direction = 0;  // sign of the last change of pressure along the branch: 1, -1 or 0
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].branch != rows[i - 1].branch || rows[i].load != PathLoad::isotropic ||
        rows[i - 1].load != PathLoad::isotropic) {
      direction = 0;
      continue;
    }
    const double change = rows[i].P_star - rows[i - 1].P_star;
    if (rows[i].branch.empty() || change == 0.0) continue;
    const int step = change > 0.0 ? 1 : -1;
    const int expected = rows[i].branch == "load" ? 1 : rows[i].branch == "unload" ? -1 : direction;
    if (expected != 0 && step != expected)
      return PathFault{static_cast<int>(i), expected > 0 ? "a pressure that grows along its branch"
                                                         : "a pressure that falls along its branch"};
    direction = step;
  }
  return std::nullopt;
}

Loading first_loading(const std::vector<PathRow>& rows, bool virgin) {
  const std::vector<PathStep> steps = path_steps(rows);
  const auto is_load = [](const PathRow& r) { return r.branch == "load"; };
  const auto load = std::find_if(rows.begin(), rows.end(), is_load);
  const auto after = std::find_if_not(load, rows.end(), is_load);
  const bool named = load != rows.end();
  Loading found;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = rows.begin() + static_cast<std::ptrdiff_t>(i);
    const bool later = virgin && steps[i] == PathStep::later_virgin;
    const bool outside = named && (row >= after || (row < load && row->branch != "assembly"));
    if (!later && (steps[i] != PathStep::first_loading || outside)) continue;
    add_point(rows, i, found);
  }
  return found;
}

std::vector<Reloading> reloadings(const std::vector<PathRow>& rows) {
  const std::vector<PathStep> steps = path_steps(rows);
  const auto loads = [&](std::size_t i) {
    return steps[i] == PathStep::reloading || steps[i] == PathStep::later_virgin;
  };
  std::vector<Reloading> found;
  double largest = 0.0;
  std::size_t before = 0;
  for (const std::size_t i : counted_rows(rows)) {
    if (loads(i)) {
      if (!loads(before)) {
        found.push_back({{}, largest});
        if (rows[before].P_star > 0.0) add_point(rows, before, found.back().loading);
      }
      add_point(rows, i, found.back().loading);
    }
    largest = std::max(largest, rows[i].P_star);
    before = i;
  }
  return found;
}

std::vector<Loading> unloadings(const std::vector<PathRow>& rows) {
  const std::vector<PathStep> steps = path_steps(rows);
  std::vector<Loading> found;
  std::size_t before = 0;
  for (const std::size_t i : counted_rows(rows)) {
    if (steps[i] == PathStep::unloading) {
      if (steps[before] != PathStep::unloading) {
        found.emplace_back();
        add_point(rows, before, found.back());
      }
      add_point(rows, i, found.back());
    }
    before = i;
  }
  return found;
}

ConsolidationCurve mean_curve(const std::vector<ConsolidationCurve>& samples) {
  ConsolidationCurve mean;
  if (samples.empty()) return mean;
  std::vector<double> values;  // values of 1/Phi of all samples at each common pressure
  for (const double P : samples.front().P_star) {
    std::vector<double> here;
    for (const ConsolidationCurve& sample : samples) {
      const auto same = std::find_if(sample.P_star.begin(), sample.P_star.end(),
                                     [&](double Q) { return std::abs(Q - P) <= kSamePressure * P; });
      if (same == sample.P_star.end()) break;
      here.push_back(1.0 / sample.phi[static_cast<std::size_t>(same - sample.P_star.begin())]);
    }
    if (here.size() != samples.size()) continue;
    double sum = 0.0;
    for (const double y : here) sum += y;
    mean.P_star.push_back(P);
    mean.phi.push_back(static_cast<double>(here.size()) / sum);
    values.insert(values.end(), here.begin(), here.end());
  }
  const auto n_samples = static_cast<Eigen::Index>(samples.size());
  mean.samples = Eigen::Map<Eigen::MatrixXd>(values.data(), n_samples,
                                             static_cast<Eigen::Index>(values.size()) / n_samples)
                     .transpose();
  return mean;
}

}  // namespace floc
