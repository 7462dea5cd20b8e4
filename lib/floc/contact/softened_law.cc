#include "floc/contact/softened_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/contact/law_description.h"
#include "floc/contact/law_parameters.h"

namespace floc {
namespace {

/// Largest allowed overlap of two grains under their pull-off force, divided by the range D0 of the adhesion.
constexpr double kShareOfRange = 0.1;
/// Largest allowed ratio of the pressure to the modulus of the packing (Law::contact_modulus()).
constexpr double kLargestStrain = 0.01;
/// Tolerance of the two limits above for rounding errors (relative), so that a softening factor equal to the limit is
/// allowed.
constexpr double kRounding = 1e-9;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Whether a number of a contact law is the stiffness of a spring.
bool is_stiffness(const LawNumber& number) {
  if (number.key.starts_with("adhesion.")) return false;
  const Unit unit = number.declared->unit;
  return unit == Unit::stiffness || unit == Unit::rolling_stiffness || unit == Unit::pressure;
}

}  // namespace

Law softened(const Law& law, double s) {
  LawParameters parameters = law;
  for (const LawNumber& number : numbers_of(parameters))
    if (is_stiffness(number)) *number.value /= s;
  return parameters;
}

std::string SofteningLimit::fault(double s) const {
  if (s <= std::max(1.0, largest * (1.0 + kRounding))) return "";
  if (largest < 1.0 + kRounding) return reason + "; expected 1 (no softening)";
  return fmt::format("{}; expected at most {:.6g}", reason, largest);
}

SofteningLimit softening_limit(const Law& law, int dim, double diameter, double pressure) {
  if (law.is_rigid()) return {1.0, "rigid contacts have no springs that could be softer"};
  if (law.liquid() != nullptr) return {1.0, "the springs of grains with liquid bridges cannot be softened"};
  const double modulus = law.contact_modulus(dim, diameter);
  const double stiffness = modulus * std::pow(diameter, dim - 2);
  const double F0 = law.pull_off_force();
  const double by_adhesion = F0 > 0.0 ? kShareOfRange * law.range() * stiffness / F0 : kInfinity;
  const double by_pressure = pressure > 0.0 ? kLargestStrain * modulus / pressure : kInfinity;
  if (by_adhesion < by_pressure)
    return {by_adhesion,
            "on softer springs, the overlap of two grains under their adhesion would exceed a tenth of the "
            "range of the adhesion"};
  return {by_pressure,
          fmt::format(
              "on softer springs, the pressure {:.4g} would exceed a hundredth of the modulus of the contacts",
              pressure)};
}

}  // namespace floc
