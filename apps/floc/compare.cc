#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>

#include "columns.h"
#include "command.h"
#include "compare_runs.h"
#include "floc/base/error.h"
#include "floc/packing/balance.h"
#include "floc/packing/equilibrium.h"
#include "floc/structure/contact_changes.h"
#include "floc/structure/rigid_clusters.h"
#include "output.h"
#include "run_states.h"

namespace floc {
namespace {

struct CompareCommand {
  std::vector<std::string> files;
  bool against_first = false;
  double rigid_tolerance = 0.01;
  std::string displacements;  ///< file for a row a grain; empty: none
  std::string contacts;       ///< file for a row a contact; empty: none
  std::string format;
};

/// One row: what happened between two states.
struct CompareRow {
  std::string before, after;
  int n_grains = 0;
  double pressure[2] = {}, solid_fraction[2] = {};  ///< before, after; pressures reduced
  int n_before = 0, n_after = 0, n_kept = 0, n_lost = 0, n_gained = 0, n_parted = 0;
  Eigen::MatrixXd strain;  ///< of the cell, shortening positive
  double rms = 0.0, largest = 0.0;
  int n_clusters = 0, n_clustered = 0, largest_cluster = 0;
};

struct SideTables {
  Table displacements, contacts;
};

template <int Dim>
void add_displacements(const CompareRow& row, const Packing<Dim>& before, const ContactChanges<Dim>& changes,
                       const RigidClusters& rigid, Table& table) {
  std::vector<std::string> names = {"before", "after", "grain"};
  for (const char* vector : {"x", "u"})
    for (int a = 1; a <= Dim; ++a) names.push_back(fmt::format("{}{}", vector, a));
  names.emplace_back("rigid_cluster");
  expect_columns(row.after, names, table);
  for (int i = 0; i < row.n_grains; ++i) {
    std::vector<TableValue> values = {row.before, row.after, count(i)};
    for (int a = 0; a < Dim; ++a) values.emplace_back(before.grains.position[i][a]);
    for (int a = 0; a < Dim; ++a) values.emplace_back(changes.displacement[i][a]);
    values.push_back(rigid.cluster[i] < 0 ? TableValue{} : count(rigid.cluster[i]));
    table.rows.push_back(std::move(values));
  }
}

template <int Dim>
void add_contacts(const CompareRow& row, const Packing<Dim>& before, const Packing<Dim>& after,
                  const ContactChanges<Dim>& changes, Table& table) {
  expect_columns(row.after, {"before", "after", "change", "id1", "id2", "contact_before", "contact_after"},
                 table);
  const auto add = [&](const char* change, const Contact<Dim>& c, int index_before, int index_after) {
    const auto index = [](int k) { return k < 0 ? TableValue{} : count(k); };
    table.rows.push_back(
        {row.before, row.after, change, count(c.i), count(c.j), index(index_before), index(index_after)});
  };
  for (const KeptContact& k : changes.kept) add("kept", before.contacts[k.before], k.before, k.after);
  for (const int k : changes.lost) add("lost", before.contacts[k], k, -1);
  for (const int k : changes.gained) add("gained", after.contacts[k], -1, k);
}

template <int Dim>
CompareRow compare_row(const std::string& old_file, const State<Dim>& before, const std::string& new_file,
                       const State<Dim>& after, const CompareCommand& command, SideTables& side) {
  const Packing<Dim>&p = before.packing, &q = after.packing;
  if (const std::string fault = incomparable(p, q); !fault.empty())
    throw InputError(new_file, fmt::format("against {}: {}", old_file, fault));
  const ContactChanges<Dim> changes = contact_changes(p, q);
  const RigidClusters rigid = rigid_clusters(p, q, changes, command.rigid_tolerance);
  CompareRow row;
  row.before = old_file;
  row.after = new_file;
  row.n_grains = p.grains.size();
  for (const int k : {0, 1}) {
    const Packing<Dim>& packing = k == 0 ? p : q;
    row.pressure[k] = reduced_pressure(packing, static_stress(packing).trace() / Dim);
    row.solid_fraction[k] = solid_fraction(packing);
  }
  row.n_before = changes.n_before();
  row.n_after = changes.n_after();
  row.n_kept = static_cast<int>(changes.kept.size());
  row.n_lost = static_cast<int>(changes.lost.size());
  row.n_gained = static_cast<int>(changes.gained.size());
  row.n_parted = changes.n_parted;
  const Mat<Dim> F = changes.deformation;
  row.strain = Mat<Dim>::Identity() - 0.5 * (F + F.transpose());
  row.rms = changes.rms_displacement();
  row.largest = changes.largest_displacement();
  row.n_clusters = static_cast<int>(rigid.size.size());
  row.n_clustered = rigid.n_clustered();
  if (!rigid.size.empty()) row.largest_cluster = rigid.size.front();
  if (!command.displacements.empty()) add_displacements(row, p, changes, rigid, side.displacements);
  if (!command.contacts.empty()) add_contacts(row, p, q, changes, side.contacts);
  return row;
}

std::vector<Column<CompareRow>> columns_for(const std::vector<CompareRow>& rows) {
  using Row = CompareRow;
  const auto share = [](int part, int whole) {
    return whole == 0 ? TableValue{} : TableValue{static_cast<double>(part) / whole};
  };
  std::vector<Column<Row>> columns = {
      {"before", [](const Row& r) { return r.before; }},
      {"after", [](const Row& r) { return r.after; }},
      {"n_grains", [](const Row& r) { return count(r.n_grains); }},
      {"P_star_before", [](const Row& r) { return r.pressure[0]; }},
      {"P_star_after", [](const Row& r) { return r.pressure[1]; }},
      {"phi_before", [](const Row& r) { return r.solid_fraction[0]; }},
      {"phi_after", [](const Row& r) { return r.solid_fraction[1]; }},
      {"n_before", [](const Row& r) { return count(r.n_before); }},
      {"n_after", [](const Row& r) { return count(r.n_after); }},
      {"n_kept", [](const Row& r) { return count(r.n_kept); }},
      {"n_lost", [](const Row& r) { return count(r.n_lost); }},
      {"n_gained", [](const Row& r) { return count(r.n_gained); }},
      {"n_parted", [](const Row& r) { return count(r.n_parted); }},
      {"kept_share", [share](const Row& r) { return share(r.n_kept, r.n_before); }},
      {"kept_share_after", [share](const Row& r) { return share(r.n_kept, r.n_after); }},
      {"lost_share", [share](const Row& r) { return share(r.n_lost, r.n_before); }},
      {"gained_share", [share](const Row& r) { return share(r.n_gained, r.n_after); }},
      {"displacement_rms", [](const Row& r) { return r.rms; }},
      {"displacement_largest", [](const Row& r) { return r.largest; }},
      {"n_rigid", [](const Row& r) { return count(r.n_clusters); }},
      {"rigid_share", [share](const Row& r) { return share(r.n_clustered, r.n_grains); }},
      {"rigid_largest", [](const Row& r) { return count(r.largest_cluster); }}};
  int dimension = 2;
  for (const Row& r : rows) dimension = std::max(dimension, static_cast<int>(r.strain.rows()));
  for (int a = 0; a < dimension; ++a)
    for (int b = a; b < dimension; ++b)
      columns.emplace_back(fmt::format("strain{}{}", a + 1, b + 1), [a, b](const Row& r) {
        return b < r.strain.rows() ? TableValue{r.strain(a, b)} : TableValue{};
      });
  return columns;
}

/// Two directories are two runs, to be compared step by step; the states of one follow each other.
bool are_two_runs(const std::vector<std::string>& inputs) {
  return inputs.size() == 2 && std::ranges::all_of(inputs, [](const std::string& input) {
           return input != "-" && std::filesystem::is_directory(input);
         });
}

int run_compare(const CompareCommand& command) {
  if (are_two_runs(command.files)) return compare_runs(command.files[0], command.files[1], command.format);
  if (command.files.size() == 1 && !std::filesystem::is_directory(command.files.front())) {
    std::cerr << "floc: compare takes two states or more, or a directory of floc run\n";
    return kUsage;
  }
  std::vector<CompareRow> rows;
  SideTables side;
  std::optional<std::pair<std::string, AnyState>> reference;
  const int code = for_each_file(states_of_inputs(command.files), [&](const std::string& file) {
    // A state that cannot be read has no successor either, unless all are held against the first.
    std::optional<std::pair<std::string, AnyState>> before = reference;
    if (!command.against_first) reference.reset();
    std::pair<std::string, AnyState> now(file, read_state(file));
    if (!reference) reference = now;
    if (!before) return int{kDone};
    std::visit(
        [&]<int Old, int New>(const State<Old>& p, const State<New>& q) {
          if constexpr (Old != New) {
            throw InputError(file, fmt::format("is {}D, and {} is {}D", New, before->first, Old));
          } else {
            rows.push_back(compare_row(before->first, p, file, q, command, side));
          }
        },
        before->second, now.second);
    return int{kDone};
  });
  if (!command.displacements.empty()) write_csv(command.displacements, side.displacements);
  if (!command.contacts.empty()) write_csv(command.contacts, side.contacts);
  print_table(to_table(columns_for(rows), rows), command.format);
  return code;
}

}  // namespace

Command add_compare(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "compare",
      "Tell what changed between states of the same grains: contacts kept, lost, gained; displacements");
  const auto command = std::make_shared<CompareCommand>();
  app.add_option("STATE", command->files,
                 "state files or a directory of floc run, each state compared with the one before it; or two "
                 "directories, compared step by step")
      .required();
  app.add_flag("--against-first", command->against_first, "compare each with the first instead");
  app.add_option("--rigid-tolerance", command->rigid_tolerance,
                 "a contact in which nothing moved: its two points are within this, in largest diameters, and "
                 "the grains "
                 "turned alike to within this, in radians")
      .positive()
      .show_default();
  app.add_option("--displacements", command->displacements,
                 "file for a row a grain: place before, displacement without its affine part, rigid cluster");
  app.add_option("--contacts", command->contacts, "file for a row a contact: kept, lost or gained");
  add_format_option(app, command->format);
  return {app, [command] { return run_compare(*command); }};
}

}  // namespace floc
