#pragma once

namespace floc {

/// To be called when all of stdout is written. @throws IoError if some of it could not be
void finish_output();

}  // namespace floc
