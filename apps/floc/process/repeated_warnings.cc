#include "process/repeated_warnings.h"

#include <fmt/format.h>

#include <iostream>
#include <utility>

namespace floc {
namespace {

bool is_part_of_number(char c) {
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+';
}

std::string without_numbers(const std::string& text) {
  std::string kind;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool exponent = text[k] == 'e' && k > 0 && k + 1 < text.size() && is_part_of_number(text[k - 1]) &&
                          is_part_of_number(text[k + 1]);
    if (!is_part_of_number(text[k]) && !exponent) kind += text[k];
  }
  return kind;
}

}  // namespace

RepeatedWarnings::~RepeatedWarnings() {
  for (const Warning& w : kept_)
    std::cerr << fmt::format(
        "floc: {}: {}{}\n", w.file, w.text,
        w.n_states == 1
            ? ""
            : fmt::format(" ({} states have this warning; this one is for the worst state)", w.n_states));
}

Remarks RepeatedWarnings::remarks() {
  return Remarks([this](const std::string& file, const std::string& text, double severity) {
    keep(file, text, severity);
  });
}

void RepeatedWarnings::keep(const std::string& file, const std::string& text, double severity) {
  Warning now{without_numbers(text), file, text, severity, 1};
  for (Warning& kept : kept_) {
    if (kept.kind != now.kind) continue;
    now.n_states = kept.n_states + (kept.file == file ? 0 : 1);
    if (severity > kept.severity) kept = now;
    kept.n_states = now.n_states;
    return;
  }
  kept_.push_back(std::move(now));
}

Remarks printed_remarks() {
  return Remarks([](const std::string& file, const std::string& text, double) {
    std::cerr << fmt::format("floc: {}: {}\n", file, text);
  });
}

}  // namespace floc
