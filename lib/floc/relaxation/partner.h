#pragma once

namespace floc {

/// Kind of the second body of all pairs in a list. (The first body of a pair is always a grain.)
enum class Partner { grain, wall };

}  // namespace floc
