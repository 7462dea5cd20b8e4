#include "floc/fitting/compression_laws.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "floc/base/infinity.h"
#include "support/coverage.h"
#include "support/synthetic_soil.h"

namespace floc::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// Compression law with known parameters. Its formula is written as in the original paper.
struct KnownLaw {
  CompressionLaw law;
  std::function<double(double)> D;
  std::map<std::string, double> truth;
};

const std::vector<KnownLaw>& known_laws() {
  static const std::vector<KnownLaw> laws = {
      {CompressionLaw::heckel,
       [](double P) { return 1 - std::exp(-(0.55 + P / 85)); },
       {{"P_y", 85}, {"A", 0.55}}},
      {CompressionLaw::kawakita,
       [](double P) {
         const double C = 0.55 * 0.05 * P / (1 + 0.05 * P);
         return 0.4 / (1 - C);
       },
       {{"a", 0.55}, {"b", 0.05}, {"D0", 0.4}, {"Phi_max", 0.4 / 0.45}}},
      {CompressionLaw::cooper_eaton,
       [](double P) { return 0.4 / (1 - 0.6 * (0.4 * std::exp(-4 / P) + 0.5 * std::exp(-60 / P))); },
       {{"a1", 0.4}, {"k1", 4}, {"a2", 0.5}, {"k2", 60}, {"D0", 0.4}}},
      {CompressionLaw::walker,
       [](double P) { return 1 / (2.2 - 0.2 * std::log(P)); },
       {{"slope", 0.2}, {"D_1", 1 / 2.2}}},
      {CompressionLaw::gurnham,
       [](double P) { return 0.4 + 0.09 * std::log(P); },
       {{"slope", 0.09}, {"D_1", 0.4}}},
      {CompressionLaw::adams,
       [](double P) { return 0.4 * std::exp(std::log1p(6 * P / 20) / 6); },
       {{"tau", 20}, {"alpha", 6}, {"D0", 0.4}}},
  };
  return laws;
}

std::vector<CompressionLaw> all_laws() {
  std::vector<CompressionLaw> laws;
  for (const NamedCompressionLaw& named : compression_laws()) laws.push_back(named.law);
  return laws;
}

std::vector<double> densities(const KnownLaw& known, const std::vector<double>& P, double noise,
                              RandomStream& random) {
  std::vector<double> D;
  for (const double p : P) D.push_back(known.D(p) + noise * random.normal());
  return D;
}

TEST(CompressionLaws, EachIsRecoveredFromExactDataAndRanksFirst) {
  RandomStream unused(0, 0);
  const std::vector<double> P = geometric_pressures(2, 200, 30);
  for (const KnownLaw& known : known_laws()) {
    const auto fits = fit_compression(P, densities(known, P, 0.0, unused), all_laws(), {});
    const CompressionFit& own = fits[static_cast<std::size_t>(known.law)];
    ASSERT_TRUE(own.found()) << own.failure_reason;
    EXPECT_EQ(own.n_points, 30);
    EXPECT_FALSE(own.pattern.is_systematic());
    for (const FittedParameter& p : own.parameters)
      EXPECT_NEAR(*p.value, known.truth.at(p.name), 1e-4 * known.truth.at(p.name)) << p.name;
    double weights = 0.0;
    for (const CompressionFit& fit : fits) {
      EXPECT_GE(fit.delta_aicc, 0.0);
      weights += fit.weight;
    }
    EXPECT_EQ(own.delta_aicc, 0.0);
    EXPECT_NEAR(weights, 1.0, 1e-12);
  }
}

TEST(CompressionLaws, IntervalsHoldTheTruth) {
  constexpr int kDraws = 200;
  const std::vector<double> P = geometric_pressures(2, 200, 30);
  for (const KnownLaw& known : known_laws()) {
    // the law with five parameters is tested in the long tests
    if (known.law == CompressionLaw::cooper_eaton) continue;
    RandomStream random(9, 0);
    Coverage coverage(known.truth);
    for (int draw = 0; draw < kDraws; ++draw) {
      const auto fits = fit_compression(P, densities(known, P, 1e-3, random), std::vector{known.law}, {});
      for (const FittedParameter& p : fits.front().parameters) coverage.add(p);
    }
    coverage.expect_honest(kDraws, std::to_string(static_cast<int>(known.law)));
  }
}

TEST(CompressionLaws, ALawThatIsNotThatOfTheDataIsSaidSo) {
  constexpr int kDraws = 60;
  const std::vector<double> P = geometric_pressures(2, 200, 30);
  const auto denied = [&](CompressionLaw curve, CompressionLaw law) {
    RandomStream random(4, 0);
    int n = 0;
    for (int draw = 0; draw < kDraws; ++draw)
      n += fit_compression(P, densities(known_laws()[static_cast<std::size_t>(curve)], P, 1e-3, random),
                           std::vector{law}, {})
               .front()
               .pattern.is_systematic();
    return n;
  };
  EXPECT_GE(denied(CompressionLaw::kawakita, CompressionLaw::heckel), 0.95 * kDraws);
  EXPECT_GE(denied(CompressionLaw::heckel, CompressionLaw::kawakita), 0.95 * kDraws);
  EXPECT_LE(denied(CompressionLaw::heckel, CompressionLaw::heckel), 3);
  EXPECT_LE(denied(CompressionLaw::kawakita, CompressionLaw::kawakita), 3);
}

