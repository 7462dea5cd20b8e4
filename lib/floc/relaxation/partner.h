#pragma once

namespace floc {

/// Kind of the second body of each pair in a list of pairs; the first body is a grain.
enum class Partner { grain, wall };

}  // namespace floc
