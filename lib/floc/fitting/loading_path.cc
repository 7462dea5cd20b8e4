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

}  // namespace

std::vector<PathStep> path_steps(const std::vector<PathRow>& rows) {
  std::vector<PathStep> steps;
  double largest = 0.0;
  double before = 0.0;
  bool turned = false;
  for (const PathRow& row : rows) {
    const double P = row.P_star;
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
    // A row with P* = 0 belongs to the assembly if it comes before the first positive pressure, otherwise to an
    // unloading.
    turned = turned || step == PathStep::unloading || step == PathStep::test || (P == 0.0 && largest > 0.0);
    largest = std::max(largest, P);
    before = P;
    steps.push_back(step);
  }
  return steps;
}

std::optional<PathFault> path_fault(const std::vector<PathRow>& rows) {
  int direction = 0;  // sign of the last change of pressure along the branch: 1, -1 or 0
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const int row = static_cast<int>(i);
    const double change = rows[i].P_star - rows[i - 1].P_star;
    if (rows[i].branch != rows[i - 1].branch || rows[i].load != PathLoad::isotropic ||
        rows[i - 1].load != PathLoad::isotropic) {
      direction = 0;
      continue;
    }
    if (rows[i].branch.empty()) {
      if (change == 0.0) return PathFault{row, "a pressure that differs from the pressure of the row before"};
      continue;
    }
    const int step = change > 0.0 ? 1 : change < 0.0 ? -1 : 0;
    const bool is_first = i < 2 || rows[i - 2].branch != rows[i].branch;
    if (!is_first && step != direction)
      return PathFault{row,
                       direction > 0 ? "a pressure that grows along its branch"
                       : direction < 0
                           ? "a pressure that falls along its branch"
                           : "the pressure of the row before, because the pressure of this branch is constant"};
    if (rows[i].branch == "load" && step <= 0) return PathFault{row, "a pressure that grows along its branch"};
    if (rows[i].branch == "unload" && step >= 0)
      return PathFault{row, "a pressure that falls along its branch"};
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
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (loads(i)) {
      if (!loads(i - 1)) {
        found.push_back({{}, largest});
        if (rows[i - 1].P_star > 0.0) add_point(rows, i - 1, found.back().loading);
      }
      add_point(rows, i, found.back().loading);
    }
    largest = std::max(largest, rows[i].P_star);
  }
  return found;
}

std::vector<Loading> unloadings(const std::vector<PathRow>& rows) {
  const std::vector<PathStep> steps = path_steps(rows);
  std::vector<Loading> found;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (steps[i] != PathStep::unloading) continue;
    if (steps[i - 1] != PathStep::unloading) {
      found.emplace_back();
      add_point(rows, i - 1, found.back());
    }
    add_point(rows, i, found.back());
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
