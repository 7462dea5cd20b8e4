#include "floc/io/contact_file.h"

#include <fmt/format.h>

#include "floc/io/lammps_dump.h"
#include "floc/io/listed_bodies.h"
#include "floc/io/listed_columns.h"
#include "floc/io/mercurydpm.h"
#include "floc/io/stdin_copy.h"
#include "floc/io/yade_text.h"

namespace floc {

namespace {

std::vector<ListedContact> read_listed(const ImportOptions& options, int dimension, ListedPacking& listed) {
  std::optional<StdinCopy> copy;
  if (options.contacts == "-") copy.emplace();
  const std::string& file = copy ? copy->path() : options.contacts;
  if (is_lammps_dump(file)) return read_dump_contacts(options, dimension, listed.timestep);
  if (is_yade_interactions(file)) return read_yade_contacts(options, dimension);
  if (is_mercurydpm_fstat(file)) return read_mercurydpm_contacts(options, dimension, listed);
  const CsvTable table =
      CsvTable::read(options.contacts, wanted_names(contact_names(), options.contact_columns));
  if (!table.description().empty())
    listed.remarks.push_back(
        fmt::format("{}: read {}: {}", options.contacts, table.rows_in_words(), table.description()));
  const NamedColumns columns(table, options.contact_columns);
  add_unread_columns(columns, contact_names_in(columns, dimension), listed.remarks);
  return read_contacts(columns, dimension, options.units);
}

}  // namespace

std::optional<std::vector<ListedContact>> read_contact_file(const ImportOptions& options, int dimension,
                                                            ListedPacking& listed) {
  check_contact_columns("--contact-columns", options.contact_columns);
  if (options.contacts.empty()) return std::nullopt;
  std::vector<ListedContact> contacts = read_listed(options, dimension, listed);
  for (ListedContact& c : contacts) name_wall(options.wall_ids, c);
  return contacts;
}

std::vector<ListedContact> read_bond_file(const ImportOptions& options, int dimension, ListedPacking& listed) {
  if (options.bonds.empty()) return {};
  ImportOptions of_bonds = options;
  of_bonds.contacts = options.bonds;
  of_bonds.contact_columns.clear();
  std::vector<ListedContact> bonds = read_listed(of_bonds, dimension, listed);
  for (ListedContact& bond : bonds) name_wall(options.wall_ids, bond);
  for (ListedContact& bond : bonds) bond.bond = true;
  return bonds;
}

}  // namespace floc
