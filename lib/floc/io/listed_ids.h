#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "floc/io/listed_packing.h"

namespace floc {

/// Returns the end of an error message about a contact whose grains are unknown or too far apart. It is a hint that the
/// list of contacts seems to number the grains from 1, although the grains are numbered from 0. The text is empty if
/// there is no sign of this mistake.
std::string counting_hint(const ListedPacking& listed);

/// Maps the identifiers of grains to the indices of the grains in a listed packing. The packing must exist as long as
/// this object.
class Identifiers {
 public:
  /// Collects the identifiers of all grains.
  /// @throws InputError naming the place of a grain if an earlier grain has the same identifier
  explicit Identifiers(const ListedPacking& listed);

  /// Returns the index of the grain with the identifier `id`.
  /// @param place  place of the identifier in the file, for messages
  /// @param name  name of the column that contains the identifier, for messages
  /// @throws InputError if no grain has this identifier
  int index(const FileLine& place, const char* name, std::int64_t id) const;

 private:
  const ListedPacking& listed_;
  std::vector<std::pair<std::int64_t, int>> index_;  // pairs of identifier and index, sorted by identifier
};

}  // namespace floc
