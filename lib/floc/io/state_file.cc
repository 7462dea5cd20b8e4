#include "floc/io/state_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/sha256.h"
#include "floc/io/atomic_file.h"
#include "floc/io/checked_state.h"
#include "floc/io/hdf5_file.h"
#include "floc/io/law_attributes.h"
#include "floc/io/sealed_file.h"
#include "floc/io/state_archive.h"
#include "floc/io/state_bonds.h"
#include "floc/io/state_equilibrium.h"
#include "floc/io/state_layout.h"
#include "floc/io/state_shapes.h"
#include "floc/io/state_walls.h"
#include "floc/packing/bonds.h"
#include "floc/packing/locate.h"
#include "floc/packing/overlaps.h"

namespace floc {
namespace {

const std::string kFormat = "floc-state";
const std::string kSignConvention = "compression_positive";

constexpr Field kId = {"grains/id", Quantity::count, "index of the grain in all arrays"};

/// Names of features: the optional groups of a state file, and `rigid`, which marks a file with rigid contacts. The
/// root attribute `features` lists the features of the file. A program rejects a file with a feature that the program
/// does not support, so a new physical feature needs no new version of the file format.
const std::string kContactMemory = "contacts/memory";
const std::string kNoFeatures = "none";
const std::string kWalls = "walls";
const std::string kShapes = "shapes";
const std::string kRigid = "rigid";
const std::string kBonds = "bonds";
const std::string kOpenEnds = "open_ends";
const std::string kGravityFeature = "gravity";
const std::string kMotion = "motion";
const std::vector<std::string> kKnownFeatures = {kNoFeatures, kContactMemory,  kWalls, kShapes, kRigid,
                                                 kOpenEnds,   kGravityFeature, kBonds, kMotion};

Quantity quantity_of(Unit unit) {
  switch (unit) {
    case Unit::length:
      return Quantity::length;
    case Unit::force:
      return Quantity::force;
    case Unit::stiffness:
      return Quantity::stiffness;
    case Unit::rolling_stiffness:
      return Quantity::rolling_stiffness;
    case Unit::angle:
      return Quantity::angle;
    case Unit::pressure:
      return Quantity::stress;
    case Unit::volume:
      return Quantity::volume;
    case Unit::ratio:
    case Unit::degrees:
      break;
  }
  return Quantity::ratio;
}

/// Returns the history quantities of contacts (such as the elongation of the tangential spring), each once: those of
/// the law between grains and, if the packing has walls, those of the law between grains and walls.
template <int Dim>
std::vector<HistoryQuantity> quantities_of(const Packing<Dim>& packing) {
  std::vector<HistoryQuantity> all = history_quantities(packing.law, Dim);
  if (packing.walls.empty()) return all;
  for (const HistoryQuantity& q : history_quantities(packing.wall_law, Dim))
    if (std::none_of(all.begin(), all.end(), [&](const HistoryQuantity& known) {
          return std::string(known.declared.name) == q.declared.name;
        }))
      all.push_back(q);
  return all;
}

/// Writes the history of contacts: one array per history quantity, with one row per contact.
template <int Dim>
void write_memory(WritingArchive& archive, const Packing<Dim>& packing) {
  for (const HistoryQuantity& q : quantities_of(packing)) {
    const std::string path = kContactMemory + "/" + q.declared.name;
    const std::string meaning = std::string("history: ") + q.declared.meaning;
    std::vector<double> values;
    values.reserve(packing.contacts.size() * q.size);
    for (const Contact<Dim>& c : packing.contacts)
      for (int k = 0; k < q.size; ++k) values.push_back(c.history[q.begin + k]);
    archive.put({path.c_str(), quantity_of(q.declared.unit), meaning.c_str()},
                shape_of(packing.contacts.size(), q.size), values);
  }
}

/// An array with a part of the contact history. State files of version 1 contain this array for every contact law.
struct Version1Name {
  const char* name;
  HistoryKind kind;
  Quantity quantity;
};
constexpr Version1Name kVersion1Names[] = {{"shear_spring", HistoryKind::tangent, Quantity::length},
                                           {"rolling_spring", HistoryKind::rotation, Quantity::angle}};

template <int Dim>
bool remembers(const Packing<Dim>& packing, const std::string& name) {
  const std::vector<HistoryQuantity> quantities = quantities_of(packing);
  return std::any_of(quantities.begin(), quantities.end(),
                     [&](const HistoryQuantity& q) { return name == q.declared.name; });
}

/// Gives each array of the contact history a second name, the name in version 1 of the file format, for scripts that
/// use the names of version 1. If the law does not have a history quantity of version 1, an array of zeros is written
/// for it.
template <int Dim>
void write_version_1_names(Hdf5Writer& file, WritingArchive& archive, const Packing<Dim>& packing) {
  for (const Version1Name& known : kVersion1Names) {
    const std::string path = std::string("contacts/") + known.name;
    if (remembers(packing, known.name))
      file.link(kContactMemory + "/" + known.name, path);
    else
      archive.put({path.c_str(), known.quantity, "history: none"},
                  shape_of(packing.contacts.size(), n_components(known.kind, Dim)),
                  std::vector<double>(packing.contacts.size() * n_components(known.kind, Dim), 0.0));
  }
}

template <int Dim>
void check_version_1_names(const Hdf5Reader& file, ReadingArchive& archive, const Packing<Dim>& packing) {
  for (const Version1Name& known : kVersion1Names) {
    const std::string path = std::string("contacts/") + known.name;
    if (!file.has(path) || remembers(packing, known.name)) continue;
    for (const double value :
         archive.take<double>({path.c_str(), known.quantity, ""},
                              shape_of(packing.contacts.size(), n_components(known.kind, Dim))))
      if (value != 0.0)
        throw InputError(
            file.place(path),
            fmt::format("the dataset contains {}, expected zeros: the contact law has no such history", value));
  }
}

/// Reads the history of contacts.
/// @param version  version of the file format; in version 1 the arrays are in the group `contacts`, in later versions
/// in `contacts/memory`
template <int Dim>
void read_memory(ReadingArchive& archive, std::int64_t version, Packing<Dim>& packing) {
  for (const HistoryQuantity& q : quantities_of(packing)) {
    const std::string path = (version == 1 ? "contacts" : kContactMemory) + "/" + q.declared.name;
    const auto values = archive.take<double>({path.c_str(), quantity_of(q.declared.unit), ""},
                                             shape_of(packing.contacts.size(), q.size));
    std::size_t next = 0;
    for (Contact<Dim>& c : packing.contacts)
      for (int k = 0; k < q.size; ++k) c.history[q.begin + k] = values[next++];
  }
}

void check_features(const Hdf5Reader& file) {
  std::string features;
  file.attribute("/", "features", features);
  std::istringstream names(features);
  for (std::string name; names >> name;)
    if (std::find(kKnownFeatures.begin(), kKnownFeatures.end(), name) == kKnownFeatures.end())
      throw InputError(file.place("/"), fmt::format("features = \"{}\": this version of floc does not support "
                                                    "{}, so it would misread the state; it supports {}",
                                                    features, name, fmt::join(kKnownFeatures, ", ")));
}

/// Returns the names of the features that the file of a state has, separated by blanks.
/// @param remembers  whether the contacts have a history
template <int Dim>
std::string features_of(const State<Dim>& state, bool remembers) {
  const Packing<Dim>& packing = state.packing;
  std::vector<std::string> features;
  if (remembers) features.push_back(kContactMemory);
  if (!packing.walls.empty()) features.push_back(kWalls);
  if (!packing.grains.are_round()) features.push_back(kShapes);
  if (packing.law.is_rigid()) features.push_back(kRigid);
  if (is_open(packing.walls)) features.push_back(kOpenEnds);
  if (!packing.gravity.isZero(0.0)) features.push_back(kGravityFeature);
  if (has_bonds(packing)) features.push_back(kBonds);
  if (state.motion) features.push_back(kMotion);
  return features.empty() ? kNoFeatures : fmt::format("{}", fmt::join(features, " "));
}

template <int Dim>
const char* boundary_along(const std::vector<Wall<Dim>>& walls, int axis) {
  for (std::size_t w = 0; w + 1 < walls.size(); w += 2) {
    if (walls[w].axis != axis) continue;
    const bool below = !walls[w].open, above = !walls[w + 1].open;
    return below && above ? "walls" : below ? "wall-open" : above ? "open-wall" : "open";
  }
  return "periodic";
}

/// Returns a text with one word for the boundary along each axis, for example "walls periodic". The words are
/// "periodic", "walls" (a wall at each end), "open" (no wall), "wall-open" (a wall at the lower end only) and
/// "open-wall" (a wall at the upper end only). For a packing that is periodic along all axes, the text is the single
/// word "periodic".
template <int Dim>
std::string boundary_of(const Packing<Dim>& packing) {
  if (packing.walls.empty()) return "periodic";
  std::string text;
  for (int a = 0; a < Dim; ++a) text += std::string(a == 0 ? "" : " ") + boundary_along(packing.walls, a);
  return text;
}

template <int Dim>
void encode(const State<Dim>& s, const std::string& progress, const std::string& path) {
  Hdf5Writer file(path);
  file.attribute("/", "format", kFormat);
  file.attribute("/", "version", std::int64_t{kStateVersion});
  file.attribute("/", "dimension", std::int64_t{Dim});
  file.attribute("/", "units", s.units);
  file.attribute("/", "sign_convention", kSignConvention);
  const bool remembers = !quantities_of(s.packing).empty();
  file.attribute("/", "features", features_of(s, remembers));
  for (const char* group : {"cell", "grains", "contacts", "equilibrium", "path", "provenance"})
    file.group(group);
  if (remembers) file.group(kContactMemory);
  if (!s.packing.walls.empty()) file.group(kWalls);
  if (!s.packing.grains.are_round()) file.group(kShapes);
  if (s.motion) file.group(kMotion);
  file.attribute("cell", "boundary", boundary_of(s.packing));

  WritingArchive archive(file, s.units, Dim);
  describe_cell(archive, s.packing.cell);
  // The array grains/id contains the indices of the grains. The array grains/imported_id contains the identifiers from
  // a file of another program.
  std::vector<std::int32_t> id(s.packing.grains.size());
  for (std::size_t i = 0; i < id.size(); ++i) id[i] = static_cast<std::int32_t>(i);
  archive.put(kId, {id.size()}, id);
  describe_grains<Dim>(archive, s.packing.grains);
  describe_contacts<Dim>(archive, s.packing.contacts);
  if (keeps_twisting(s.packing)) describe_twisting(archive, s.packing.contacts);
  write_bonds(archive, s);
  write_shapes(archive, s.packing);
  write_memory(archive, s.packing);
  write_version_1_names(file, archive, s.packing);
  write_law(file, s.packing.law);
  write_equilibrium(archive, s);
  write_directed_load(file, archive, s);
  write_walls(file, archive, s);
  describe_attributes(archive, s);
  file.text("scene", s.scene);
  file.attribute("provenance", "scene_sha256", sha256(s.scene));
  if (!progress.empty()) file.text("progress", progress);
  file.close();
}

[[noreturn]] void refuse(const Hdf5Reader& file, const std::string& path, std::size_t entry,
                         const std::string& what) {
  throw InputError(file.place(path), fmt::format("entry {} is {}", entry, what));
}

/// Largest accepted number of rows of an array, and largest accepted distance of a periodic image (in numbers of
/// cells). Indices and images are of type int, which may be too small for larger numbers.
constexpr std::uint64_t kMaxRows = 1'000'000'000;
constexpr int kFarthestImage = 1'000'000'000;

std::uint64_t counted_rows(const Hdf5Reader& file, const char* path) {
  const std::uint64_t n = file.n_rows(path);
  if (n > kMaxRows)
    throw InputError(file.place(path),
                     fmt::format("the dataset has {} rows, expected at most {}", n, kMaxRows));
  return n;
}

/// Checks that the cell has a volume, that the array grains/id contains the indices of the grains, and that radii and
/// masses are positive. The archive has already checked that all numbers are finite.
template <int Dim>
void check_grains(const Hdf5Reader& file, const Packing<Dim>& packing, const std::vector<std::int32_t>& id) {
  if (!(packing.cell.volume() > 0.0)) throw InputError(file.place("cell/matrix"), "the cell has no volume");
  if (id.empty()) throw InputError(file.place("grains/radius"), "the dataset contains no grains");
  for (std::size_t i = 0; i < id.size(); ++i) {
    if (id[i] != static_cast<std::int32_t>(i))
      refuse(file, "grains/id", i, fmt::format("{}, expected {}", id[i], i));
    if (!(packing.grains.radius[i] > 0.0))
      refuse(file, "grains/radius", i, fmt::format("{}, expected a positive number", packing.grains.radius[i]));
    if (!(packing.grains.mass[i] > 0.0))
      refuse(file, "grains/mass", i, fmt::format("{}, expected a positive number", packing.grains.mass[i]));
  }
}

/// If the grains have identifiers from a file of another program, checks that no two grains have the same identifier.
template <int Dim>
void check_names(const Hdf5Reader& file, const Grains<Dim>& grains) {
  std::vector<std::pair<std::int64_t, std::size_t>> sorted;
  for (std::size_t i = 0; i < grains.id.size(); ++i) sorted.emplace_back(grains.id[i], i);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 1; k < sorted.size(); ++k)
    if (sorted[k].first == sorted[k - 1].first)
      refuse(file, "grains/imported_id", sorted[k].second,
             fmt::format("{}, as is entry {}: expected a different number for each grain", sorted[k].first,
                         sorted[k - 1].second));
}

template <int Dim>
void check_contacts(const Hdf5Reader& file, const Packing<Dim>& packing) {
  const int n = packing.grains.size();
  const auto require_grain = [&](const char* path, std::size_t c, int grain) {
    if (grain < 0 || grain >= n)
      refuse(file, path, c, fmt::format("{}, expected a grain from 0 to {}", grain, n - 1));
  };
  for (std::size_t c = 0; c < packing.contacts.size(); ++c) {
    const Contact<Dim>& contact = packing.contacts[c];
    require_grain("contacts/id1", c, contact.i);
    if (contact.j >= n && contact.j < n + static_cast<int>(packing.walls.size())) continue;
    require_grain("contacts/id2", c, contact.j);
    for (const int image : contact.image)
      if (image < -kFarthestImage || image > kFarthestImage)
        refuse(file, "contacts/image", c, fmt::format("{}, expected a number of cells up to 1e9", image));
    if (contact.i == contact.j && contact.image.isZero())
      refuse(file, "contacts/id2", c, fmt::format("{}: the grain would touch itself", contact.j));
  }
}

/// Checks that the attributes `scene_sha256`, `features` and `boundary` agree with the content of the file, which they
/// describe for other programs.
template <int Dim>
void check_descriptions(const Hdf5Reader& file, std::int64_t version, const State<Dim>& s) {
  const auto require = [&file](const char* group, const char* name, const std::string& expected) {
    std::string recorded;
    if (!file.has_attribute(group, name)) return;
    file.attribute(group, name, recorded);
    if (recorded != expected)
      throw InputError(file.place(group),
                       fmt::format("attribute {} = \"{}\", but the content of this file requires \"{}\"", name,
                                   recorded, expected));
  };
  require("provenance", "scene_sha256", sha256(s.scene));
  if (version < 2) return;
  require("/", "features", features_of(s, !quantities_of(s.packing).empty()));
  require("cell", "boundary", boundary_of(s.packing));
}

/// Checks that the contacts with walls and the contacts between grains are either all rigid or all not rigid.
template <int Dim>
void require_one_kind_of_law(const Hdf5Reader& file, const Packing<Dim>& packing) {
  if (packing.walls.empty() || packing.wall_law.is_rigid() == packing.law.is_rigid()) return;
  throw InputError(file.place("wall_law"),
                   fmt::format("normal = \"{}\", expected a law that is {}rigid, like the law between grains",
                               packing.wall_law.normal_keyword(), packing.law.is_rigid() ? "" : "not "));
}

/// Checks the data for the next time step, which a state in motion contains.
template <int Dim>
void check_motion(const Hdf5Reader& file, const State<Dim>& s) {
  if (!s.motion) return;
  if (!s.packing.law.is_rigid() || !s.packing.walls.empty())
    throw InputError(file.place(kMotion),
                     "the state is in motion, which is possible only for rigid grains in a periodic cell");
  const MotionRecord& m = *s.motion;
  const auto require = [&](const char* name, double value, double least, double most) {
    if (!(value >= least && value <= most))
      throw InputError(file.place(kMotion),
                       fmt::format("{} = {}, expected a number from {} to {}", name, value, least, most));
  };
  constexpr double kTiny = std::numeric_limits<double>::min(), kHuge = std::numeric_limits<double>::max();
  require("time_step", m.time_step, kTiny, kHuge);
  require("longest_step", m.longest_step, m.time_step, kHuge);
  require("cell_mass", m.cell_mass, kTiny, kHuge);
  require("restitution", m.restitution, 0.0, 1.0);
  require("slow_impact", m.slow_impact, 0.0, kHuge);
  require("sweep_tolerance", m.sweep_tolerance, kTiny, kHuge);
  require("residual", m.residual, 0.0, kHuge);
  require("inertial_number", m.inertial_number, kTiny, kHuge);
}

template <int Dim>
State<Dim> decode(const Hdf5Reader& file, std::int64_t version) {
  State<Dim> s;
  Packing<Dim>& packing = s.packing;
  file.attribute("/", "units", s.units);
  ReadingArchive archive(file);
  describe_cell(archive, packing.cell);
  const std::uint64_t n = counted_rows(file, "grains/radius");
  packing.grains = Grains<Dim>::with_size(static_cast<int>(n));
  const auto id = archive.take<std::int32_t>(kId, {n});
  describe_grains<Dim>(archive, packing.grains);
  check_grains(file, packing, id);
  check_names(file, packing.grains);
  read_shapes_of_state(file, archive, packing.grains);
  packing.contacts.resize(counted_rows(file, "contacts/id1"));
  describe_contacts<Dim>(archive, packing.contacts);
  read_walls(file, archive, s);
  check_contacts(file, packing);
  if (packing.grains.are_round())
    set_arms(packing);
  else
    read_contact_points(file, archive, packing);
  packing.law = read_law(file, Dim);
  require_one_kind_of_law(file, packing);
  read_bonds(file, archive, s);
  if (keeps_twisting(packing)) describe_twisting(archive, packing.contacts);
  // In a checkpoint the overlaps are not checked, because a packing in motion may have large overlaps for a short time.
  if (!file.has("progress")) require_small_overlaps(file.place("contacts/gap"), packing);
  read_memory(archive, version, packing);
  check_version_1_names(file, archive, packing);
  read_equilibrium(file, archive, s);
  read_directed_load(file, archive, s);
  if (file.has(kMotion)) s.motion.emplace();
  describe_attributes(archive, s);
  // Earlier versions did not record this length, and took the length of the step instead.
  if (s.motion && !file.has_attribute(kMotion, "longest_step")) s.motion->longest_step = s.motion->time_step;
  check_motion(file, s);
  s.scene = file.text("scene");
  check_descriptions(file, version, s);
  return s;
}

struct Header {
  std::int64_t version = 0;
  std::int64_t dimension = 0;
};

/// Reads the attributes that determine how the rest of a state file is read. Checks format, version, features, sign
/// convention, units and dimension.
Header read_header(const Hdf5Reader& file) {
  std::string format;
  file.attribute("/", "format", format);
  if (format != kFormat)
    throw InputError(file.place("/"), fmt::format("format = \"{}\", expected \"{}\"", format, kFormat));
  Header header;
  file.attribute("/", "version", header.version);
  const std::int64_t version = header.version;
  if (version > kStateVersion)
    throw InputError(
        file.place("/"),
        fmt::format("version = {}: the file was written by a newer floc; this floc reads versions up to {}",
                    version, kStateVersion));
  if (version < 1) throw InputError(file.place("/"), fmt::format("version = {}, expected 1 or more", version));
  // Files of version 1 have no attribute `features`, because optional groups exist since version 2.
  if (version >= 2) check_features(file);
  std::string sign;
  file.attribute("/", "sign_convention", sign);
  if (sign != kSignConvention)
    throw InputError(file.place("/"),
                     fmt::format("sign_convention = \"{}\", expected \"{}\"", sign, kSignConvention));
  std::string units;
  file.attribute("/", "units", units);
  if (units != "reduced" && units != "SI")
    throw InputError(file.place("/"), fmt::format("units = \"{}\", expected \"reduced\" or \"SI\"", units));
  file.attribute("/", "dimension", header.dimension);
  if (header.dimension != 2 && header.dimension != 3)
    throw InputError(file.place("/"), fmt::format("dimension = {}, expected 2 or 3", header.dimension));
  return header;
}

/// Opens a state file, reads its header, and returns the result of `read(file, header)`.
/// @param path  name of the file in messages
/// @param content_path  path under which the file is opened; it differs from `path` for a pipe or standard input
template <class Read>
auto read_content(const std::string& path, const std::string& content_path, const Read& read) {
  try {
    const Hdf5Reader file(path, content_path);
    return read(file, read_header(file));
  } catch (const Hdf5Failure& e) {
    throw InputError(path, fmt::format("the file is damaged although its checksum is right: {}", e.what()));
  }
}

template <class Read>
auto read_sealed(const std::string& path, const Read& read) {
  const SealedFile sealed(path);
  return read_content(path, sealed.content_path(), read);
}

AnyState decode_any(const Hdf5Reader& file, const Header& header) {
  if (header.dimension == 2) return decode<2>(file, header.version);
  return decode<3>(file, header.version);
}

}  // namespace

template <int Dim>
void write_state(const std::string& path, const State<Dim>& state, const std::string& progress) {
  AtomicFile file(path);
  try {
    encode(state, progress, file.working_path());
  } catch (const Hdf5Failure& e) {
    throw file.cannot_be_written(e.error());
  }
  append_seal(file);
  file.commit();
}

AnyState read_state(const std::string& path) {
  return read_sealed(path, decode_any);
}

AnyState read_checked_state(const std::string& path) {
  return read_content(path, path, decode_any);
}

std::string read_progress(const std::string& path) {
  return read_sealed(path, [](const Hdf5Reader& file, const Header& header) {
    if (!file.has("progress")) return std::string();
    if (header.version < 2)
      throw InputError(
          file.place("progress"),
          fmt::format(
              "the checkpoint has version {} of the file format, which lacks data that this floc needs to "
              "continue within a step: finish the step with the version of floc that wrote the checkpoint, or "
              "remove the checkpoint to continue from the last equilibrium saved",
              header.version));
    return file.text("progress");
  });
}

template void write_state(const std::string&, const State<2>&, const std::string&);
template void write_state(const std::string&, const State<3>&, const std::string&);

}  // namespace floc
