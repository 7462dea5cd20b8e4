#include "floc/tables/structure_columns.h"

#include <fmt/format.h>

#include "floc/base/error.h"
#include "floc/tables/fit_parameters.h"

namespace floc {
namespace {

void append_parameter(int index, const std::string& name, std::vector<Column<StructureRow>>& columns) {
  const std::string parts[] = {"", "_stderr", "_low95", "_high95"};
  for (int part = 0; part < 4; ++part)
    columns.emplace_back(name + parts[part], [index, part](const StructureRow& r) {
      return r.fit && r.fit->found() ? parameter_cells(r.fit->parameters[index])[part] : TableValue{};
    });
}

}  // namespace

std::vector<Column<StructureRow>> structure_columns() {
  using Row = StructureRow;
  const auto maybe = [](const std::optional<std::int64_t>& n) { return n ? TableValue{*n} : TableValue{}; };
  std::vector<Column<Row>> columns = {{"file", [](const Row& r) { return r.file; }},
                                      {"dimension", [](const Row& r) { return count(r.dimension); }},
                                      {"n_grains", [](const Row& r) { return r.n_grains; }},
                                      {"P_star", [](const Row& r) { return r.reduced_pressure; }},
                                      {"phi", [](const Row& r) { return r.solid_fraction; }}};
  // The parameters of the fit to the scattered intensity are in the order I0, xi, dF.
  append_parameter(1, "xi", columns);
  append_parameter(2, "dF", columns);
  append_parameter(0, "I0", columns);
  const auto of_fit = [](auto value) {
    return [value](const Row& r) { return r.fit && r.fit->found() ? TableValue{value(*r.fit)} : TableValue{}; };
  };
  columns.emplace_back("fit_low", of_fit([](const ScatteringFit& f) { return f.low; }));
  columns.emplace_back("fit_high", of_fit([](const ScatteringFit& f) { return f.high; }));
  columns.emplace_back("fit_points", of_fit([](const ScatteringFit& f) { return count(f.n_points); }));
  columns.emplace_back("chi_square", of_fit([](const ScatteringFit& f) { return f.chi_square; }));
  // The columns about the mesh and the pores have values only for disks; the columns about the local solid fraction and
  // the voids only for spheres.
  columns.emplace_back("mesh_spacing", [](const Row& r) { return or_undefined(r.mesh_spacing); });
  for (const int a : {0, 1})
    columns.emplace_back(fmt::format("mesh{}", a + 1),
                         [a](const Row& r) { return r.mesh[a] > 0 ? count(r.mesh[a]) : TableValue{}; });
  columns.emplace_back("n_pores", [maybe](const Row& r) { return maybe(r.n_pores); });
  columns.emplace_back("pore_size", [](const Row& r) { return or_undefined(r.pore_size); });
  columns.emplace_back("pore_mean_area", [](const Row& r) { return or_undefined(r.pore_mean_area); });
  columns.emplace_back("pore_unbounded",
                       [](const Row& r) { return r.n_pores ? TableValue{r.unbounded} : TableValue{}; });
  columns.emplace_back("seconds", [](const Row& r) { return r.seconds; });
  const auto of_voids = [](auto value) {
    return [value](const Row& r) { return r.local ? TableValue{value(*r.local)} : TableValue{}; };
  };
  columns.emplace_back("local_phi_mean", of_voids([](const LocalStructure& l) { return l.mean; }));
  columns.emplace_back("local_phi_stddev", of_voids([](const LocalStructure& l) { return l.deviation; }));
  columns.emplace_back("n_voids", of_voids([](const LocalStructure& l) { return l.n_voids; }));
  columns.emplace_back("void_radius_mean", of_voids([](const LocalStructure& l) { return l.mean_void; }));
  columns.emplace_back("void_radius_largest", of_voids([](const LocalStructure& l) { return l.largest_void; }));
  columns.emplace_back("P_driven_star", [](const Row& r) { return r.reduced_driven_stress; });
  return columns;
}

Table structure_table(const AnyState& state, const StructureTableOptions& options, const std::string& file,
                      Series* further, const Remarks& remarks) {
  for (const std::string& fault : options.validate()) throw InputError("floc structure", "--" + fault);
  Series series;
  Series& kept = further == nullptr ? series : *further;
  const StructureRow row =
      std::visit([&](const auto& s) { return structure_row(file, s, options, kept, remarks); }, state);
  return to_table(structure_columns(), {row});
}

}  // namespace floc
