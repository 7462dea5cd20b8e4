#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "floc/base/range.h"
#include "floc/base/vec.h"

namespace floc {

/// Lines of a text and their words, with messages that name file and line. Comments from # on and lines without
/// words are skipped.
class TextLines {
 public:
  /// @param place  name of the file  @param text  has to outlive this
  /// @param separators  characters between words, besides white space
  TextLines(std::string place, std::string_view text, std::string_view separators = "");

  /// Goes to the next line with words. @return whether there is one
  bool next();
  /// Goes to the next line. @param what  expected there, for the message. @throws InputError at the end of the
  /// text
  void require_next(const std::string& what);

  const std::vector<std::string_view>& words() const { return words_; }
  std::string_view word(std::size_t k) const { return words_[k]; }
  std::size_t n_words() const { return words_.size(); }
  /// "file:line"
  std::string where() const;

  /// @throws InputError if word k is missing or is no such number
  double number(std::size_t k) const;
  int whole(std::size_t k, const WholeRange& range) const;
  /// Vector of the words from k on.
  template <int Dim>
  Vec<Dim> vector(std::size_t k) const {
    Vec<Dim> v;
    for (int a = 0; a < Dim; ++a) v[a] = number(k + static_cast<std::size_t>(a));
    return v;
  }

  /// @throws InputError always, at the present line
  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  std::string place_;
  std::string_view rest_;
  std::string separators_;
  std::vector<std::string_view> words_;
  int line_ = 0;
};

}  // namespace floc
