#include "floc/io/lmgc90_contacts.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/io/dat_file.h"
#include "floc/io/listed_bodies.h"
#include "floc/io/listed_points.h"

namespace floc {
namespace {

/// A contact, as far as its lines have been read.
struct ContactRecord {
  FileLine place;
  bool spatial = false;  ///< whether the bodies are three-dimensional (RBDY3)
  std::vector<std::int64_t> bodies;
  /// Components of the force along the tangent t, the normal n and the tangent s.
  std::optional<Eigen::Vector3d> force;
  /// Normal, which points to the candidate, the first body, and the tangents.
  std::optional<Eigen::Vector3d> n, t, s;
  double gap = 0.0;
  std::optional<Eigen::Vector3d> point;

  bool is_whole() const { return bodies.size() == 2 && force && n; }
};

/// Reads one line of a contact.
void read_line(const DatFile& file, ContactRecord& record) {
  const auto words = file.words();
  if (words[0] == "RBDY2" || words[0] == "RBDY3") {
    record.spatial = words[0] == "RBDY3";
    for (std::size_t k = 0; k + 1 < words.size(); ++k)
      if (words[k] == words[0])
        if (const auto id = parse_number<std::int64_t>(words[k + 1])) record.bodies.push_back(*id);
    if (record.bodies.size() != 2)
      throw InputError(file.place(),
                       fmt::format("the contact has {} bodies, expected two", record.bodies.size()));
  } else if (file.has("rln/H")) {
    // LMGC90 computes impulses. Each number in this line is an impulse divided by the time step H, which is a force.
    record.force = {file.number("rlt/H"), file.number("rln/H"), record.spatial ? file.number("rls/H") : 0.0};
  } else if (file.has("gapTT")) {
    record.gap = file.number("gapTT");
  } else if (file.has("coo1=")) {
    record.point = {file.number("coo1="), file.number("coo2="), record.spatial ? file.number("coo3=") : 0.0};
  } else {
    for (const auto& [name, vector] :
         {std::pair{"t", &record.t}, std::pair{"n", &record.n}, std::pair{"s", &record.s}})
      if (file.has(fmt::format("{}(1)=", name))) {
        vector->emplace();
        for (int a = 0; a < 3; ++a) (**vector)[a] = file.number(fmt::format("{}({})=", name, a + 1));
      }
  }
}

/// Returns a tangent of a contact, which must be a unit vector perpendicular to the normal.
Eigen::Vector3d tangent_of(const ContactRecord& record, const char* name,
                           const std::optional<Eigen::Vector3d>& listed, const Eigen::Vector3d& normal) {
  constexpr double kRight = 1e-3;  // as for the length of a normal
  if (!listed || !(std::abs(listed->norm() - 1.0) <= kRight && std::abs(listed->dot(normal)) <= kRight))
    throw InputError(
        record.place.text(),
        fmt::format("the contact has a tangential force, but {0}(1)= {0}(2)= {0}(3)= do not give a unit "
                    "vector perpendicular to the normal n",
                    name));
  return listed->normalized();
}

/// Returns the whole force of a contact. In 2D, the normal determines the tangent.
Eigen::Vector3d force_of(const ContactRecord& record, const Eigen::Vector3d& n) {
  const Eigen::Vector3d& local = *record.force;
  Eigen::Vector3d force = local[1] * n;
  if (!record.spatial) return force + local[0] * Eigen::Vector3d(n[1], -n[0], 0.0);
  if (local[0] != 0.0) force += local[0] * tangent_of(record, "t", record.t, n);
  if (local[2] != 0.0) force += local[2] * tangent_of(record, "s", record.s, n);
  return force;
}

/// Adds a contact of which all lines have been read.
void add_contact(const ContactRecord& record, const std::map<std::int64_t, WallSide>& walls,
                 std::vector<ListedContact>& contacts) {
  const std::string place = record.place.text();
  if (record.bodies.empty())
    throw InputError(place, "the contact has no bodies, expected a line that begins with RBDY2 or RBDY3");
  if (!record.n) throw InputError(place, "the contact has no normal, expected a line n(1)= n(2)= n(3)=");
  if (!record.force) throw InputError(place, "the contact has no force, expected a line rlt/H rln/H rls/H");
  if (record.force->isZero(0.0) && record.gap > 0.0) return;
  const Eigen::Vector3d n = unit_normal(record.place, *record.n);
  ListedContact c;
  c.place = record.place;
  c.id1 = record.bodies[0], c.id2 = record.bodies[1];
  c.force = force_of(record, n);
  c.normal = -n;
  c.gap = record.gap;
  c.point = record.point;
  name_wall(walls, c);
  contacts.push_back(std::move(c));
}

}  // namespace

std::vector<ListedContact> read_lmgc90_contacts(const std::string& path,
                                                const std::map<std::int64_t, WallSide>& walls) {
  std::vector<ListedContact> contacts;
  if (!std::filesystem::exists(path)) return contacts;
  DatFile file(path);
  std::optional<ContactRecord> record;
  bool have_points = false;
  // No line marks the end of a contact. A contact is complete when the next contact begins, or when the file ends.
  while (file.next()) {
    // A number at the end of a file that is cut may have lost digits.
    if (file.is_cut())
      throw InputError(file.place(),
                       "the file ends within a contact: expected a line feed after the last line");
    if (file.words()[0] == "$icdan") {
      if (record) add_contact(*record, walls, contacts);
      have_points = have_points || (record && record->point);
      record.emplace();
      record->place = file.file_line();
    } else if (record) {
      read_line(file, *record);
    }
  }
  if (!record) return contacts;
  // All contacts have the same lines.
  if (!contacts.empty() && (!record->is_whole() || (have_points && !record->point)))
    throw InputError(file.place(), fmt::format("the file ends within a contact, which begins at {}: it is cut",
                                               record->place.text()));
  add_contact(*record, walls, contacts);
  return contacts;
}

}  // namespace floc
