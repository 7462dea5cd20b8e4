#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "floc/io/listed_packing.h"

namespace floc {

/// What explains a list of contacts that do not go with the grains: it counts them from 1 where they are counted
/// from 0. Nothing where it does not look so. @pre the packing lists contacts
std::string counting_hint(const ListedPacking& listed);

/// Index of each identifier of the grains that a packing lists, which has to outlive this.
class Identifiers {
 public:
  /// @throws InputError naming the place of an identifier that is given twice
  explicit Identifiers(const ListedPacking& listed);

  /// @param name  of the column, for messages  @throws InputError if no grain has the identifier
  int index(const FileLine& place, const char* name, std::int64_t id) const;

 private:
  const ListedPacking& listed_;
  std::vector<std::pair<std::int64_t, int>> index_;  // sorted by identifier
};

}  // namespace floc
