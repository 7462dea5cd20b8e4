#include "floc/io/state_bonds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "floc/base/error.h"
#include "floc/packing/bonds.h"

namespace floc {
namespace {

constexpr Field kBonded = {
    "contacts/bonded", Quantity::flag,
    "1: a bond, which acts whatever its gap; its forces and stiffnesses do not follow from the law; absent: 0"};

/// Arrays of the strengths, in the order of kStrengthNames.
constexpr std::array<Field, 4> kStrengths = {
    {{"contacts/tensile_strength", Quantity::force, "largest tension that the contact bears; 0: not given"},
     {"contacts/shear_strength", Quantity::force, "largest tangential force that it bears; 0: not given"},
     {"contacts/rolling_strength", Quantity::moment, "largest rolling moment that it bears; 0: not given"},
     {"contacts/twisting_strength", Quantity::moment, "largest twisting moment that it bears; 0: not given"}}};

template <int Dim>
void write_strengths(WritingArchive& archive, const State<Dim>& state) {
  const std::vector<Strengths> all = strengths_by_contact(state.packing.contacts, state.bond_strengths);
  for (std::size_t k = 0; k < kStrengths.size(); ++k) {
    std::vector<double> values;
    for (const Strengths& of_contact : all) values.push_back(of_contact[k]);
    if (std::any_of(values.begin(), values.end(), [](double s) { return s > 0.0; }))
      archive.put(kStrengths[k], {values.size()}, values);
  }
}

template <int Dim>
void read_strengths(const Hdf5Reader& file, ReadingArchive& archive, State<Dim>& state) {
  const std::vector<Contact<Dim>>& contacts = state.packing.contacts;
  std::vector<Strengths> all(contacts.size());
  for (std::size_t k = 0; k < kStrengths.size(); ++k) {
    if (!file.has(kStrengths[k].path)) continue;
    const auto values = archive.take<double>(kStrengths[k], {contacts.size()});
    for (std::size_t c = 0; c < values.size(); ++c) {
      if (!(values[c] >= 0.0))
        throw InputError(file.place(kStrengths[k].path),
                         fmt::format("entry {} is {}, expected a strength of 0 or more", c, values[c]));
      all[c][k] = values[c];
    }
  }
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (all[c] != Strengths{})
      state.bond_strengths.push_back({contacts[c].i, contacts[c].j, contacts[c].image, all[c]});
}

}  // namespace

template <int Dim>
bool keeps_twisting(const Packing<Dim>& packing) {
  return packing.law.has_twisting() || (Dim == 3 && has_bonds(packing));
}

template <int Dim>
void write_bonds(WritingArchive& archive, const State<Dim>& state) {
  write_strengths(archive, state);
  const Packing<Dim>& packing = state.packing;
  if (!has_bonds(packing)) return;
  std::vector<std::uint8_t> flags;
  for (const Contact<Dim>& c : packing.contacts) flags.push_back(c.bonded);
  archive.put(kBonded, {flags.size()}, flags);
}

template <int Dim>
void read_bonds(const Hdf5Reader& file, ReadingArchive& archive, State<Dim>& state) {
  read_strengths(file, archive, state);
  Packing<Dim>& packing = state.packing;
  if (!file.has(kBonded.path)) return;
  const auto flags = archive.take<std::uint8_t>(kBonded, {packing.contacts.size()});
  for (std::size_t c = 0; c < flags.size(); ++c) packing.contacts[c].bonded = flags[c] != 0;
}

#define FLOC_INSTANTIATE(Dim)                                    \
  template bool keeps_twisting(const Packing<Dim>&);             \
  template void write_bonds(WritingArchive&, const State<Dim>&); \
  template void read_bonds(const Hdf5Reader&, ReadingArchive&, State<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
