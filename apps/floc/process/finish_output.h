#pragma once

namespace floc {

/// Flushes stdout; has to be called after all output. @throws IoError if some of the output could not be written
void finish_output();

}  // namespace floc
