#include <gtest/gtest.h>

#include <cmath>

#include "floc/fitting/compression_laws.h"
#include "floc/fitting/preconsolidation.h"
#include "floc/fitting/supported_law.h"
#include "support/coverage.h"
#include "support/synthetic_ensemble.h"
#include "support/synthetic_soil.h"

namespace floc::test {
namespace {

constexpr int kDraws = 2000;

TEST(FitCoverage, OfTheVirginLineOfAClay) {
  const TwoLineClay clay;
  for (const int n : {12, 30, 60})
    for (const Noise& noise : {Noise{Noise::of_inverse, 1e-3}, Noise{Noise::relative, 1e-3}}) {
      RandomStream random(5, 0);
      Coverage coverage({{"lambda", clay.lambda}, {"kappa", clay.kappa}, {"P0_star", clay.P_yield}});
      for (int draw = 0; draw < kDraws; ++draw) {
        const auto fit = fit_supported_law(noisy_curve([&](double P) { return 1.0 / clay.inverse_phi(P); },
                                                       geometric_pressures(10.0, 1000.0, n), noise, random),
                                           {});
        ASSERT_TRUE(fit.found()) << fit.failure_reason;
        for (const FittedParameter& p : fit.parameters) coverage.add(p);
      }
      coverage.expect_honest(kDraws, std::to_string(n) + " rows");
    }
}

TEST(FitCoverage, OfTheFullLaw) {
  const Published& set = kSmallRolling;
  RandomStream random(5, 0);
  Coverage coverage({{"lambda", set.lambda}, {"Phi_max", set.phi_max}, {"alpha", set.alpha}});
  for (int draw = 0; draw < kDraws; ++draw) {
    const auto fit = fit_consolidation(
        noisy_curve([&](double P) { return 1.0 / set.law().inverse_phi(P); },
                    geometric_pressures(set.P0_star, 100.0 * set.P0_star, 30), {Noise::relative, 1e-3}, random),
        {});
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    for (const FittedParameter& p : fit.parameters) coverage.add(p);
  }
  coverage.expect_honest(kDraws, "full law");
}

TEST(FitCoverage, OfHeckelAndKawakita) {
  const auto heckel = [](double P) { return 1.0 - std::exp(-0.55 - P / 85.0); };
  const auto kawakita = [](double P) { return 0.4 / (1.0 - 0.55 * 0.05 * P / (1.0 + 0.05 * P)); };
  for (const Noise& noise : {Noise{Noise::of_fraction, 1e-3}, Noise{Noise::relative, 1e-3}}) {
    RandomStream random(5, 0);
    Coverage of_heckel({{"P_y", 85.0}, {"A", 0.55}});
    Coverage of_kawakita({{"a", 0.55}, {"b", 0.05}, {"D0", 0.4}, {"Phi_max", 0.4 / 0.45}});
    for (int draw = 0; draw < kDraws; ++draw) {
      const std::vector<double> P = geometric_pressures(2.0, 200.0, 30);
      const auto h = fit_compression(P, noisy_curve(heckel, P, noise, random).phi,
                                     std::vector{CompressionLaw::heckel}, {});
      for (const FittedParameter& p : h.front().parameters) of_heckel.add(p);
      const auto k = fit_compression(P, noisy_curve(kawakita, P, noise, random).phi,
                                     std::vector{CompressionLaw::kawakita}, {});
      for (const FittedParameter& p : k.front().parameters) of_kawakita.add(p);
    }
    of_heckel.expect_honest(kDraws, "Heckel");
    of_kawakita.expect_honest(kDraws, "Kawakita");
  }
}

/// Returns the fraction of simulated ensembles in which the interval of lambda contains the true value.
double share_held(const Staircases& staircases, int n_samples, int n_draws) {
  RandomStream random(3, 0);
  int held = 0, n = 0;
  for (int draw = 0; draw < n_draws; ++draw) {
    const auto fit = fit_supported_law(staircases.mean_of(n_samples, random), {});
    const FittedParameter* lambda = fit.found() ? fit.find("lambda") : nullptr;
    if (!lambda || !lambda->value) continue;
    ++n;
    held += *lambda->low95 <= staircases.lambda && staircases.lambda <= *lambda->high95;
  }
  EXPECT_GT(n, 0.8 * n_draws);
  return held / static_cast<double>(n);
}

TEST(FitCoverage, OfEnsemblesThatCollapseInJumps) {
  constexpr int kEnsembles = 500;
  for (const int n_samples : {4, 8})
    for (const double gap : {0.15, 0.3, 0.5}) {
      Staircases staircases;
      staircases.gap = gap;
      EXPECT_GE(share_held(staircases, n_samples, kEnsembles), 0.90) << n_samples << " samples, gap " << gap;
    }
}

TEST(FitDenial, IsRightInNearlyAllDraws) {
  const auto heckel = [](double P) { return 1.0 - std::exp(-0.55 - P / 85.0); };
  const TwoLineClay clay;
  const auto of_clay = [&](double P) { return 1.0 / clay.inverse_phi(P); };
  const auto law = kSmallRolling.law();
  const auto of_law = [&](double P) { return 1.0 / law.inverse_phi(P); };
  const auto denied = [](const auto& phi_of, double low, double high, const auto& fit_of) {
    RandomStream random(9, 0);
    int n = 0;
    for (int draw = 0; draw < kDraws; ++draw)
      n += fit_of(noisy_curve(phi_of, geometric_pressures(low, high, 30), {Noise::of_fraction, 1e-3}, random))
               .pattern.is_systematic();
    return n / static_cast<double>(kDraws);
  };
  const auto full = [](const ConsolidationCurve& curve) { return fit_consolidation(curve, {}); };
  const auto plateau = [](const ConsolidationCurve& curve) {
    ConsolidationOptions options;
    options.law = ConsolidationLaw::log;
    return fit_consolidation(curve, options);
  };
  const auto automatic = [](const ConsolidationCurve& curve) { return fit_supported_law(curve, {}); };
  EXPECT_GE(denied(heckel, 4.0, 400.0, full), 0.95);
  EXPECT_GE(denied(of_clay, 10.0, 1000.0, plateau), 0.95);
  EXPECT_LE(denied(of_law, 0.0316, 3.16, full), 0.02);
  EXPECT_LE(denied(of_clay, 10.0, 1000.0, automatic), 0.02);
}

}  // namespace
}  // namespace floc::test
