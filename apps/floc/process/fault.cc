#include "process/fault.h"

#include "floc/base/error.h"
#include "process/command.h"

namespace floc {

Fault fault_of(const std::string& file, const std::function<int()>& work) {
  try {
    return {work(), ""};
  } catch (const InputError& error) {
    // the message of an error in a packing may lack the name of the file
    const std::string message = error.what();
    return {kBadInput, message.find(file) == std::string::npos ? file + ": " + message : message};
  } catch (const IoError& error) {
    return {kFailure, error.what()};
  } catch (const NoResult& error) {
    return {kNotConverged, file + ": " + error.what()};
  } catch (const std::exception& error) {
    return {kFailure, file + ": " + error.what()};
  }
}

}  // namespace floc
