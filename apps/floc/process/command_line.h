#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "floc/base/range.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace floc {

/// An option, flag or positional argument of a command. Its functions can be chained:
/// `line.add_option(...).required().positive()`. Handles may be copied; the command line owns the option.
class Option {
 public:
  Option required();
  /// Makes the option take `count` values, or `least` to `most` values (-1: no limit).
  Option expected(int count);
  Option expected(int least, int most);
  /// Makes the option also accept one argument that contains several values, separated by the character `between`.
  Option delimiter(char between);
  /// If the option is given several times, joins its values to one text, separated by the character `between`.
  Option joined(char between);
  /// Makes the option take only one argument each time it is given; the arguments after it are positional.
  Option one_argument_each();
  /// Shows the present value of the variable of this option in the help, as the default.
  Option show_default();

  /// Makes the option accept only numbers within a range. The library defines this range and also rejects numbers
  /// outside of it.
  Option within(const NumberRange& range);
  Option within(const WholeRange& range);
  Option positive() { return within(kPositiveNumber); }
  Option non_negative() { return within(kNotNegativeNumber); }
  Option one_of(const std::vector<std::string>& keywords);
  Option one_of_integers(const std::vector<int>& numbers);

  Option excludes(Option other);
  Option excludes(const std::string& name);
  Option needs(Option other);

  /// Returns how many times the option was given.
  std::size_t count() const;

 private:
  friend class CommandLine;
  explicit Option(CLI::Option* option) : option_(option) {}
  CLI::Option* option_;
};

/// The command line of the program or of one of its commands. An object of this class is a handle to a parser that
/// ProgramLine owns, and may be copied.
///
/// This class and Option hide CLI11, whose headers and templates would about double the time to compile each command.
/// Only command_line.cc includes it.
class CommandLine {
 public:
  CommandLine add_subcommand(const std::string& name, const std::string& description);
  /// Requires exactly one of the subcommands.
  void require_one_subcommand();
  /// Returns whether this subcommand was given.
  bool parsed() const;
  /// Returns the names of the parent commands and of this command, without the name of the program, such as "fit
  /// elastic".
  std::string full_name() const;
  /// Sets a function that is called if this command was given, after the whole command line has been parsed without an
  /// error.
  void after_parsing(const std::function<void()>& work);
  bool has_option(const std::string& name) const;
  /// Sets the text that the help prints below the list of options.
  void footer(const std::string& text);

  /// Adds an option ("-o,--output") or a positional argument ("STATE"). Its value is read into `value` when the command
  /// line is parsed. Numbers have to be decimal and finite, and whole numbers have to fit the type of the variable. The
  /// template is instantiated in command_line.cc for each type of variable; a new type needs a new line in that file.
  template <class T>
  Option add_option(const std::string& name, T& value, const std::string& text);
  Option add_flag(const std::string& name, bool& value, const std::string& text);

 private:
  friend class ProgramLine;
  explicit CommandLine(CLI::App* app) : app_(app) {}
  CLI::App* app_;
};

/// The command line of the whole program, with --help and --version.
class ProgramLine {
 public:
  ProgramLine(const std::string& name, const std::string& description, const std::string& version);
  ~ProgramLine();
  ProgramLine(const ProgramLine&) = delete;
  ProgramLine& operator=(const ProgramLine&) = delete;

  /// Returns the command line of the program itself.
  CommandLine top();

  /// Reads the arguments into the variables of the options.
  /// @return nothing if a command is to be run. Otherwise the help, the version or an error message was printed, and
  /// the program has to end with the exit code returned: 0, or kUsage after an error
  std::optional<int> parse(int argc, char** argv);

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace floc
