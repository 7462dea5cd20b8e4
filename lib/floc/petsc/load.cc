#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

#include "floc/petsc/parallel_solver.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

/// Directories in which floc's PETSc module may be, relative to the directory of the program: the first in the build
/// tree, the second in an installation.
constexpr const char* kPlaces[] = {".", FLOC_PETSC_MODULE_FROM_PROGRAM};

/// Returns the path of floc's PETSc module. If no directory in kPlaces contains the module, returns only the name of
/// the file, so that the dynamic loader searches its own directories.
fs::path module_path() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const char* place : kPlaces) {
    fs::path path = program / place / FLOC_PETSC_MODULE;
    if (fs::exists(path, none)) return path;
  }
  return FLOC_PETSC_MODULE;
}

}  // namespace

bool has_parallel_solver() {
  return FLOC_PETSC_BUILT != 0;
}

std::unique_ptr<ParallelSolver> load_parallel_solver() {
  if (!has_parallel_solver())
    throw std::runtime_error(
        "this floc was built without PETSc: build it with -DFLOC_PETSC=ON, which needs PETSc (Debian package "
        "libpetsc-real-dev)");
  // The module is loaded only when needed, because PETSc depends on about eighty libraries. Loading these libraries
  // takes longer than running most commands.
  void* module = dlopen(module_path().c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr)
    throw std::runtime_error(std::string("the PETSc module cannot be loaded: ") + dlerror());
  using Make = ParallelSolver* (*)();
  const auto make = reinterpret_cast<Make>(dlsym(module, "floc_make_petsc_solver"));
  if (make == nullptr)
    throw std::runtime_error(std::string("the file that was loaded is not floc's PETSc module: ") + dlerror());
  return std::unique_ptr<ParallelSolver>(make());
}

}  // namespace floc
