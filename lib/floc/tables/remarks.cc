#include "floc/tables/remarks.h"

#include <cstdlib>

namespace floc {

double first_number(const std::string& text) {
  const std::size_t at = text.find_first_of("0123456789");
  return at == std::string::npos ? 0.0 : std::strtod(text.c_str() + at, nullptr);
}

}  // namespace floc
