#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "floc/base/range.h"
#include "floc/base/vec.h"

namespace floc {

/// Reader that goes through a text line by line and divides each line into words. Error messages name the file and the
/// line. Comments (from # to the end of the line) and lines without words are skipped.
class TextLines {
 public:
  /// @param place  name of the file, for messages
  /// @param text  text to be read; it must outlive this object
  /// @param separators  characters that separate words, in addition to white space
  TextLines(std::string place, std::string_view text, std::string_view separators = "");

  /// Goes to the next line that has words.
  /// @return whether there is such a line
  bool next();
  /// Goes to the next line that has words.
  /// @param what  description of the expected line, for the message
  /// @throws InputError at the end of the text
  void require_next(const std::string& what);

  const std::vector<std::string_view>& words() const { return words_; }
  std::string_view word(std::size_t k) const { return words_[k]; }
  std::size_t n_words() const { return words_.size(); }
  /// Returns the name of the file and the number of the present line as "file:line".
  std::string where() const;

  /// Returns word k of the present line, counted from 0, as a number.
  /// @throws InputError if the word is missing or is not a number
  double number(std::size_t k) const;
  /// Returns word k of the present line, counted from 0, as a whole number in a range.
  /// @throws InputError if the word is missing, is not a whole number or is out of range
  int whole(std::size_t k, const WholeRange& range) const;
  /// Returns a vector of numbers: the words k to k + Dim - 1 of the present line, counted from 0.
  template <int Dim>
  Vec<Dim> vector(std::size_t k) const {
    Vec<Dim> v;
    for (int a = 0; a < Dim; ++a) v[a] = number(k + static_cast<std::size_t>(a));
    return v;
  }

  /// Reports a problem in the present line.
  /// @throws InputError always
  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  std::string place_;
  std::string_view rest_;
  std::string separators_;
  std::vector<std::string_view> words_;
  int line_ = 0;
};

}  // namespace floc
