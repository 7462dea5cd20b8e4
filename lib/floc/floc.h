#pragma once

/// @file
/// The public interface of floc in one header.

/// @mainpage
/// Include `floc/floc.h` and link `floc::floc`; the page "Installation" of the documentation has the CMake lines. All
/// names are in namespace floc. Quantities are in the units of the files, which are reduced units or SI: see
/// State::units.
///
/// A program calls the functions of floc in the order below. Each function is documented where it is declared, with its
/// pre- and postconditions, units and errors.
///
/// 1. Get a state. floc::read_state() reads a state file. For a file of another program, floc::find_import_format()
///    returns the format of the file. The function read() of this format reads the file, and floc::complete_import()
///    completes the packing. floc::run_scene() runs a scene in a directory and writes the states of the run there;
///    floc::state_file() returns the names of the state files.
/// 2. Verify it. floc::verify_state() recomputes from the state alone whether it is an equilibrium.
/// 3. Compute the properties of its contact network as tables, with the columns of docs/columns.md:
///    floc::moduli_table(), floc::network_table(), floc::structure_table(). For a sequence of states, floc::ModuliRows
///    can use the solution for one state as the initial guess for the next state. floc::elastic_moduli() returns the
///    moduli themselves, with the stiffness matrix and the response.
/// 4. Fit the consolidation law to load paths: floc::consolidation_fit() for tables and directories of runs,
///    floc::fit_consolidation() for points in memory.
/// 5. Write results: floc::write_table() writes tables, floc::write_state() writes states.
///
/// Errors are exceptions. floc::InputError is for errors that a user can correct; its message names the file, the place
/// in the file, the value and the expected value. floc::IoError is for failures of the operating system. floc::NoResult
/// is for quantities that do not exist for the state. The library prints nothing: warnings and notes of computations go
/// to a floc::Remarks object, if the caller passes one.

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
