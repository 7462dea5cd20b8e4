#include "floc/rigid/contact_colours.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>

namespace floc {

template <int Dim>
std::vector<bool> moving_bodies(const BodyMotion<Dim>& bodies) {
  std::vector<bool> out(bodies.velocity.size());
  for (int i = 0; i < bodies.size(); ++i)
    out[i] = !bodies.inverse_mass[i].isZero(0.0) || !bodies.inverse_inertia[i].isZero(0.0);
  return out;
}

template <int Dim>
ContactColours colour_contacts(const std::vector<bool>& moving, const std::vector<StepContact<Dim>>& contacts,
                               const std::vector<int>& chosen) {
  std::vector<std::uint64_t> taken(moving.size(), 0);
  std::vector<int> colour, count(kMostColours + 1, 0);
  colour.reserve(chosen.size());
  for (const int k : chosen) {
    std::uint64_t used = 0;
    for (const int body : {contacts[k].i, contacts[k].j})
      if (moving[body]) used |= taken[body];
    const int free = std::min(std::countr_one(used), kMostColours - 1);
    colour.push_back(free);
    ++count[free + 1];
    for (const int body : {contacts[k].i, contacts[k].j}) taken[body] |= std::uint64_t{1} << free;
  }
  ContactColours out;
  std::partial_sum(count.begin(), count.end(), count.begin());
  while (count.size() > 1 && count.end()[-2] == count.back()) count.pop_back();
  out.start = count;
  out.contacts.resize(chosen.size());
  for (std::size_t n = 0; n < chosen.size(); ++n) out.contacts[count[colour[n]]++] = chosen[n];
  return out;
}

template std::vector<bool> moving_bodies(const BodyMotion<2>&);
template std::vector<bool> moving_bodies(const BodyMotion<3>&);
template ContactColours colour_contacts(const std::vector<bool>&, const std::vector<StepContact<2>>&,
                                        const std::vector<int>&);
template ContactColours colour_contacts(const std::vector<bool>&, const std::vector<StepContact<3>>&,
                                        const std::vector<int>&);

}  // namespace floc
