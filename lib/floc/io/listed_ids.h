#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "floc/io/listed_packing.h"

namespace floc {

/// Returns a hint for the error message about a contact of an unknown grain: whether the list of contacts seems to
/// count grains from 1 where the grains are counted from 0. Empty if it does not seem so. @pre the packing lists
/// contacts
std::string counting_hint(const ListedPacking& listed);

/// Maps identifiers of grains to their indices in a listed packing, which has to outlive this object.
class Identifiers {
 public:
  /// @throws InputError naming the place of an identifier that is given twice
  explicit Identifiers(const ListedPacking& listed);

  /// Returns the index of the grain with this identifier.
  /// @param place  place of the identifier, for messages  @param name  its column, for messages
  /// @throws InputError if no grain has the identifier
  int index(const FileLine& place, const char* name, std::int64_t id) const;

 private:
  const ListedPacking& listed_;
  std::vector<std::pair<std::int64_t, int>> index_;  // sorted by identifier
};

}  // namespace floc
