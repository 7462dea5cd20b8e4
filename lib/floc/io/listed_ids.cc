#include "floc/io/listed_ids.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "floc/base/error.h"

namespace floc {

std::string counting_hint(const ListedPacking& listed) {
  if (!listed.contacts) return "";
  for (std::size_t i = 0; i < listed.grains.size(); ++i)
    if (listed.grains[i].id != static_cast<std::int64_t>(i)) return "";
  std::int64_t lowest = std::numeric_limits<std::int64_t>::max();
  for (const ListedContact& c : *listed.contacts) lowest = std::min({lowest, c.id1, c.wall ? c.id1 : c.id2});
  if (lowest != 1) return "";
  return "; the list of contacts seems to number the grains from 1, but they are numbered from 0: add a "
         "column id to the grains, or subtract 1 from id1 and id2";
}

Identifiers::Identifiers(const ListedPacking& listed) : listed_(listed) {
  const std::vector<ListedGrain>& grains = listed.grains;
  index_.reserve(grains.size());
  for (const ListedGrain& grain : grains) index_.emplace_back(grain.id, static_cast<int>(index_.size()));
  std::sort(index_.begin(), index_.end());
  // If several identifiers are repeated, the error names the first grain in the file whose identifier belongs to an
  // earlier grain, too.
  int twice = static_cast<int>(grains.size());
  for (std::size_t k = 1; k < index_.size(); ++k)
    if (index_[k].first == index_[k - 1].first) twice = std::min(twice, index_[k].second);
  if (twice < static_cast<int>(grains.size()))
    throw InputError(grains[twice].place.text(), fmt::format("id = {} is given twice", grains[twice].id));
}

int Identifiers::index(const FileLine& place, const char* name, std::int64_t id) const {
  const auto found = std::lower_bound(index_.begin(), index_.end(), std::pair(id, 0));
  if (found != index_.end() && found->first == id) return found->second;
  throw InputError(
      place.text(),
      fmt::format("{} = {}: no grain has this id; the ids of grains are from {} to {}; if it is the id of a "
                  "wall, give --wall-ids, for example {}=z-{}",
                  name, id, index_.front().first, index_.back().first, id, counting_hint(listed_)));
}

}  // namespace floc
