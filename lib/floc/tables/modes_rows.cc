#include "floc/tables/modes_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "floc/elasticity/mechanisms.h"
#include "floc/elasticity/modes.h"
#include "floc/elasticity/moduli.h"
#include "floc/packing/require_elastic.h"
#include "floc/packing/require_periodic.h"
#include "floc/tables/equilibrium_warning.h"

namespace floc {
namespace {

void add_free_motions(const std::string& file, const FreeMotions& free, std::vector<ModeRow>& rows) {
  using Kind = std::pair<FreeMotionKind, const char*>;
  for (const auto& [kind, name] : std::array<Kind, 5>{{{FreeMotionKind::rattler, "rattler"},
                                                       {FreeMotionKind::translation, "translation"},
                                                       {FreeMotionKind::rotation, "rotation"},
                                                       {FreeMotionKind::roll, "roll"},
                                                       {FreeMotionKind::spin, "spin"}}}) {
    ModeRow row;
    row.file = file;
    row.kind = name;
    row.count = free.count(kind);
    if (row.count > 0) rows.push_back(row);
  }
}

void add_strain_mechanisms(const std::string& file, const StrainMechanisms& found, std::vector<ModeRow>& rows,
                           const Remarks& remarks) {
  for (Eigen::Index m = 0; m < found.strains.cols(); ++m) {
    ModeRow row;
    row.file = file;
    row.kind = "strain mechanism";
    row.eigenvalue = 0.0;
    row.strain = found.strains.col(m);
    rows.push_back(row);
  }
  if (!found.vanishing.empty())
    remarks.warn(
        file,
        fmt::format(
            "mechanisms let the cell change its shape without elastic energy, so these moduli are zero: {}",
            fmt::join(found.vanishing, ", ")));
}

template <int Dim>
void add_modes(const std::string& file, const Grains<Dim>& grains, const SoftModes<Dim>& soft,
               std::vector<ModeRow>& rows) {
  for (const Mode<Dim>& mode : soft.modes) {
    ModeRow row;
    row.file = file;
    row.kind = name_of(mode.kind);
    row.eigenvalue = mode.eigenvalue;
    row.with_prestress = mode.with_prestress;
    row.participation = mode.participation;
    row.softens_B = mode.softens_B;
    row.softens_G = mode.softens_G;
    row.coupling = mode.coupling;
    for (const int i : mode.grains) row.grains.push_back(grains.name(i));
    rows.push_back(row);
  }
}

template <int Dim>
std::vector<std::string> words_on(const ContactNetwork<Dim>& network, const Moduli& moduli,
                                  const SoftModes<Dim>& soft) {
  std::vector<std::string> words;
  if (moduli.response.n_mechanisms > 0)
    words.push_back(fmt::format(
        "the grains have {} mechanism(s): {} of them depend only on which grains are in contact, the others "
        "also depend on the positions of the grains",
        moduli.response.n_mechanisms, structural_mechanisms(network, StrainSet::diagonal).n_mechanisms));
  const int listed = static_cast<int>(std::count_if(soft.modes.begin(), soft.modes.end(),
                                                    [](const auto& m) { return m.kind != ModeKind::elastic; }));
  if (soft.n_below_near_bound > 0)
    words.push_back(
        fmt::format("{} mode(s) have eigenvalues below max |F_N|/r = {:.3g} (F_N: normal force, r: distance of "
                    "the centres), and {} of them are listed. They may be changed by prestress, the effect of "
                    "the contact forces on the stiffness: "
                    "without prestress B = {:.6g}, G = {:.6g}, with prestress B = {:.6g}, G = {:.6g}",
                    soft.n_below_near_bound, soft.near_bound, listed, *moduli.B_without_prestress,
                    *moduli.G_without_prestress, moduli.B, moduli.G));
  return words;
}

TableValue entry(const Eigen::VectorXd& values, int a) {
  if (a >= values.size()) return {};
  return values[a];
}

TableValue list(const std::vector<std::int64_t>& grains) {
  if (grains.empty()) return {};
  return fmt::format("{}", fmt::join(grains, " "));
}

}  // namespace

template <int Dim>
std::vector<std::string> add_modes_rows(const std::string& file, const State<Dim>& state,
                                        std::optional<int> count, std::vector<ModeRow>& rows,
                                        const Remarks& remarks) {
  const Packing<Dim>& packing = state.packing;
  require_periodic(packing, "modes are computed", file);
  require_elastic(packing, "modes are computed", file);
  warn_unless_in_equilibrium(file, state, remarks);
  ModuliOptions options;
  options.prestress = true;
  const ContactNetwork<Dim> network = options.loaded_network(packing);
  const Moduli moduli = elastic_moduli(packing, options);
  ModeOptions mode_options;
  mode_options.count = count;
  const SoftModes<Dim> soft = soft_modes(network, mode_options);
  add_free_motions(file, soft.free, rows);
  add_strain_mechanisms(file,
                        strain_mechanisms<Dim>(moduli.response, affine_stiffness(network, StrainSet::diagonal)),
                        rows, remarks);
  add_modes(file, packing.grains, soft, rows);
  if (!soft.complete)
    remarks.warn(
        file, "some modes of repeated eigenvalues may be missing in the list; another --count may find them");
  return words_on(network, moduli, soft);
}

std::vector<Column<ModeRow>> modes_columns(const std::vector<ModeRow>& rows) {
  int dimension = 2;
  for (const ModeRow& r : rows)
    dimension = std::max({dimension, static_cast<int>(r.coupling.size()), static_cast<int>(r.strain.size())});
  std::vector<Column<ModeRow>> columns{
      {"file", [](const ModeRow& r) { return r.file; }},
      {"kind", [](const ModeRow& r) { return r.kind; }},
      {"count", [](const ModeRow& r) { return r.count; }},
      {"eigenvalue", [](const ModeRow& r) { return or_undefined(r.eigenvalue); }},
      {"eigenvalue_prestress", [](const ModeRow& r) { return or_undefined(r.with_prestress); }},
      {"participation", [](const ModeRow& r) { return or_undefined(r.participation); }},
      {"softens_B", [](const ModeRow& r) { return or_undefined(r.softens_B); }},
      {"softens_G", [](const ModeRow& r) { return or_undefined(r.softens_G); }}};
  for (int a = 0; a < dimension; ++a)
    columns.emplace_back(fmt::format("coupling{}", a + 1),
                         [a](const ModeRow& r) { return entry(r.coupling, a); });
  for (int a = 0; a < dimension; ++a)
    columns.emplace_back(fmt::format("strain{}", a + 1), [a](const ModeRow& r) { return entry(r.strain, a); });
  columns.emplace_back("grains", [](const ModeRow& r) { return list(r.grains); });
  return columns;
}

template std::vector<std::string> add_modes_rows(const std::string&, const State<2>&, std::optional<int>,
                                                 std::vector<ModeRow>&, const Remarks&);
template std::vector<std::string> add_modes_rows(const std::string&, const State<3>&, std::optional<int>,
                                                 std::vector<ModeRow>&, const Remarks&);

}  // namespace floc
