#pragma once

/// @file
/// The public interface of floc in one header.

/// @mainpage
/// Include `floc/floc.h` and link `floc::floc`; the page "Installation" of the documentation has the CMake lines. Everything
/// lies in namespace floc. Units are those of the files: reduced units or SI, as State::units says.
///
/// A program makes its calls in this order. Each is documented where it is declared, with its pre- and postconditions,
/// units and errors.
///
/// 1. Have a state. floc::read_state() reads a state file, the format that floc::find_import_format() finds reads a file of
///    another program, whose packing floc::complete_import() completes. floc::run_scene() makes states: it runs a scene in a directory, where
///    floc::state_file() names them.
/// 2. Verify it. floc::verify_state() recomputes from the state alone whether it is an equilibrium.
/// 3. Compute what its contact network is worth, a table each, with the columns of docs/columns.md:
///    floc::moduli_table(), floc::network_table(), floc::structure_table(). For many states, floc::ModuliRows goes on
///    from one solution to the next. floc::elastic_moduli() has the moduli themselves, the stiffness matrix and the
///    response.
/// 4. Fit the consolidation law to paths: floc::consolidation_fit() for tables and directories of runs,
///    floc::fit_consolidation() for points in memory.
/// 5. Write results: floc::write_table() tables, floc::write_state() states.
///
/// Errors are exceptions: floc::InputError for what a user can mend, naming file, place, value and what was expected;
/// floc::IoError for what the system refuses; floc::NoResult where a state has no such number. The library prints
/// nothing: remarks that computations make go to a floc::Remarks, where one is given.

#include "floc/base/error.h"
#include "floc/base/version.h"
#include "floc/elasticity/moduli.h"
#include "floc/fitting/consolidation.h"
#include "floc/imports/complete_import.h"
#include "floc/io/import.h"
#include "floc/io/state_file.h"
#include "floc/io/table.h"
#include "floc/run_directory/run_directory.h"
#include "floc/run_directory/scene_run.h"
#include "floc/scene/read_scene.h"
#include "floc/tables/consolidation_fits.h"
#include "floc/tables/moduli_rows.h"
#include "floc/tables/network_rows.h"
#include "floc/tables/structure_columns.h"
#include "floc/verification/verify_state.h"
