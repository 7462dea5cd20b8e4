#include <exception>
#include <regex>
#include <utility>

#include "binding.h"
#include "floc/base/version.h"
#include "floc/tables/column_reference.h"

namespace floc::python {
namespace {

/// Returns the exception class called `name` in floc/_errors.py. Exceptions of the library are translated to the
/// classes in this file.
py::object error_class(const char* name) {
  return py::module_::import("floc._errors").attr(name);
}

void raise_in_python(const char* name, const std::exception& error) {
  PyErr_SetString(error_class(name).ptr(), in_words_of_python(error.what()).c_str());
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const InputError& error) {
    raise_in_python("InputError", error);
  } catch (const IoError& error) {
    raise_in_python("FileError", error);
  } catch (const EquilibriumError& error) {
    raise_in_python("EquilibriumError", error);
  } catch (const NumericalError& error) {
    raise_in_python("NumericalError", error);
  }
}

/// Returns a dict of all tables of the program. Each table is a list of its columns as (name, unit, meaning).
py::dict column_reference() {
  py::dict tables;
  for (const DescribedTable& table : described_tables()) {
    py::list columns;
    for (const DescribedColumn& column : table.columns)
      columns.append(py::make_tuple(column.name, column.unit, column.meaning));
    tables[py::str(table.name)] = columns;
  }
  return tables;
}

}  // namespace

std::string in_words_of_python(const std::string& message) {
  static const std::regex option("(^|[\\s\"'(])--([A-Za-z][A-Za-z0-9]*(?:-[a-z0-9]+)*)");
  static const std::regex command("(?:floc(?: [a-z.]+)+|[a-z]+ \\.)$");
  static const std::regex columns("\\b([a-z_]+)1\\.\\.");
  std::string words;
  auto from = message.cbegin();
  for (std::smatch found; std::regex_search(from, message.cend(), found, option); from = found[0].second) {
    words.append(from, found[1].second);
    // An option after the name of a command is one that the user types.
    if (std::regex_search(message.cbegin(), found[1].first, command))
      words += "--" + found.str(2);
    else
      words += std::regex_replace(found.str(2), std::regex("-"), "_");
  }
  words.append(from, message.cend());
  return std::regex_replace(words, columns, "$1");
}

void check_signals() {
  const py::gil_scoped_acquire acquired;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void issue(const Warnings& warnings) {
  const py::object kind = error_class("FlocWarning");
  for (const std::string& words : warnings)
    if (PyErr_WarnEx(kind.ptr(), in_words_of_python(words).c_str(), 2) != 0) throw py::error_already_set();
}

}  // namespace floc::python

PYBIND11_MODULE(_core, module) {
  namespace fp = floc::python;
  module.doc() = "Compiled part of floc: use the package floc.";
  fp::prepare_shared_blas();
  pybind11::register_local_exception_translator(fp::translate);
  module.attr("version") = floc::version();
  module.attr("commit") = floc::commit();
  module.def("column_reference", fp::column_reference);
  fp::bind_state(module);
  fp::bind_packings(module);
  fp::bind_analysis(module);
  fp::bind_fits(module);
  fp::bind_run(module);
  fp::bind_plan(module);
}
