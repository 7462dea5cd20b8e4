#pragma once

#include <string>

#include "floc/base/error.h"

namespace floc::test {

/// Returns the message of the InputError that a call throws; empty if it throws none.
template <class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace floc::test
