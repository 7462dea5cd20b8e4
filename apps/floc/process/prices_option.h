#pragma once

#include <string>

#include "process/command_line.h"

namespace floc {

/// Adds the option --prices to a command that reads a scene.
inline void add_prices_option(CommandLine app, std::string& file) {
  app.add_option(
      "--prices", file,
      "table of the errors and costs of numerical settings, written by floc tradeoff --format csv for "
      "scenes of this kind [the table shipped with floc]");
}

}  // namespace floc
