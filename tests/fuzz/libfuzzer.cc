#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "readers.h"

/// Entry points of libFuzzer. The environment variable FLOC_FUZZ names the reader under test.
namespace {

const floc::fuzz::Reader& chosen() {
  static const floc::fuzz::Reader* const reader = [] {
    const char* name = std::getenv("FLOC_FUZZ");
    for (const floc::fuzz::Reader& r : floc::fuzz::readers())
      if (name != nullptr && std::strcmp(name, r.name) == 0) return &r;
    std::fputs("FLOC_FUZZ has to name a reader:", stderr);
    for (const floc::fuzz::Reader& r : floc::fuzz::readers()) std::fprintf(stderr, " %s", r.name);
    std::fputs("\n", stderr);
    std::exit(2);
  }();
  return *reader;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  chosen().read(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
