#include "process/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdint>
#include <iostream>
#include <iterator>
#include <limits>
#include <type_traits>

#include "floc/base/nearest_name.h"
#include "floc/base/parse_number.h"
#include "process/command.h"
#include "process/output_files.h"

namespace floc {
namespace {

/// Returns the names "--name" and "-n" of the options of a command.
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

/// Returns a message about the first argument that is neither an option nor a subcommand of `app`; the message names
/// the most similar option or command. If there is no such argument, the arguments of the given subcommand are searched
/// in the same way. If all arguments are known, returns an empty text.
/// @param called  name by which the user called `app`, such as "floc fit"
std::string unknown_name(const CLI::App& app, const std::string& called) {
  const std::vector<CLI::App*> given = app.get_subcommands();
  for (const std::string& argument : app.remaining()) {
    const std::string name = argument.substr(0, argument.find('='));
    if (name.starts_with('-') && name.size() > 1)
      return called + " has no option " + name + "; the nearest is " + nearest_name(name, option_names(app));
    // The unknown name is reported even if a valid command follows, as in "floc modli demo".
    if (const std::vector<std::string> commands = command_names(app); !commands.empty())
      return called + " has no command " + name + "; the nearest is " + nearest_name(name, commands) + " (" +
             called + " --help lists all commands)";
  }
  return given.empty() ? "" : unknown_name(*given.back(), called + " " + given.back()->get_name());
}

/// Type of one value of an option. If the variable of the option is a std::optional or a std::vector, this is the type
/// of its elements.
template <class T>
struct ValueOf {
  using Type = T;
};
template <class T>
struct ValueOf<std::optional<T>> : ValueOf<T> {};
template <class T>
struct ValueOf<std::vector<T>> : ValueOf<T> {};

/// Checks the text that a user gave for a number, and rewrites a whole number in plain decimal digits. Without this
/// check, CLI11 would read "nan" and "inf" as numbers, 0x10 as 16, 010 as 8, and -1 as the largest seed.
/// @return error message; empty if the number is valid
template <class Number>
std::string read_number(std::string& given) {
  const auto value = parse_number<Number>(given);
  if constexpr (std::is_floating_point_v<Number>) {
    return value ? std::string() : fmt::format("expected a finite number, not {}", given);
  } else {
    using Limits = std::numeric_limits<Number>;
    if (!value) {
      const std::string_view digits = std::string_view(given).substr(given.starts_with('-') ? 1 : 0);
      const bool is_whole =
          !digits.empty() && std::ranges::all_of(digits, [](char c) { return '0' <= c && c <= '9'; });
      return is_whole ? fmt::format("expected a whole number from {} to {}, not {}", Limits::min(),
                                    Limits::max(), given)
                      : fmt::format("expected a whole number, not {}", given);
    }
    given = std::to_string(*value);
    return {};
  }
}

/// Returns a validator that accepts the numbers within a range. The validator of CLI11 is not used, because its
/// messages print the largest double with three hundred digits.
/// @param name  text that stands for the value of the option in the help
template <class Number, class Range>
CLI::Validator number_within(const std::string& name, const Range& range) {
  return {[range](const std::string& given) {
            const auto value = parse_number<Number>(given);
            return value && range.holds(*value) ? std::string()
                                                : fmt::format("expected {}, not {}", range.words(), given);
          },
          name};
}

/// Returns the type and the limits of a range as text for the help: "INT in [1 - 64]".
template <class Range>
std::string limits_of(const char* type, const Range& range) {
  return fmt::format("{} in [{} - {}]", type, range.least, range.most);
}

/// Options whose value is the name of a file that the command reads.
constexpr std::array kInputOptions = {"compare", "prices", "scene", "state", "bonds"};

/// Returns the values of the positional arguments and of kInputOptions that were given to `app` and to its subcommand.
std::vector<std::string> named_inputs(const CLI::App& app) {
  std::vector<std::string> values;
  for (const CLI::Option* option : app.get_options()) {
    const bool names_input =
        option->get_positional() ||
        std::ranges::any_of(kInputOptions, [&](const char* name) { return option->check_lname(name); });
    if (names_input) std::ranges::copy(option->results(), std::back_inserter(values));
  }
  for (const CLI::App* command : app.get_subcommands())
    std::ranges::copy(named_inputs(*command), std::back_inserter(values));
  return values;
}

}  // namespace

Option Option::required() {
  option_->required();
  return *this;
}

Option Option::expected(int count) {
  option_->expected(count)->allow_extra_args(false);
  return *this;
}

Option Option::expected(int least, int most) {
  option_->expected(least, most);
  return *this;
}

Option Option::delimiter(char between) {
  option_->delimiter(between);
  return *this;
}

Option Option::joined(char between) {
  option_->join(between);
  return *this;
}

Option Option::one_argument_each() {
  option_->allow_extra_args(false);
  return *this;
}

Option Option::show_default() {
  option_->capture_default_str();
  return *this;
}

Option Option::within(const NumberRange& range) {
  const bool bounded = range.most < std::numeric_limits<double>::max();
  option_->check(number_within<double>(bounded               ? limits_of("FLOAT", range)
                                       : range.without_least ? "POSITIVE"
                                                             : "NONNEGATIVE",
                                       range));
  return *this;
}

Option Option::within(const WholeRange& range) {
  option_->check(number_within<std::int64_t>(limits_of("INT", range), range));
  return *this;
}

Option Option::one_of(const std::vector<std::string>& keywords) {
  option_->check(CLI::IsMember(keywords));
  return *this;
}

Option Option::one_of_integers(const std::vector<int>& numbers) {
  option_->check(CLI::IsMember(numbers));
  return *this;
}

Option Option::excludes(Option other) {
  option_->excludes(other.option_);
  return *this;
}

Option Option::excludes(const std::string& name) {
  option_->excludes(name);
  return *this;
}

Option Option::needs(Option other) {
  option_->needs(other.option_);
  return *this;
}

std::size_t Option::count() const {
  return option_->count();
}

CommandLine CommandLine::add_subcommand(const std::string& name, const std::string& description) {
  return CommandLine(app_->add_subcommand(name, description));
}

void CommandLine::require_one_subcommand() {
  app_->require_subcommand(1);
}

bool CommandLine::parsed() const {
  return app_->parsed();
}

std::string CommandLine::full_name() const {
  std::string name = app_->get_name();
  for (const CLI::App* app = app_->get_parent(); app != nullptr && app->get_parent() != nullptr;
       app = app->get_parent())
    name = app->get_name() + " " + name;
  return name;
}

void CommandLine::after_parsing(const std::function<void()>& work) {
  app_->callback(work);
}

bool CommandLine::has_option(const std::string& name) const {
  return app_->get_option_no_throw(name) != nullptr;
}

void CommandLine::footer(const std::string& text) {
  app_->footer(text);
}

template <class T>
Option CommandLine::add_option(const std::string& name, T& value, const std::string& text) {
  CLI::Option* option = app_->add_option(name, value, text);
  if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, std::vector<std::string>>)
    option->check(CLI::Validator(
        [](const std::string& given) {
          return given.empty() ? std::string("the value is empty; give a value") : std::string();
        },
        ""));
  else
    option->transform(CLI::Validator(read_number<typename ValueOf<T>::Type>, ""));
  return Option(option);
}