TEST(Heckel, IsFittedToTheStraightPart) {
  // At low pressures, particles rearrange. Above a pressure of 30, the density follows Heckel's law.
  std::vector<double> P, D;
  for (double p = 2; p < 300; p += 8) {
    P.push_back(p);
    D.push_back(1 - std::exp(-(0.6 + p / 120 - 0.3 * std::exp(-p / 8))));
  }
  const CompressionFit fit = fit_compression(P, D, std::vector{CompressionLaw::heckel}, {}).front();
  ASSERT_TRUE(fit.found());
  EXPECT_GT(fit.first, 0);
  EXPECT_NEAR(*fit.parameters[0].value, 120, 2);
  EXPECT_THAT(fit.warnings, Contains(HasSubstr("only the straight part of the curve")));
}

TEST(Kawakita, TendsToOneAtMostUnlessTheBoundIsLifted) {
  const std::vector<double> P = geometric_pressures(2, 200, 30);
  std::vector<double> D;
  for (const double p : P) D.push_back(0.4 / (1 - 0.65 * 0.02 * p / (1 + 0.02 * p)));
  const CompressionFit bounded = fit_compression(P, D, std::vector{CompressionLaw::kawakita}, {}).front();
  EXPECT_FALSE(bounded.parameters[3].value);
  EXPECT_EQ(bounded.parameters[3].high95, 1.0);
  CompressionOptions in_die;
  in_die.phi_limit = kInfinity;
  in_die.D0 = 0.4;
  const CompressionFit open = fit_compression(P, D, std::vector{CompressionLaw::kawakita}, in_die).front();
  EXPECT_NEAR(*open.parameters[3].value, 0.4 / 0.35, 1e-6);
  EXPECT_EQ(open.parameters[2].value, 0.4);
  EXPECT_FALSE(open.parameters[2].standard_error);
}

TEST(Kawakita, AtTheBoundOfItsLimitHasIntervalsThatHoldTheTruth) {
  // With this noise, the best limit of every fifth curve is above 1.
  constexpr double kD0 = 0.4, kB = 0.05, kLimit = 0.98;
  const std::map<std::string, double> truth = {
      {"a", 1 - kD0 / kLimit}, {"b", kB}, {"D0", kD0}, {"Phi_max", kLimit}};
  const std::vector<double> P = geometric_pressures(1, 100, 15);
  RandomStream random(11, 0);
  std::map<std::string, int> held;
  int n_at_bound = 0;
  for (int draw = 0; draw < 200; ++draw) {
    std::vector<double> D;
    for (const double p : P)
      D.push_back(kD0 / (1 - truth.at("a") * kB * p / (1 + kB * p)) * (1 + 0.01 * random.normal()));
    const CompressionFit fit = fit_compression(P, D, std::vector{CompressionLaw::kawakita}, {}).front();
    if (fit.parameters[3].value) continue;
    ++n_at_bound;
    for (const FittedParameter& p : fit.parameters)
      held[p.name] +=
          p.low95.value_or(-kInfinity) <= truth.at(p.name) && truth.at(p.name) <= p.high95.value_or(kInfinity);
  }
  ASSERT_GT(n_at_bound, 30);
  for (const auto& [name, n_held] : held) EXPECT_GE(n_held, 0.9 * n_at_bound) << name;
}

TEST(CooperEaton, HasNoErrorOfATermThatTheDataDoNotHave) {
  const std::vector<double> P = geometric_pressures(1, 100, 20);
  RandomStream random(34, 0);
  for (int draw = 0; draw < 20; ++draw) {
    std::vector<double> D;
    for (const double p : P)
      D.push_back(0.5 / (1 - 0.5 * 0.7 * std::exp(-10 / p)) * (1 + 1e-3 * random.normal()));
    const CompressionFit fit = fit_compression(P, D, std::vector{CompressionLaw::cooper_eaton}, {}).front();
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    for (const FittedParameter& p : fit.parameters) {
      EXPECT_EQ(p.identified, p.standard_error.has_value()) << p.name;
      EXPECT_GT(p.standard_error.value_or(1.0), 0.0) << p.name;
    }
  }
}

TEST(CompressionLaws, GivenNumbersThatContradictTheDataAreNamed) {
  const std::vector<double> P = geometric_pressures(1, 128, 8);
  const std::vector<double> D = {0.5, 0.52, 0.54, 0.56, 0.58, 0.6, 0.62, 0.63};
  const auto fit = [&](double D0, double phi_limit) {
    return fit_compression(P, D, std::vector{CompressionLaw::kawakita}, {D0, phi_limit}).front();
  };
  EXPECT_THAT(fit(0.63, 1.0).failure_reason, HasSubstr("D0, 0.63, is not below the largest solid fraction"));
  EXPECT_THAT(fit(0.0, 0.5).failure_reason,
              HasSubstr("Phi_max, 0.5, is not above the smallest solid fraction"));
  EXPECT_THAT(fit(0.51, 1.0).warnings, Contains(HasSubstr("D0, 0.51, is above the smallest solid fraction")));
  EXPECT_THAT(fit(0.0, 0.62).warnings,
              Contains(HasSubstr("Phi_max, 0.62, is below the largest solid fraction")));
}

TEST(CompressionLaws, TooFewPressuresAreRefused) {
  EXPECT_THAT(fit_compression({1, 2, 3}, {0.5, 0.6, 0.7}, std::vector{CompressionLaw::adams}, {})
                  .front()
                  .failure_reason,
              HasSubstr("3 pressures"));
}

}  // namespace
}  // namespace floc::test
