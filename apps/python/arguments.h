#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "binding.h"
#include "floc/base/range.h"

/// Arguments of Python as numbers of C++, in the ranges that the library has for them. Each of these functions throws
/// InputError with the name of the argument, its value and what was expected.
namespace floc::python {

double number_of(const char* name, const py::handle& given, const NumberRange& range = kFiniteNumber);
/// None: nothing
std::optional<double> number_if_any(const char* name, const py::handle& given,
                                    const NumberRange& range = kFiniteNumber);
/// A sequence of them.
std::vector<double> numbers_of(const char* name, const py::handle& given,
                               const NumberRange& range = kFiniteNumber);

int whole_of(const char* name, const py::handle& given, const WholeRange& range);
std::optional<int> whole_if_any(const char* name, const py::handle& given, const WholeRange& range);
std::vector<int> wholes_of(const char* name, const py::handle& given, const WholeRange& range);

/// A seed of random numbers, 0 to 2^64 - 1.
std::uint64_t seed_of(const char* name, const py::handle& given);

/// One of some words.
std::string word_of(const char* name, const py::handle& given, std::initializer_list<const char*> words);

}  // namespace floc::python
