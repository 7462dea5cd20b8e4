#include "floc/tables/compare_rows.h"

#include <fmt/format.h>

#include <algorithm>

#include "floc/base/error.h"
#include "floc/packing/balance.h"
#include "floc/packing/equilibrium.h"
#include "floc/structure/contact_changes.h"
#include "floc/structure/rigid_clusters.h"

namespace floc {
namespace {

template <int Dim>
void add_displacements(const CompareRow& row, const Packing<Dim>& before, const ContactChanges<Dim>& changes,
                       const RigidClusters& rigid, Table& table) {
  std::vector<std::string> names = {"before", "after", "grain"};
  for (const char* vector : {"x", "u"})
    for (int a = 1; a <= Dim; ++a) names.push_back(fmt::format("{}{}", vector, a));
  names.emplace_back("rigid_cluster");
  expect_columns(row.after, names, table);
  for (int i = 0; i < row.n_grains; ++i) {
    std::vector<TableValue> values = {row.before, row.after, before.grains.name(i)};
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
    table.rows.push_back({row.before, row.after, change, before.grains.name(c.i), before.grains.name(c.j),
                          index(index_before), index(index_after)});
  };
  for (const KeptContact& k : changes.kept) add("kept", before.contacts[k.before], k.before, k.after);
  for (const int k : changes.lost) add("lost", before.contacts[k], k, -1);
  for (const int k : changes.gained) add("gained", after.contacts[k], -1, k);
}

}  // namespace

template <int Dim>
CompareRow compare_row(const std::string& old_file, const State<Dim>& before, const std::string& new_file,
                       const State<Dim>& after, const CompareTableOptions& options, CompareTables& side) {
  const Packing<Dim>&p = before.packing, &q = after.packing;
  if (const std::string fault = incomparable(p, q); !fault.empty())
    throw InputError(new_file, fmt::format("this state cannot be compared with {}: {}", old_file, fault));
  const ContactChanges<Dim> changes = contact_changes(p, q);
  const RigidClusters rigid = rigid_clusters(p, q, changes, options.rigid_tolerance);
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
  if (options.displacements) add_displacements(row, p, changes, rigid, side.displacements);
  if (options.contacts) add_contacts(row, p, q, changes, side.contacts);
  return row;
}

std::vector<Column<CompareRow>> compare_columns(const std::vector<CompareRow>& rows) {
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
  // One table may compare states in 2D and states in 3D. Rows of states in 2D leave the strain components of axis 3
  // empty.
  int dimension = 2;
  for (const Row& r : rows) dimension = std::max(dimension, static_cast<int>(r.strain.rows()));
  for (int a = 0; a < dimension; ++a)
    for (int b = a; b < dimension; ++b)
      columns.emplace_back(fmt::format("strain{}{}", a + 1, b + 1), [a, b](const Row& r) {
        return b < r.strain.rows() ? TableValue{r.strain(a, b)} : TableValue{};
      });
  return columns;
}

template CompareRow compare_row(const std::string&, const State<2>&, const std::string&, const State<2>&,
                                const CompareTableOptions&, CompareTables&);
template CompareRow compare_row(const std::string&, const State<3>&, const std::string&, const State<3>&,
                                const CompareTableOptions&, CompareTables&);

}  // namespace floc
