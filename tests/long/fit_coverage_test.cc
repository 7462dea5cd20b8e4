#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "floc/fitting/compression_laws.h"
#include "floc/fitting/modulus_law.h"
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
  struct Rows {
    int n;
    bool creeps;
  };
  for (const auto& [n, creeps] : {Rows{12, false}, Rows{30, false}, Rows{60, false}, Rows{30, true}})
    for (const Noise& noise : {Noise{Noise::of_inverse, 1e-3}, Noise{Noise::relative, 1e-3}}) {
      RandomStream random(5, 0);
      Coverage coverage({{"lambda", clay.lambda}, {"kappa", clay.kappa}, {"P0_star", clay.P_yield}});
      for (int draw = 0; draw < kDraws; ++draw) {
        const ConsolidationCurve curve = noisy_curve([&](double P) { return 1.0 / clay.inverse_phi(P); },
                                                     geometric_pressures(10.0, 1000.0, n), noise, random);
        const auto fit = fit_supported_law(creeps ? through_creep(curve, random) : curve, {});
        ASSERT_TRUE(fit.found()) << fit.failure_reason;
        for (const FittedParameter& p : fit.parameters) coverage.add(p);
      }
      coverage.expect_honest(kDraws, std::to_string(n) + (creeps ? " rows, with creep" : " rows"));
    }
}

TEST(FitCoverage, OfTheFullLaw) {
  const Published& set = kSmallRolling;
  RandomStream random(5, 0);
  Coverage coverage({{"lambda", set.lambda}, {"Phi_max", set.phi_max}, {"alpha", set.alpha}});
  for (int draw = 0; draw < kDraws; ++draw) {
    const ConsolidationCurve curve =
        noisy_curve([&](double P) { return 1.0 / set.law().inverse_phi(P); },
                    geometric_pressures(set.P0_star, 100.0 * set.P0_star, 30), {Noise::relative, 1e-3}, random);
    const auto fit = fit_consolidation(draw % 2 == 0 ? curve : through_creep(curve, random), {});
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
      const auto draw_of = [&](const auto& law) {
        const ConsolidationCurve curve = noisy_curve(law, P, noise, random);
        return (draw % 2 == 0 ? curve : through_creep(curve, random)).phi;
      };
      const auto h = fit_compression(P, draw_of(heckel), std::vector{CompressionLaw::heckel}, {});
      for (const FittedParameter& p : h.front().parameters) of_heckel.add(p);
      const auto k = fit_compression(P, draw_of(kawakita), std::vector{CompressionLaw::kawakita}, {});
      for (const FittedParameter& p : k.front().parameters) of_kawakita.add(p);
    }
    of_heckel.expect_honest(kDraws, "Heckel");
    of_kawakita.expect_honest(kDraws, "Kawakita");
  }
}

/// Number of fits that give a slope lambda, and number of those fits whose 95 % interval contains the true slope.
struct SlopeCoverage {
  int held = 0, n = 0;

  void add(const Staircases& staircases, int n_samples, RandomStream& random) {
    const auto fit = fit_supported_law(staircases.mean_of(n_samples, random), {});
    const FittedParameter* lambda = fit.found() ? fit.find("lambda") : nullptr;
    if (!lambda || !lambda->value) return;
    ++n;
    held += *lambda->low95 <= staircases.lambda && staircases.lambda <= *lambda->high95;
  }
};

TEST(FitCoverage, OfEnsemblesThatCollapseInJumps) {
  RandomStream random(5, 0);
  SlopeCoverage coverage;
  for (int draw = 0; draw < kDraws; ++draw) {
    Staircases staircases;
    staircases.gap = 0.05 * std::pow(20.0, random.uniform());
    coverage.add(staircases, 4 + static_cast<int>(13.0 * random.uniform()), random);
  }
  std::printf("%d of %d slopes are in their intervals\n", coverage.held, coverage.n);
  EXPECT_GE(coverage.n, 0.95 * kDraws);
  EXPECT_GE(coverage.held, 0.935 * coverage.n);
  EXPECT_LE(coverage.held, 0.965 * coverage.n);
}

TEST(FitCoverage, OfEnsemblesOfOneGap) {
  for (const int n_samples : {4, 8})
    for (const double gap : {0.05, 0.15, 0.3, 0.5, 1.0}) {
      Staircases staircases;
      staircases.gap = gap;
      RandomStream random(3, 0);
      SlopeCoverage coverage;
      for (int draw = 0; draw < kDraws; ++draw) coverage.add(staircases, n_samples, random);
      const std::string what = std::to_string(n_samples) + " samples, gap " + std::to_string(gap);
      EXPECT_GE(coverage.n, 0.95 * kDraws) << what;
      EXPECT_GE(coverage.held, 0.935 * coverage.n) << what;
      // The slopes of samples that jump rarely have different scatters. Student's interval is then a little too wide.
      EXPECT_LE(coverage.held, (gap < 0.4 ? 0.965 : 0.98) * coverage.n) << what;
    }
}

TEST(FitCoverage, OfPowerLawsOfModuli) {
  RandomStream random(4, 0);
  Coverage of_pressure({{"exponent", 0.4}, {"coefficient", 310.0}});
  Coverage of_fraction({{"exponent", 1.2}, {"phi_0", 0.60}, {"coefficient", 800.0}});
  const std::vector<double> P = geometric_pressures(0.01, 10.0, 8), phi = geometric_pressures(0.61, 0.74, 12);
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<double> B, M;
    for (const double p : P) B.push_back(310.0 * std::pow(p, 0.4) * std::exp(0.05 * random.normal()));
    for (const double f : phi) M.push_back(800.0 * std::pow(f - 0.60, 1.2) * std::exp(0.03 * random.normal()));
    for (const FittedParameter& p : fit_modulus_of_pressure(P, B).parameters) of_pressure.add(p);
    for (const FittedParameter& p : fit_modulus_of_fraction(phi, M).parameters) of_fraction.add(p);
  }
  of_pressure.expect_honest(kDraws, "modulus against the pressure");
  of_fraction.expect_honest(kDraws, "modulus against the solid fraction");
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
  const auto kawakita = [](double P) { return 0.4 / (1.0 - 0.55 * 0.05 * P / (1.0 + 0.05 * P)); };
  const auto compressed = [](CompressionLaw which) {
    return [which](const ConsolidationCurve& curve) {
      return fit_compression(curve.P_star, curve.phi, std::vector{which}, {}).front();
    };
  };
  const auto as_heckel = compressed(CompressionLaw::heckel), as_kawakita = compressed(CompressionLaw::kawakita);
  EXPECT_GE(denied(kawakita, 2.0, 200.0, as_heckel), 0.95);
  EXPECT_GE(denied(heckel, 2.0, 200.0, as_kawakita), 0.95);
  EXPECT_LE(denied(heckel, 2.0, 200.0, as_heckel), 0.02);
  EXPECT_LE(denied(kawakita, 2.0, 200.0, as_kawakita), 0.02);
}

}  // namespace
}  // namespace floc::test
