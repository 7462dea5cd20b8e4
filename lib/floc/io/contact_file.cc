#include "floc/io/contact_file.h"

#include <fmt/format.h>

#include "floc/io/lammps_dump.h"
#include "floc/io/listed_bodies.h"
#include "floc/io/listed_columns.h"
#include "floc/io/mercurydpm.h"
#include "floc/io/yade_text.h"

namespace floc {

namespace {

std::vector<ListedContact> read_listed(const ImportOptions& options, int dimension,
                                       std::optional<std::int64_t> timestep,
                                       std::vector<std::string>* remarks) {
  // Standard input can be read only once. Its format cannot be recognised before the contacts are read.
  const bool on_stdin = options.contacts == "-";
  if (!on_stdin && is_lammps_dump(options.contacts)) return read_dump_contacts(options, dimension, timestep);
  if (!on_stdin && is_yade_interactions(options.contacts)) return read_yade_contacts(options, dimension);
  if (!on_stdin && is_mercurydpm_fstat(options.contacts)) return read_mercurydpm_contacts(options, dimension);
  const CsvTable table =
      CsvTable::read(options.contacts, wanted_names(contact_names(), options.contact_columns));
  if (remarks != nullptr && !table.description().empty())
    remarks->push_back(
        fmt::format("{}: read {}: {}", options.contacts, table.rows_in_words(), table.description()));
  return read_contacts(NamedColumns(table, options.contact_columns), dimension, options.units);
}

}  // namespace

std::optional<std::vector<ListedContact>> read_contact_file(const ImportOptions& options, int dimension,
                                                            std::optional<std::int64_t> timestep,
                                                            std::vector<std::string>* remarks) {
  check_contact_columns("--contact-columns", options.contact_columns);
  if (options.contacts.empty()) return std::nullopt;
  std::vector<ListedContact> contacts = read_listed(options, dimension, timestep, remarks);
  for (ListedContact& c : contacts) name_wall(options.wall_ids, c);
  return contacts;
}

std::vector<ListedContact> read_bond_file(const ImportOptions& options, int dimension) {
  if (options.bonds.empty()) return {};
  ImportOptions of_bonds = options;
  of_bonds.contacts = options.bonds;
  of_bonds.contact_columns.clear();
  std::vector<ListedContact> bonds = read_listed(of_bonds, dimension, {}, nullptr);
  for (ListedContact& bond : bonds) name_wall(options.wall_ids, bond);
  for (ListedContact& bond : bonds) bond.bond = true;
  return bonds;
}

}  // namespace floc
