#include "floc/packing/law/stiffness_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "floc/packing/body_name.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/law/law_response.h"

namespace floc {
namespace {

/// Whether the stiffnesses of a contact follow from its elastic force alone. Under a normal law with a history, they
/// also depend on the history.
template <class Law>
inline constexpr bool kFollowsFromForce = history_size<typename Law::NormalModel>(2) == 0;

/// Returns whether two ratios of stiffnesses are equal up to the rounding of the numbers in files.
bool same_factor(double a, double b) {
  return !differ(a, b, 10.0 * kForeignStiffness);
}

std::string factor_text(double least, double largest) {
  return same_factor(least, largest) ? fmt::format("{:.4g}", largest)
                                     : fmt::format("{:.4g} to {:.4g}", least, largest);
}

}  // namespace

template <int Dim>
Stiffnesses law_stiffnesses(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  Contact<Dim> by_law = contact;
  const Law& parameters = packing.is_wall(contact.j) ? packing.wall_law : packing.law;
  if (contact.bonded || parameters.is_rigid()) return stiffnesses(contact);
  std::visit(
      [&]<class Law>(const Law& law) {
        if (contact.distant || !kFollowsFromForce<Law>) return refresh_contact(packing, by_law);
        const ContactStiffness k =
            law.stiffness_at_force(pair_geometry(packing.grains, contact), contact.elastic_force);
        by_law.kn = k.normal, by_law.kt = k.tangential, by_law.kr = k.rolling, by_law.ktw = k.twisting;
      },
      compose_law(parameters));
  return stiffnesses(by_law);
}

bool differ(double found, double by_law, double tolerance) {
  return !(std::abs(found - by_law) <= tolerance * std::abs(by_law));
}

void StiffnessComparison::add(const Stiffnesses& found, const Stiffnesses& by_law, const std::string& names) {
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    if (!differ(found[k], by_law[k], kForeignStiffness)) continue;
    Kind& kind = kinds_[k];
    const bool first = kind.n++ == 0;
    const double factor = found[k] / by_law[k];
    kind.least = first ? factor : std::min(kind.least, factor);
    kind.largest = first ? factor : std::max(kind.largest, factor);
    const double difference = std::abs(factor - 1.0);
    if (!first && !(difference > kind.worst)) continue;
    kind.worst = difference;
    kind.found = found[k], kind.by_law = by_law[k], kind.names = names;
  }
}

std::vector<std::string> StiffnessComparison::differences(double force_exponent) const {
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    const Kind& kind = kinds_[k];
    if (kind.n == 0) continue;
    std::string text = fmt::format("{} of {} contact{} ", kStiffnessNames[k], kind.n, kind.n == 1 ? "" : "s");
    text += std::isfinite(kind.largest)
                ? fmt::format("is {} times the value of the contact law", factor_text(kind.least, kind.largest))
                : "is not zero, but it is zero by the contact law";
    text += fmt::format(" (grains {}: {:.6g}, by the law {:.6g})", kind.names, kind.found, kind.by_law);
    const double secant = 1.0 / force_exponent;
    if (k == 0 && secant != 1.0 && same_factor(kind.least, secant) && same_factor(kind.largest, secant))
      text += fmt::format(
          ": the value is N/delta (normal force N divided by overlap delta), but the stiffness of the law is "
          "{:g} N/delta",
          force_exponent);
    texts.push_back(std::move(text));
  }
  return texts;
}

template <int Dim>
std::string stiffness_differences(const Packing<Dim>& packing) {
  StiffnessComparison comparison;
  for (const Contact<Dim>& c : packing.contacts)
    comparison.add(stiffnesses(c), law_stiffnesses(packing, c),
                   fmt::format("{}-{}", packing.grains.name(c.i), body_name(packing, c.j)));
  return fmt::format("{}", fmt::join(comparison.differences(packing.law.force_exponent()), "; "));
}

#define FLOC_INSTANTIATE(Dim)                                                     \
  template Stiffnesses law_stiffnesses(const Packing<Dim>&, const Contact<Dim>&); \
  template std::string stiffness_differences(const Packing<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
