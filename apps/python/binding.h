#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <functional>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "blas_threads.h"
#include "floc/base/error.h"
#include "floc/base/interruption.h"
#include "floc/io/state_file.h"
#include "floc/io/table.h"
#include "floc/tables/fit_parameters.h"
#include "floc/tables/remarks.h"

/// What the sources of the Python module share. The module computes what commands compute, by the functions that
/// they call, and hands over tables; floc/*.py makes objects of them.
namespace floc::python {

namespace py = pybind11;

/// A state that Python holds, never changed, and what messages call it.
struct NamedState {
  std::shared_ptr<const AnyState> state;
  std::string name;
};

/// No result, with why in words.
class NumericalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A state that should be an equilibrium and is none.
class EquilibriumError : public NumericalError {
 public:
  using NumericalError::NumericalError;
};

/// Words that become warnings of Python once it may be called again.
using Warnings = std::vector<std::string>;
void issue(const Warnings& warnings);

/// Throws what a signal that came meanwhile raises: KeyboardInterrupt after Ctrl-C. Only the main thread of Python is
/// told of signals.
void check_signals();

/// Does long work while other threads of Python go on; work that takes Remarks has them turned into warnings. Ctrl-C
/// ends it at the next place where the library asks.
template <class Work>
auto without_gil(const Work& work) {
  Warnings warnings;
  auto result = [&] {
    const py::gil_scoped_release released;
    const SingleBlasThread single;
    const InterruptionListener interruptible(check_signals);
    if constexpr (std::is_invocable_v<Work, const Remarks&>)
      return work(Remarks([&warnings](const std::string& file, const std::string& text, double) {
        const std::string prefix = "warning: ";
        warnings.push_back(file + ": " + (text.starts_with(prefix) ? text.substr(prefix.size()) : text));
      }));
    else
      return work();
  }();
  issue(warnings);
  return result;
}

/// Work on one state, whose faults name it as those of commands do.
template <class Work>
auto of_state(const std::string& name, const Work& work) {
  check_interruption();
  try {
    return work();
  } catch (const NoResult& error) {
    throw NumericalError(name + ": " + error.what());
  } catch (const InputError& error) {
    if (std::string(error.what()).find(name) == std::string::npos) throw InputError(name, error.what());
    throw;
  }
}

/// @throws InputError unless `value` is one of the words
void require_one_of(const std::string& name, const std::string& value,
                    std::initializer_list<const char*> words);

/// @throws InputError naming what of `tables` is no table of those that can be had
void require_tables(const std::vector<std::string>& tables, std::initializer_list<const char*> known);
bool contains(const std::vector<std::string>& tables, const char* name);

/// What is undefined, or no finite number, is None.
py::object to_python(const TableValue& value);
py::object to_python(const Json& json);
/// Columns and rows of a table.
py::tuple to_python(const Table& table);
/// An array for each column; what is undefined among numbers is NaN.
py::dict columns_to_python(const Table& table);

void bind_state(py::module_& module);
void bind_packings(py::module_& module);
void bind_analysis(py::module_& module);
void bind_fits(py::module_& module);
void bind_run(py::module_& module);

}  // namespace floc::python
