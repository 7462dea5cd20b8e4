#pragma once

namespace floc {

/// Flushes stdout; has to be called after all output. @throws IoError if some of it could not be written
void finish_output();

}  // namespace floc
