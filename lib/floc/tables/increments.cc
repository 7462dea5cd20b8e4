#include "floc/tables/increments.h"

#include <fmt/format.h>

#include "floc/packing/body_name.h"
#include "floc/tables/column.h"

namespace floc {
namespace {

using Names = std::vector<std::string>;
using Values = std::vector<TableValue>;

template <int Dim>
Names column_names() {
  Names names{"file", "contact", "id1", "id2"};
  for (int a = 1; a <= Dim; ++a) names.push_back(fmt::format("image{}", a));
  names.emplace_back("distant");
  for (const char* step : {"isotropic", "deviatoric"}) {
    names.push_back(fmt::format("{}_normal", step));
    for (int a = 1; a <= Dim; ++a) names.push_back(fmt::format("{}_shear{}", step, a));
    if (Dim == 2) names.push_back(fmt::format("{}_rolling", step));
    for (int a = 1; Dim == 3 && a <= 3; ++a) names.push_back(fmt::format("{}_rolling{}", step, a));
    for (const char* what : {"energy", "rank", "in_95"}) names.push_back(fmt::format("{}_{}", step, what));
  }
  for (const char* what : {"dead_end", "backbone", "scalar_backbone"}) names.emplace_back(what);
  if (Dim == 3)
    for (const char* step : {"isotropic", "deviatoric"}) names.push_back(fmt::format("{}_twisting", step));
  return names;
}

/// Number of columns for each stress increment (isotropic or deviatoric) in a table of force increments. The columns
/// are: the normal force, the shear force, the rolling moment, the elastic energy, the rank of the contact by this
/// energy, and whether the contact is among the contacts that store 95 % of the energy.
template <int Dim>
constexpr int kStepColumns = 1 + Dim + kRotations<Dim> + 3;

/// Appends the cells for one stress increment, isotropic or deviatoric, to the row of a contact.
/// @param step  response of the network to the stress increment; if absent, the cells are empty
/// @param c     index of the contact in the network; -1 for a contact of a rattler, which is not in the network
template <int Dim>
void append_step(const std::optional<StepResponse<Dim>>& step, const ContactNetwork<Dim>& network, int c,
                 Values& values) {
  if (!step) {
    values.resize(values.size() + kStepColumns<Dim>);
    return;
  }
  if (c < 0) {
    values.resize(values.size() + kStepColumns<Dim> - 2, 0.0);
    values.emplace_back();
    values.emplace_back(false);
    return;
  }
  const ForceIncrement<Dim>& f = step->increments[c];
  const Vec<Dim> shear = network.contacts[c].frame.template rightCols<Dim - 1>() * f.shear;
  values.emplace_back(f.normal);
  for (int a = 0; a < Dim; ++a) values.emplace_back(shear[a]);
  for (int a = 0; a < kRotations<Dim>; ++a) values.emplace_back(f.rolling_moment[a]);
  values.emplace_back(step->energy[c]);
  values.emplace_back(std::int64_t{step->rank[c] + 1});
  values.emplace_back(step->rank[c] < step->n_holding);
}

/// Appends the increment of the twisting moment of a contact under one stress increment.
/// @param c  index of the contact in the network; -1 for a contact of a rattler, which is not in the network
template <int Dim>
void append_twisting(const std::optional<StepResponse<Dim>>& step, int c, Values& values) {
  if (!step)
    values.emplace_back();
  else
    values.emplace_back(c < 0 ? 0.0 : step->increments[c].twisting_moment);
}

}  // namespace

template <int Dim>
void add_increments(const std::string& file, const Packing<Dim>& packing, const ContactNetwork<Dim>& network,
                    const ContactMechanics<Dim>& mechanics, Table& table) {
  expect_columns(file, column_names<Dim>(), table);
  std::vector<int> in_network(packing.contacts.size(), -1);
  for (int c = 0; c < static_cast<int>(network.contacts.size()); ++c)
    in_network[network.contacts[c].source] = c;
  const BodyNumbers<Dim> numbers(packing);
  for (std::size_t k = 0; k < packing.contacts.size(); ++k) {
    const Contact<Dim>& contact = packing.contacts[k];
    const int c = in_network[k];
    Values values{file, static_cast<std::int64_t>(k), numbers.of(contact.i), numbers.of(contact.j)};
    for (int a = 0; a < Dim; ++a) values.emplace_back(std::int64_t{contact.image[a]});
    values.emplace_back(contact.distant);
    append_step(mechanics.isotropic, network, c, values);
    append_step(mechanics.deviatoric, network, c, values);
    values.emplace_back(c < 0 || mechanics.percolation.dead_end[c]);
    if (mechanics.backbone.empty())
      values.emplace_back();
    else
      values.emplace_back(c >= 0 && mechanics.backbone[c]);
    values.emplace_back(c >= 0 && mechanics.percolation.scalar_backbone[c]);
    if (Dim == 3)
      for (const auto* step : {&mechanics.isotropic, &mechanics.deviatoric}) append_twisting(*step, c, values);
    table.rows.push_back(std::move(values));
  }
}

template void add_increments(const std::string&, const Packing<2>&, const ContactNetwork<2>&,
                             const ContactMechanics<2>&, Table&);
template void add_increments(const std::string&, const Packing<3>&, const ContactNetwork<3>&,
                             const ContactMechanics<3>&, Table&);

}  // namespace floc
