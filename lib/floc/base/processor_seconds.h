#pragma once

namespace floc {

/// Processor time of this process so far (s).
double processor_seconds();

}  // namespace floc
