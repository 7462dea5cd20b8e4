#pragma once

#include <functional>
#include <string>

namespace floc {

/// While one of these lives, a warning that comes for many states is kept, to be printed once at its end: that of
/// the worst state, with the number of states.
class RepeatedWarnings {
 public:
  RepeatedWarnings();
  ~RepeatedWarnings();
  RepeatedWarnings(const RepeatedWarnings&) = delete;
  RepeatedWarnings& operator=(const RepeatedWarnings&) = delete;
};

/// While one of these lives, it is told what this thread has to say of files, in place of stderr.
class RemarkListener {
 public:
  using Told = std::function<void(const std::string& file, const std::string& text)>;
  explicit RemarkListener(Told told);
  ~RemarkListener();
  RemarkListener(const RemarkListener&) = delete;
  RemarkListener& operator=(const RemarkListener&) = delete;

 private:
  Told before_;
};

/// Says something of a file on stderr: "floc: FILE: TEXT". Texts that differ in their numbers alone are one.
/// @param severity  the largest is the worst; of equal ones the first
void remark(const std::string& file, const std::string& text, double severity = 0.0);

/// The same of a warning: "floc: FILE: warning: TEXT".
void warn(const std::string& file, const std::string& text, double severity = 0.0);

/// The first number in a text, a severity where its count or error is what counts; 0 without one.
double first_number(const std::string& text);

}  // namespace floc
