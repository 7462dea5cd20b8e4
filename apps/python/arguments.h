#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "binding.h"
#include "floc/base/range.h"

/// Converts arguments from Python to numbers of C++ and checks that they are within the ranges of the library. If an
/// argument is not valid, the function throws an InputError with the name of the argument, its value and the
/// expectation.
namespace floc::python {

double number_of(const char* name, const py::handle& given, const NumberRange& range = kFiniteNumber);
/// Converts a number or None; absent for None.
std::optional<double> number_if_any(const char* name, const py::handle& given,
                                    const NumberRange& range = kFiniteNumber);
/// Converts a sequence of numbers.
std::vector<double> numbers_of(const char* name, const py::handle& given,
                               const NumberRange& range = kFiniteNumber);

int whole_of(const char* name, const py::handle& given, const WholeRange& range);
std::optional<int> whole_if_any(const char* name, const py::handle& given, const WholeRange& range);
std::vector<int> wholes_of(const char* name, const py::handle& given, const WholeRange& range);

/// Converts a seed of random numbers, a whole number from 0 to 2^64 - 1.
std::uint64_t seed_of(const char* name, const py::handle& given);

/// Converts a string.
/// @param expected  requirement for the argument, as words of the message
std::string text_of(const char* name, const py::handle& given, const std::string& expected = "a text");
/// Converts a string, or a sequence of strings.
std::vector<std::string> texts_of(const char* name, const py::handle& given);

/// Converts an object that Python takes for a truth value: True, False or a number, but no text, sequence or array.
bool flag_of(const char* name, const py::handle& given);

/// Converts a string that must be one of `words`.
std::string word_of(const char* name, const py::handle& given, std::initializer_list<const char*> words);

}  // namespace floc::python
