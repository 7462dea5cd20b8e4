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

/// Functions shared by the sources of the Python module. The module calls the functions of the library that the
/// commands call, and returns tables; floc/*.py makes objects of them.
namespace floc::python {

namespace py = pybind11;

/// A state held by Python, which never changes, and its name in messages.
struct NamedState {
  std::shared_ptr<const AnyState> state;
  std::string name;
};

/// Failure of a computation, with the reason in words.
class NumericalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Failure because a state is not in equilibrium although it has to be.
class EquilibriumError : public NumericalError {
 public:
  using NumericalError::NumericalError;
};

/// Messages that become warnings of Python as soon as the GIL is held again.
using Warnings = std::vector<std::string>;
void issue(const Warnings& warnings);

/// Throws the exception of a pending signal: KeyboardInterrupt after Ctrl-C. Python delivers signals to its main
/// thread only.
void check_signals();

/// Runs long work while other threads of Python continue. If the work takes Remarks, they become warnings. Ctrl-C
/// ends the work at the next place where the library checks for an interruption.
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

/// Runs work on one state; error messages name the state, as those of commands do.
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

/// Checks a word. @throws InputError unless `value` is one of the words
void require_one_of(const std::string& name, const std::string& value,
                    std::initializer_list<const char*> words);

/// Checks names of tables. @throws InputError naming the entries of `tables` that are not among `known`
void require_tables(const std::vector<std::string>& tables, std::initializer_list<const char*> known);
bool contains(const std::vector<std::string>& tables, const char* name);

/// Converts a value; one that is undefined, or not a finite number, becomes None.
py::object to_python(const TableValue& value);
py::object to_python(const Json& json);
/// Converts a table to a tuple of its columns and rows.
py::tuple to_python(const Table& table);
/// Converts a table to one array per column; undefined numbers become NaN.
py::dict columns_to_python(const Table& table);

void bind_state(py::module_& module);
void bind_packings(py::module_& module);
void bind_analysis(py::module_& module);
void bind_fits(py::module_& module);
void bind_run(py::module_& module);

}  // namespace floc::python