template Option CommandLine::add_option(const std::string&, std::string&, const std::string&);
template Option CommandLine::add_option(const std::string&, double&, const std::string&);
template Option CommandLine::add_option(const std::string&, int&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::uint64_t&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::optional<double>&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::optional<int>&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::optional<std::uint64_t>&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::vector<double>&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::vector<int>&, const std::string&);

Option CommandLine::add_flag(const std::string& name, bool& value, const std::string& text) {
  return Option(app_->add_flag(name, value, text));
}

ProgramLine::ProgramLine(const std::string& name, const std::string& description, const std::string& version)
    : app_(std::make_unique<CLI::App>(description, name)) {
  app_->set_version_flag("--version", version);
}

ProgramLine::~ProgramLine() = default;

CommandLine ProgramLine::top() {
  return CommandLine(app_.get());
}

std::optional<int> ProgramLine::parse(int argc, char** argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // CLI11 prints the help for "floc modli --help" without an error, although there is no command modli.
    const bool fault = error.get_exit_code() != 0 || app_->get_subcommands().empty();
    if (const std::string unknown = unknown_name(*app_, app_->get_name()); fault && !unknown.empty()) {
      std::cerr << "floc: " << unknown << "\nRun with --help for more information.\n";
      return kUsage;
    }
    return app_->exit(error) == 0 ? kDone : kUsage;
  }
  remember_inputs(named_inputs(*app_));
  return std::nullopt;
}

}  // namespace floc
