#pragma once

namespace floc {

/// The second body of the pairs of a list.
enum class Partner { grain, wall };

}  // namespace floc
