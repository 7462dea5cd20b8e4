#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "floc/fitting/fitted_parameter.h"

namespace floc::test {

/// Counts how often the 95 % intervals of parameters contain their true values.
class Coverage {
 public:
  explicit Coverage(std::map<std::string, double> truth) : truth_(std::move(truth)) {}

  /// Counts a parameter of one fit. A fit without a value of the parameter is not counted.
  void add(const FittedParameter& p) {
    const auto truth = truth_.find(p.name);
    if (truth == truth_.end() || !p.value) return;
    Count& count = counts_[p.name];
    ++count.n;
    count.held += p.low95 && p.high95 && *p.low95 <= truth->second && truth->second <= *p.high95;
  }

  /// Expects that intervals contain the true value in 95 % of the draws. The accepted range is 93.5 to 96.5 % for 2000
  /// draws. For another number of draws, its ends are shifted by the change of three standard deviations of the
  /// fraction.
  void expect_honest(int n_draws, const std::string& what) const {
    const auto three_deviations = [](int n) { return 3.0 * std::sqrt(0.95 * 0.05 / n); };
    const double open = 0.015 + three_deviations(n_draws) - three_deviations(2000);
    for (const auto& [name, truth] : truth_) {
      ASSERT_TRUE(counts_.contains(name)) << what << ": no value of " << name;
      const Count& count = counts_.at(name);
      EXPECT_GE(count.n, 0.9 * n_draws) << what << ": " << name << " has a value in too few draws";
      EXPECT_NEAR(static_cast<double>(count.held) / count.n, 0.95, open) << what << ": " << name;
    }
  }

 private:
  struct Count {
    int n = 0, held = 0;
  };
  std::map<std::string, double> truth_;
  std::map<std::string, Count> counts_;
};

}  // namespace floc::test
