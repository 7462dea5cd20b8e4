#pragma once

namespace floc {

/// Returns the processor time of this process so far (s).
double processor_seconds();

}  // namespace floc
