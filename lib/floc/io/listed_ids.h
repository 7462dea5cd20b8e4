#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "floc/io/listed_packing.h"

namespace floc {

/// Returns a hint for error messages about contacts whose grains are unknown or too far apart. The hint says that the
/// list of contacts seems to number the grains from 1, although they are numbered from 0. It is empty if this is not
/// the case. @pre `listed` has contacts
std::string counting_hint(const ListedPacking& listed);

/// Maps identifiers of grains to their indices in a listed packing, which has to outlive this object.
class Identifiers {
 public:
  /// Collects the identifiers. @throws InputError naming the place of an identifier that is given twice
  explicit Identifiers(const ListedPacking& listed);

  /// Returns the index of the grain with this identifier.
  /// @param place  place of the identifier, for messages  @param name  column of the identifier, for messages
  /// @throws InputError if no grain has the identifier
  int index(const FileLine& place, const char* name, std::int64_t id) const;

 private:
  const ListedPacking& listed_;
  std::vector<std::pair<std::int64_t, int>> index_;  // sorted by identifier
};

}  // namespace floc
