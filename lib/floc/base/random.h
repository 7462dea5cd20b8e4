#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace floc {

/// Seeded stream of random numbers, from the generator SplitMix64 (Steele, Lea, Flood, OOPSLA 2014). The state of the
/// generator is one 64-bit integer, which a state file of a packing can store. This class itself converts the integers
/// of the generator to real numbers, because the distributions of the standard library give different numbers in
/// different implementations.
class RandomStream {
 public:
  /// Starts a stream of random numbers. Streams with the same `seed` and different values of `purpose` are independent.
  RandomStream(std::uint64_t seed, std::uint64_t purpose) : state_(seed) {
    state_ = next() ^ (purpose * 0xd1342543de82ef95ULL);
    next();
  }
  explicit RandomStream(std::uint64_t saved_state) : state_(saved_state) {}

  std::uint64_t state() const { return state_; }

  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  /// Returns a uniformly distributed random number in [0, 1) with 53 random bits.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

  /// Returns a uniformly distributed random number in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Returns a uniformly distributed random integer in [0, n). The bias is below 2^-32 for n < 2^32. @pre n > 0
  std::uint64_t below(std::uint64_t n) {
    return static_cast<std::uint64_t>(uniform() * static_cast<double>(n));
  }

  /// Returns a normally distributed random number with mean 0 and standard deviation 1 (the first number of a
  /// Box-Muller pair).
  double normal() {
    const double u = 1.0 - uniform();
    const double v = uniform();
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
  }

 private:
  std::uint64_t state_;
};

}  // namespace floc
