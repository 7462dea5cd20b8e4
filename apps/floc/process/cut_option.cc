#include "process/cut_option.h"

#include <optional>
#include <string_view>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"

namespace floc {

CrossSection parse_cut(const std::string& text) {
  const std::size_t axis =
      text.size() > 2 && text[1] == ',' ? std::string_view("xyz").find(text[0]) : std::string::npos;
  const auto at =
      axis == std::string::npos ? std::nullopt : parse_number<double>(std::string_view(text).substr(2));
  const CrossSection cut = {static_cast<int>(axis), at.value_or(0.0)};
  if (!at || !cut.validate().empty())
    throw InputError("--cut " + text,
                     "this is not a section: expected AXIS,FRACTION with an axis x, y or z and a fraction of "
                     "the cell from 0 to 1, such as y,0.5");
  return cut;
}

}  // namespace floc
