#include "floc/io/transient_file.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <utility>

namespace floc {
namespace {

/// Paths of the existing transient files, which the signal handler removes. Null marks a free entry. The entries
/// usually suffice for all transient files of a program. If no entry is free, a file is removed only by the destructor
/// of TransientFile, not by the signal handler.
std::array<std::atomic<const char*>, 64> g_names{};

void register_name(const char* name) {
  for (std::atomic<const char*>& place : g_names)
    if (const char* none = nullptr; place.compare_exchange_strong(none, name)) return;
}

void forget_name(const char* name) {
  for (std::atomic<const char*>& place : g_names)
    if (const char* expected = name; place.compare_exchange_strong(expected, nullptr)) return;
}

/// Signal handler: removes all transient files and ends the program. It calls only async-signal-safe functions.
void remove_all(int signal) {
  for (const std::atomic<const char*>& place : g_names)
    if (const char* name = place.load()) ::unlink(name);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

TransientFile::TransientFile(std::string path) : path_(std::move(path)) {
  register_name(path_.c_str());
}

TransientFile::~TransientFile() {
  if (!kept_) ::unlink(path_.c_str());
  forget_name(path_.c_str());
}

void TransientFile::keep() {
  forget_name(path_.c_str());
  kept_ = true;
}

void remove_transient_files_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, remove_all) == SIG_IGN) std::signal(signal, SIG_IGN);
}

}  // namespace floc
