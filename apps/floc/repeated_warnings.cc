#include "repeated_warnings.h"

#include <fmt/format.h>

#include <cstdlib>
#include <iostream>
#include <utility>
#include <vector>

namespace floc {
namespace {

struct Warning {
  std::string kind;  ///< its text without numbers
  std::string file, text;
  double severity = 0.0;
  int n_states = 1;
};

std::vector<Warning> g_kept;
int g_scopes = 0;
thread_local RemarkListener::Told g_told;

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

void print(const Warning& w) {
  std::cerr << fmt::format(
      "floc: {}: {}{}\n", w.file, w.text,
      w.n_states == 1 ? "" : fmt::format(" ({} states have this warning; this is the worst)", w.n_states));
}

}  // namespace

RepeatedWarnings::RepeatedWarnings() {
  ++g_scopes;
}

RepeatedWarnings::~RepeatedWarnings() {
  if (--g_scopes > 0) return;
  for (const Warning& w : g_kept) print(w);
  g_kept.clear();
}

RemarkListener::RemarkListener(Told told) : before_(std::move(g_told)) {
  g_told = std::move(told);
}

RemarkListener::~RemarkListener() {
  g_told = std::move(before_);
}

void remark(const std::string& file, const std::string& text, double severity) {
  if (g_told) return g_told(file, text);
  Warning now{without_numbers(text), file, text, severity, 1};
  if (g_scopes == 0) return print(now);
  for (Warning& kept : g_kept) {
    if (kept.kind != now.kind) continue;
    now.n_states = kept.n_states + (kept.file == file ? 0 : 1);
    if (severity > kept.severity) kept = now;
    kept.n_states = now.n_states;
    return;
  }
  g_kept.push_back(std::move(now));
}

void warn(const std::string& file, const std::string& text, double severity) {
  remark(file, "warning: " + text, severity);
}

double first_number(const std::string& text) {
  const std::size_t at = text.find_first_of("0123456789");
  return at == std::string::npos ? 0.0 : std::strtod(text.c_str() + at, nullptr);
}

}  // namespace floc
