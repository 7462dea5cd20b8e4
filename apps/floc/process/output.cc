#include "process/output.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "floc/base/error.h"
#include "floc/packing/overlaps.h"
#include "process/command.h"
#include "process/fault.h"
#include "process/finish_output.h"
#include "process/repeated_warnings.h"
#include "process/sampled_states.h"

namespace floc {

void finish_output() {
  std::cout.flush();
  if (!std::cout)
    throw IoError("standard output",
                  std::string("cannot be written: ") + std::strerror(errno != 0 ? errno : EIO));
}

std::string duration_text(double seconds) {
  constexpr double kMinute = 60.0, kHour = 3600.0, kDay = 86400.0;
  if (seconds < 2 * kMinute) return fmt::format("{:.0f} s", seconds);
  if (seconds < 2 * kHour) return fmt::format("{:.0f} min", seconds / kMinute);
  return seconds < 2 * kDay ? fmt::format("{:.1f} h", seconds / kHour)
                            : fmt::format("{:.1f} days", seconds / kDay);
}

int worse(int a, int b) {
  constexpr std::array<int, 6> kFromBest = {kDone,    kVerificationFailed, kNotConverged, kBadInput,
                                            kFailure, kInterrupted};
  const auto rank = [&](int code) { return std::find(kFromBest.begin(), kFromBest.end(), code); };
  return rank(a) < rank(b) ? b : a;
}

void add_states_argument(CommandLine app, std::vector<std::string>& files) {
  app.add_option("STATE", files,
                 "state files, or directories that floc run wrote; - reads one state from stdin")
      .required();
}

int for_each_file(const std::vector<std::string>& files,
                  const std::function<int(const std::string& file)>& work) {
  int code = kDone;
  for (const std::string& file : files) {
    const Fault fault = fault_of(file, [&] { return work(file); });
    if (!fault.message.empty()) std::cerr << "floc: " << fault.message << '\n';
    code = worse(code, fault.code);
  }
  return code;
}

int for_each_state(const std::vector<std::string>& files, const StateWork& work) {
  RepeatedWarnings warnings;
  const Remarks remarks = warnings.remarks();
  const auto read_and_work = [&](const std::string& file) {
    const AnyState state = read_state(file);
    const std::string warning = std::visit([](const auto& s) { return overlap_warning(s.packing); }, state);
    if (!warning.empty()) remarks.warn(file, warning, first_number(warning));
    return work(file, state, remarks);
  };
  return for_each_file(files, [&](const std::string& input) {
    if (input == "-" || !std::filesystem::is_directory(input)) return read_and_work(input);
    return for_each_file(states_of_directory(input), read_and_work);
  });
}

}  // namespace floc
