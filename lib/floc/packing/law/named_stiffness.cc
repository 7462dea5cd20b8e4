#include "floc/packing/law/named_stiffness.h"

#include <vector>

#include "floc/base/error.h"
#include "floc/contact/law_parameters.h"
#include "floc/packing/contact_order.h"

namespace floc {

StiffnessPer stiffness_per(const std::string& keyword) {
  return keyword == "contact" ? StiffnessPer::contact : StiffnessPer::point;
}

template <int Dim>
Packing<Dim> with_named_stiffness(Packing<Dim> packing, const NamedStiffness& named) {
  if (!packing.law.is_rigid())
    throw InputError("--kn",
                     "the contacts of this packing are elastic and have stiffnesses of their own; expected "
                     "that no stiffness is given");
  const double mu = packing.law.friction_coefficient();
  if (!(named.normal > 0.0)) throw InputError("--kn", "expected a positive stiffness (force/length)");
  if (packing.law.resists_sliding() != (named.tangential > 0.0))
    throw InputError("--kt",
                     packing.law.resists_sliding()
                         ? "the contacts have friction: expected a positive tangential stiffness (force/length)"
                         : "the contacts have no friction: expected no tangential stiffness");
  LawParameters law = packing.law.parameters();
  law.normal = LinearRepulsion{named.normal};
  if (packing.law.resists_sliding())
    law.friction = CoulombFriction{mu, named.tangential};
  else
    law.friction = NoFriction{};
  packing.law = law;
  std::vector<Contact<Dim>>& contacts = packing.contacts;
  for (std::size_t first = 0, last; first < contacts.size(); first = last) {
    last = first + 1;
    while (named.per == StiffnessPer::contact && last < contacts.size() &&
           same_pair(contacts[last], contacts[first]))
      ++last;
    const double share = 1.0 / static_cast<double>(last - first);
    for (std::size_t k = first; k < last; ++k) {
      contacts[k].kn = share * named.normal;
      contacts[k].kt = share * named.tangential;
    }
  }
  return packing;
}

template Packing<2> with_named_stiffness(Packing<2>, const NamedStiffness&);
template Packing<3> with_named_stiffness(Packing<3>, const NamedStiffness&);

}  // namespace floc
