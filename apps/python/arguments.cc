#include "arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace floc::python {
namespace {

[[noreturn]] void refuse(const char* name, const py::handle& given, const std::string& expected) {
  throw InputError("",
                   fmt::format("{} = {}: expected {}", name, py::repr(given).cast<std::string>(), expected));
}

/// Converts an object that Python accepts as an index to a Python int; returns null for other objects.
py::object index_of(const py::handle& given) {
  auto index = py::reinterpret_steal<py::object>(PyNumber_Index(given.ptr()));
  if (!index) PyErr_Clear();
  return index;
}

/// Whether an object is a complex number of Python or a number or array of a complex type of numpy. Python converts
/// such a number of numpy to a real one and drops its imaginary part.
bool is_complex(const py::handle& given) {
  if (PyComplex_Check(given.ptr())) return true;
  const py::object type = py::getattr(given, "dtype", py::none());
  return py::isinstance<py::str>(py::getattr(type, "kind", py::none())) &&
         type.attr("kind").cast<std::string>() == "c";
}

/// Returns the values of a Python sequence, each converted by `read`.
/// @param name  name of the argument, for messages
template <class Value, class Read>
std::vector<Value> each_of(const char* name, const py::handle& given, const Read& read) {
  if (!py::isinstance<py::iterable>(given) || py::isinstance<py::str>(given))
    refuse(name, given, "a sequence of numbers");
  std::vector<Value> values;
  for (const py::handle& one : py::iter(given)) values.push_back(read(one));
  return values;
}

}  // namespace

double number_of(const char* name, const py::handle& given, const NumberRange& range) {
  if (is_complex(given)) refuse(name, given, range.words());
  const double value = PyFloat_AsDouble(given.ptr());
  const bool failed = value == -1.0 && PyErr_Occurred() != nullptr;
  if (failed) PyErr_Clear();
  if (failed || !range.holds(value)) refuse(name, given, range.words());
  return value;
}

std::optional<double> number_if_any(const char* name, const py::handle& given, const NumberRange& range) {
  if (given.is_none()) return std::nullopt;
  return number_of(name, given, range);
}

std::vector<double> numbers_of(const char* name, const py::handle& given, const NumberRange& range) {
  return each_of<double>(name, given, [&](const py::handle& one) { return number_of(name, one, range); });
}

int whole_of(const char* name, const py::handle& given, const WholeRange& range) {
  const py::object index = index_of(given);
  int overflow = 0;
  const long long value = index ? PyLong_AsLongLongAndOverflow(index.ptr(), &overflow) : 0;
  const WholeRange held{std::max<std::int64_t>(range.least, std::numeric_limits<int>::min()),
                        std::min<std::int64_t>(range.most, std::numeric_limits<int>::max())};
  if (!index || overflow != 0 || !held.holds(value)) refuse(name, given, held.words());
  return static_cast<int>(value);
}

std::optional<int> whole_if_any(const char* name, const py::handle& given, const WholeRange& range) {
  if (given.is_none()) return std::nullopt;
  return whole_of(name, given, range);
}

std::vector<int> wholes_of(const char* name, const py::handle& given, const WholeRange& range) {
  return each_of<int>(name, given, [&](const py::handle& one) { return whole_of(name, one, range); });
}

std::uint64_t seed_of(const char* name, const py::handle& given) {
  const py::object index = index_of(given);
  const unsigned long long value = index ? PyLong_AsUnsignedLongLong(index.ptr()) : 0;
  const bool failed = !index || PyErr_Occurred() != nullptr;
  if (failed) PyErr_Clear();
  if (failed)
    refuse(name, given, fmt::format("a whole number from 0 to {}", std::numeric_limits<std::uint64_t>::max()));
  return value;
}

std::string text_of(const char* name, const py::handle& given, const std::string& expected) {
  if (!py::isinstance<py::str>(given)) refuse(name, given, expected);
  return given.cast<std::string>();
}

std::vector<std::string> texts_of(const char* name, const py::handle& given) {
  if (py::isinstance<py::str>(given)) return {given.cast<std::string>()};
  if (!py::isinstance<py::iterable>(given)) refuse(name, given, "a text or a sequence of texts");
  std::vector<std::string> texts;
  for (const py::handle& one : py::iter(given)) texts.push_back(text_of(name, one));
  return texts;
}

bool flag_of(const char* name, const py::handle& given) {
  const bool is_number = PyBool_Check(given.ptr()) || PyNumber_Check(given.ptr());
  if (!is_number || py::isinstance<py::iterable>(given)) refuse(name, given, "True or False");
  return PyObject_IsTrue(given.ptr()) == 1;
}

std::string word_of(const char* name, const py::handle& given, std::initializer_list<const char*> words) {
  const std::string word = text_of(name, given, fmt::format("one of {}", fmt::join(words, ", ")));
  require_one_of(name, word, words);
  return word;
}

}  // namespace floc::python
