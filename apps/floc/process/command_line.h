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

/// An option, flag or positional argument of a command. What is said of it chains:
/// `line.add_option(...).required().positive()`. Handles may be copied; the command line owns the option.
class Option {
 public:
  Option required();
  /// As many values as `count`, or `least` to `most` (-1: no limit).
  Option expected(int count);
  Option expected(int least, int most);
  /// Values may also come as one argument, between these.
  Option delimiter(char between);
  /// Several mentions of the option are one value, joined by this.
  Option joined(char between);
  /// Each mention of the option takes one argument, and what follows is positional again.
  Option one_argument_each();
  /// The help shows the value that the variable has now.
  Option show_default();

  /// Ranges are those of the library, which refuses the same values.
  Option within(const NumberRange& range);
  Option within(const WholeRange& range);
  Option positive() { return within(kPositiveNumber); }
  Option non_negative() { return within(kNotNegativeNumber); }
  Option one_of(const std::vector<std::string>& keywords);
  Option one_of_integers(const std::vector<int>& numbers);

  Option excludes(Option other);
  Option excludes(const std::string& name);
  Option needs(Option other);

  /// How often it was given.
  std::size_t count() const;

 private:
  friend class CommandLine;
  explicit Option(CLI::Option* option) : option_(option) {}
  CLI::Option* option_;
};

/// The command line of the program or of one of its commands. Handles may be copied; ProgramLine owns what they
/// name.
///
/// This class and Option hide CLI11 from the commands, whose headers and option templates cost each file
/// that includes them about as much as all else in it: command_line.cc alone does.
class CommandLine {
 public:
  CommandLine add_subcommand(const std::string& name, const std::string& description);
  /// One of the subcommands must be given, and no more than one.
  void require_one_subcommand();
  /// Was this subcommand the one given?
  bool parsed() const;
  /// Names from that of the top command's subcommand on: "fit elastic".
  std::string full_name() const;
  /// Calls `work` if this command was given, once the whole line is read and without fault.
  void after_parsing(const std::function<void()>& work);
  bool has_option(const std::string& name) const;
  /// Text below the help.
  void footer(const std::string& text);

  /// Adds an option ("-o,--output") or a positional argument ("STATE"), read into `value` when the line is
  /// parsed. Numbers are decimal and finite, whole numbers fit the type of the variable.
  /// Defined for the types that command_line.cc lists; a new type takes a line there.
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

  CommandLine top();

  /// Reads the arguments into the variables of the options.
  /// @return nothing if a command is to be run; otherwise help, version or a fault was printed and the program
  ///   is to end: with an exit code of 0, or of kUsage for a fault
  std::optional<int> parse(int argc, char** argv);

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace floc
