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

/// Functions for all sources of the compiled Python module. This module calls the same functions of the library as the
/// floc commands and returns tables. The files floc/*.py convert these tables to Python objects.
namespace floc::python {

namespace py = pybind11;

/// A state that belongs to a Python object, and the name of this state in messages. The state never changes.
struct NamedState {
  std::shared_ptr<const AnyState> state;
  std::string name;
};

/// Error of a computation that has no result; the message gives the reason.
class NumericalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Error of a computation that requires an equilibrium: the state is not in equilibrium.
class EquilibriumError : public NumericalError {
 public:
  using NumericalError::NumericalError;
};

/// Returns a message of the library in words of Python: arguments instead of options of the commands (`touch_gap` for
/// `--touch-gap`) and arrays instead of columns (`image` for `image1..`). Options of commands that the message quotes
/// (`floc run --resume`) remain.
std::string in_words_of_python(const std::string& message);

/// Messages that are issued as Python warnings as soon as the global interpreter lock (GIL) is held again.
using Warnings = std::vector<std::string>;
void issue(const Warnings& warnings);

/// Throws the Python exception for a pending signal, if there is one, such as KeyboardInterrupt for Ctrl-C. Python
/// delivers signals only to its main thread.
void check_signals();

/// Runs a long computation without the global interpreter lock (GIL), so that other Python threads continue. If `work`
/// takes a Remarks, its remarks become Python warnings. Ctrl-C ends `work` at the next place where the library checks
/// for an interruption.
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

/// Runs a computation on one state. The name of the state is added to error messages, as in the floc commands.
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

/// Checks the keyword `value` of the argument `name`. @throws InputError unless `value` is one of `words`
void require_one_of(const std::string& name, const std::string& value,
                    std::initializer_list<const char*> words);

/// Checks names of tables. @throws InputError if some of `tables` are not in `known`; the message lists them
void require_tables(const std::vector<std::string>& tables, std::initializer_list<const char*> known);
bool contains(const std::vector<std::string>& tables, const char* name);

/// Converts a value to Python; an undefined value or a number that is not finite becomes None.
py::object to_python(const TableValue& value);
py::object to_python(const Json& json);
/// Converts a table to a tuple (names of the columns, rows).
py::tuple to_python(const Table& table);
/// Converts a table to a dict with one array for each column; undefined numbers become NaN.
py::dict columns_to_python(const Table& table);

void bind_state(py::module_& module);
void bind_packings(py::module_& module);
void bind_analysis(py::module_& module);
void bind_fits(py::module_& module);
void bind_run(py::module_& module);
void bind_plan(py::module_& module);

}  // namespace floc::python
