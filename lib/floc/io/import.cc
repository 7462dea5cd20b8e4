#include "floc/io/import.h"

#include <fmt/format.h>

#include <filesystem>

#include "floc/base/error.h"
#include "floc/base/read_file.h"
#include "floc/base/read_text.h"
#include "floc/io/csv_packing.h"
#include "floc/io/extended_xyz.h"
#include "floc/io/jambashbulk.h"
#include "floc/io/lammps_data.h"
#include "floc/io/lammps_dump.h"
#include "floc/io/legacy_vtk.h"
#include "floc/io/listed_columns.h"
#include "floc/io/lmgc90.h"
#include "floc/io/mercurydpm.h"
#include "floc/io/rockable.h"
#include "floc/io/sealed_file.h"
#include "floc/io/stdin_copy.h"
#include "floc/io/table_text.h"
#include "floc/io/vtkhdf.h"
#include "floc/io/vtu.h"
#include "floc/io/yade_text.h"

namespace floc {
namespace {

/// Returns the extension of a file name; for a compressed file, the extension before .gz.
std::string named_extension(const std::filesystem::path& path) {
  return (path.extension() == ".gz" ? path.stem() : path).extension().string();
}

bool is_state(const std::string& path) {
  return std::filesystem::path(path).extension() == ".h5";
}

bool is_csv(const std::string& path) {
  const std::string extension = named_extension(path);
  return extension == ".csv" || extension == ".tsv";
}

/// Whether a file is a table with the columns of grains. The name of the file does not matter.
bool is_table_of_grains(const std::string& path) {
  try {
    const CsvTable table = CsvTable::read(path, grain_names());
    const NamedColumns columns(table, {});
    return columns.has("x") && columns.has("y");
  } catch (const InputError&) {
    return false;
  }
}

Imported read_own_state(const std::string& path, const ImportOptions& options) {
  if (options.law || !options.cell.empty() || !options.contacts.empty() || !options.columns.empty() ||
      !options.contact_columns.empty() || options.index || options.dimension)
    throw InputError(
        path,
        "a state file of floc describes its packing completely: leave out --law, --cell, --columns, "
        "--contacts, --contact-columns, --index, --dimension");
  Imported imported;
  imported.state = read_state(path);
  imported.complete = true;
  return imported;
}

/// Whether a file has the seal of a state file.
bool is_sealed(const std::string& path) {
  try {
    return !SealedFile(path).content_path().empty();
  } catch (const InputError&) {
    return false;
  }
}

/// Returns the format of the packing on standard input, recognised by its content. Afterwards, standard input can be
/// read again.
const ImportFormat& format_of_stdin() {
  const StdinCopy copy;
  if (is_sealed(copy.path())) return find_import_format("state", "-");
  for (const ImportFormat& format : import_formats())
    if (format.recognises(copy.path())) return format;
  return find_import_format("csv", "-");
}

}  // namespace

bool begins_with(const std::string& path, const std::string& text) {
  return beginning_of_table(path).starts_with(text);
}

const std::vector<ImportFormat>& import_formats() {
  // If the user names no format, find_import_format() takes the first format of this list that recognises the file. A
  // state file begins with the signature of HDF5, by which `vtkhdf` recognises its files, so that `state` must come
  // before `vtkhdf`.
  static const std::vector<ImportFormat> formats = {
      {"state", "state file of floc, .h5", is_state, read_own_state},
      {"csv", "one grain per line, columns x, y[, z] and radius or diameter[, mass, id]", is_csv,
       read_csv_packing},
      {"lmgc90", "directory DATBOX of LMGC90: disks, spheres, polygons, polyhedra and flat walls", is_lmgc90,
       read_lmgc90},
      {"vtu", "VTK's unstructured grid whose points have a radius", is_vtu, read_vtu},
      {"vtp", "VTK's polygonal data whose points have a radius", is_vtp, read_vtu},
      {"vtk", "VTK's legacy format, ASCII or binary, whose points have a radius", is_legacy_vtk,
       read_legacy_vtk},
      {"vtkhdf", "VTK's HDF format: points with a radius, lines as contacts", is_vtkhdf, read_vtkhdf},
      {"lammps-dump", "LAMMPS dump of style custom, contacts from a dump of style local", is_lammps_dump,
       read_lammps_dump},
      {"lammps-data", "LAMMPS data file, atom_style sphere", is_lammps_data, read_lammps_data},
      {"yade", "text files of spheres (x y z r) and of interactions, written by a script of YADE", is_yade_text,
       read_yade_text},
      {"mercurydpm", "restart file of MercuryDPM", is_mercurydpm, read_mercurydpm},
      {"rockable", "configuration of Rockable: spheres, rounded polyhedra and flat walls", is_rockable,
       read_rockable},
      {"extended-xyz", "extended XYZ with Lattice, pos and radius, or plain XYZ with --columns",
       is_extended_xyz, read_extended_xyz},
      {"jambashbulk", "text file of the jamBashbulk code (2D, linear repulsion)", is_jambashbulk,
       read_jambashbulk},
  };
  return formats;
}

const ImportFormat& find_import_format(const std::string& keyword, const std::string& path) {
  if (keyword.empty() && path == "-") return format_of_stdin();
  std::string known;
  for (const ImportFormat& format : import_formats()) {
    if (keyword.empty() ? format.recognises(path) : format.keyword == keyword) return format;
    known += fmt::format("{}{} ({})", known.empty() ? "" : ", ", format.keyword, format.description);
  }
  if (keyword.empty()) {
    if (is_table_of_grains(path)) return find_import_format("csv", path);
    require_text(path, read_file(path));
    throw InputError(
        path,
        fmt::format("the format of the file is not recognised; give the format with --from: one of {}", known));
  }
  throw InputError("--from", fmt::format("\"{}\" is not a format; the formats are {}", keyword, known));
}

}  // namespace floc
