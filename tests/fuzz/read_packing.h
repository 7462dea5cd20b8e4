#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <variant>

#include "floc/base/error.h"
#include "floc/io/import.h"
#include "floc/io/law_text.h"
#include "floc/neighbors/find_contacts.h"

namespace floc::fuzz {

/// File in memory, with a path that any reader can open.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& bytes) : descriptor_(::memfd_create("fuzz", 0)) {
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t n = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
      if (n <= 0) throw std::runtime_error("no memory file");
      done += static_cast<std::size_t>(n);
    }
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

inline Law law() {
  return parse_law("fuzz",
                   "normal.stiffness=1e3,adhesion.force=1,adhesion.range=1e-3,friction.coefficient=0.5,"
                   "friction.stiffness=1e3,rolling.coefficient=0.01,rolling.stiffness=1");
}

/// Reads the file `path`, including its contacts, in the same way as `floc convert`.
template <class Read>
void read_packing_at(const Read& read, const std::string& path,
                     const std::function<void(ImportOptions&)>& set = {}) {
  ImportOptions options;
  options.law = law();
  if (set) set(options);
  try {
    Imported imported = read(path, options);
    if (!imported.contacts_known) std::visit([](auto& state) { find_contacts(state.packing); }, imported.state);
  } catch (const InputError&) {
  }
}

/// Reads bytes as the content of a file, in the same way as read_packing_at().
template <class Read>
void read_packing(const Read& read, const std::string& bytes,
                  const std::function<void(ImportOptions&)>& set = {}) {
  const MemoryFile file(bytes);
  read_packing_at(read, file.path(), set);
}

}  // namespace floc::fuzz
