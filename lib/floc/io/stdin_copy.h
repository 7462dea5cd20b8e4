#pragma once

#include <string>

#include "floc/io/descriptor.h"

namespace floc {

/// A copy of standard input in a temporary file. Standard input can be read only once; the copy can be read several
/// times, for example to recognise its format. Compressed input is decompressed.
class StdinCopy {
 public:
  /// Reads standard input to its end. Afterwards, standard input reads the copy, from its beginning.
  /// @throws IoError if the temporary file cannot be written or read
  StdinCopy();

  const std::string& path() const { return file_.path(); }

 private:
  TemporaryFile file_;
};

}  // namespace floc
