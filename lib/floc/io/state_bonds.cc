#include "floc/io/state_bonds.h"

#include <algorithm>
#include <vector>

namespace floc {
namespace {

constexpr Field kBonded = {
    "contacts/bonded", Quantity::flag,
    "1: a bond, which acts whatever its gap; its forces and stiffnesses do not follow from the law; absent: 0"};

}  // namespace

template <int Dim>
bool has_bonds(const Packing<Dim>& packing) {
  return std::any_of(packing.contacts.begin(), packing.contacts.end(),
                     [](const Contact<Dim>& c) { return c.bonded; });
}

template <int Dim>
bool keeps_twisting(const Packing<Dim>& packing) {
  return packing.law.has_twisting() || (Dim == 3 && has_bonds(packing));
}

template <int Dim>
void write_bonds(WritingArchive& archive, const Packing<Dim>& packing) {
  if (!has_bonds(packing)) return;
  std::vector<std::uint8_t> flags;
  for (const Contact<Dim>& c : packing.contacts) flags.push_back(c.bonded);
  archive.put(kBonded, {flags.size()}, flags);
}

template <int Dim>
void read_bonds(const Hdf5Reader& file, ReadingArchive& archive, Packing<Dim>& packing) {
  if (!file.has(kBonded.path)) return;
  const auto flags = archive.take<std::uint8_t>(kBonded, {packing.contacts.size()});
  for (std::size_t c = 0; c < flags.size(); ++c) packing.contacts[c].bonded = flags[c] != 0;
}

#define FLOC_INSTANTIATE(Dim)                                      \
  template bool has_bonds(const Packing<Dim>&);                    \
  template bool keeps_twisting(const Packing<Dim>&);               \
  template void write_bonds(WritingArchive&, const Packing<Dim>&); \
  template void read_bonds(const Hdf5Reader&, ReadingArchive&, Packing<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
