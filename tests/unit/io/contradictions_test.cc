#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "floc/base/error.h"
#include "floc/io/import.h"
#include "floc/io/law_text.h"
#include "support/run_program.h"

/// Tests of contradictory files in every format of grains and contacts. The message must name the contradiction.
/// Integers that are written as real numbers must be accepted.
namespace floc {
namespace {

using test::write_text;
using testing::AllOf;
using testing::HasSubstr;

// name and values of each column
using Columns = std::vector<std::pair<std::string, std::vector<std::string>>>;

std::string row_of(const Columns& columns, std::size_t row, const char* separator) {
  std::vector<std::string> cells;
  for (const auto& [name, values] : columns) cells.push_back(values[row]);
  return fmt::format("{}\n", fmt::join(cells, separator));
}
std::string names_of(const Columns& columns, const char* separator) {
  std::vector<std::string> names;
  for (const auto& [name, values] : columns) names.push_back(name);
  return fmt::format("{}", fmt::join(names, separator));
}
std::string rows_of(const Columns& columns, const char* separator) {
  std::string text;
  for (std::size_t row = 0; row < columns.front().second.size(); ++row) text += row_of(columns, row, separator);
  return text;
}

std::string csv_text(const Columns& columns) {
  return names_of(columns, ",") + "\n" + rows_of(columns, ",");
}
std::string dump_text(const Columns& columns, const char* items, const char* rows) {
  return fmt::format(
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF {}\n{}\nITEM: BOX BOUNDS pp pp pp\n0 4\n0 4\n0 4\nITEM: {} {}\n{}",
      items, columns.front().second.size(), rows, names_of(columns, " "), rows_of(columns, " "));
}
std::string atoms_text(const Columns& columns) {
  return dump_text(columns, "ATOMS", "ATOMS");
}
std::string entries_text(const Columns& columns) {
  return dump_text(columns, "ENTRIES", "ENTRIES");
}
std::string yade_text(const Columns& columns) {
  return "# cell 4 0 0 0 4 0 0 0 4\n# " + names_of(columns, " ") + "\n" + rows_of(columns, " ");
}
std::string interactions_text(const Columns& columns) {
  return "# " + names_of(columns, " ") + "\n" + rows_of(columns, " ");
}
std::string xyz_text(const Columns& columns) {
  std::string properties;
  for (const auto& [name, values] : columns) properties += fmt::format(":{}:R:1", name);
  return fmt::format("{}\nLattice=\"4 0 0 0 4 0 0 0 4\" Properties={}\n{}", columns.front().second.size(),
                     properties.substr(1), rows_of(columns, " "));
}
std::string vtu_text(const Columns& columns) {
  Columns points, data;
  for (const auto& column : columns)
    (column.first == "x" || column.first == "y" || column.first == "z" ? points : data).push_back(column);
  std::string arrays;
  for (const auto& [name, values] : data)
    arrays += fmt::format("<DataArray type=\"Float64\" Name=\"{}\" format=\"ascii\">{}</DataArray>\n", name,
                          fmt::join(values, " "));
  return fmt::format(
      "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><FieldData><DataArray type=\"Float64\" "
      "Name=\"cell\" "
      "format=\"ascii\">4 0 0 0 4 0 0 0 4</DataArray></FieldData><Piece "
      "NumberOfPoints=\"{}\"><Points><DataArray "
      "type=\"Float64\" NumberOfComponents=\"3\" "
      "format=\"ascii\">{}</DataArray></Points><PointData>{}</PointData>"
      "</Piece></UnstructuredGrid></VTKFile>",
      columns.front().second.size(), rows_of(points, " "), arrays);
}

struct GrainFormat {
  const char* keyword;
  std::string (*text)(const Columns&);
};
const GrainFormat kGrainFormats[] = {{"csv", csv_text},
                                     {"lammps-dump", atoms_text},
                                     {"yade", yade_text},
                                     {"extended-xyz", xyz_text},
                                     {"vtu", vtu_text}};
struct ContactFormat {
  const char* name;
  std::string (*text)(const Columns&);
};
const ContactFormat kContactFormats[] = {
    {"csv", csv_text}, {"dump local", entries_text}, {"interactions of YADE", interactions_text}};

const Columns kGrains = {{"id", {"7", "3"}}, {"x", {"1", "1.999"}},      {"y", {"1", "1"}},
                         {"z", {"1", "1"}},  {"radius", {"0.5", "0.5"}}, {"mass", {"1", "2"}}};
/// Contacts with the stiffnesses of the law; K_N = 1000 and an overlap of 0.001 give a force of 1.
const Columns kContacts = {{"id1", {"7"}},  {"id2", {"3"}}, {"kn", {"1000"}},
                           {"kt", {"800"}}, {"kr", {"20"}}, {"ktw", {"10"}}};

class Contradictions : public testing::Test {
 protected:
  Contradictions() {
    options_.law = parse_law(
        "",
        "normal.stiffness=1000,friction.coefficient=0.5,friction.stiffness=800,"
        "rolling.coefficient=0.1,rolling.stiffness=20,twisting.coefficient=0.1,twisting.stiffness=10");
    options_.dimension = 3;
  }

  /// Returns the message with which the reader refuses the grains, or an empty text if it accepts them.
  std::string fault_of(const std::string& keyword, const std::string& text) {
    write_text(scratch_.file("grains"), text);
    ImportOptions options = options_;
    if (keyword == "csv") options.cell = {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
    if (keyword == "jambashbulk") options = {};
    try {
      const Imported imported = find_import_format(keyword, "").read(scratch_.file("grains"), options);
      std::visit([](const auto& state) { EXPECT_EQ(state.packing.grains.size(), 2); }, imported.state);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }
  std::string fault_of_contacts(const std::string& text) {
    write_text(scratch_.file("contacts"), text);
    options_.contacts = scratch_.file("contacts");
    return fault_of("csv", csv_text(kGrains));
  }
  void refused(const std::string& fault, const testing::Matcher<std::string>& words) {
    EXPECT_THAT(fault, words);
    ++n_refused_;
  }
  void accepted(const std::string& fault) {
    EXPECT_EQ(fault, "");
    ++n_accepted_;
  }

  test::ScratchDirectory scratch_;
  ImportOptions options_;
  int n_refused_ = 0, n_accepted_ = 0;
};

Columns with(Columns columns, const std::string& name, const std::vector<std::string>& values) {
  for (auto& column : columns)
    if (column.first == name) {
      column.second = values;
      return columns;
    }
  columns.emplace_back(name, values);
  return columns;
}

TEST_F(Contradictions, OfGrainsAreRefusedInEveryFormat) {
  for (const GrainFormat& format : kGrainFormats) {
    SCOPED_TRACE(format.keyword);
    const std::string keyword = format.keyword;
    const auto fault = [&](const Columns& columns) { return fault_of(keyword, format.text(columns)); };
    accepted(fault(kGrains));
    // Adds a copy of each column, except in VTK, where positions have no names.
    for (const auto& column : kGrains) {
      if (keyword == "vtu" && column.second == kGrains[1].second) continue;
      if (keyword == "vtu" && column.first.size() == 1) continue;
      Columns twice = kGrains;
      twice.push_back(column);
      refused(fault(twice),
              AllOf(HasSubstr(column.first), testing::AnyOf(HasSubstr("both named"), HasSubstr("twice"))));
    }
    // Adds a second column for the size, `diameter` or `r`, besides `radius`.
    for (const char* size : {"diameter", "r"}) {
      const bool diameter = size == std::string("diameter");
      const auto both = [&](double radius) {
        return with(kGrains, size, {"1", fmt::format("{}", diameter ? 2 * radius : radius)});
      };
      Columns right = both(0.5);
      if (!diameter) right = with(right, size, {"0.5", "0.5"});
      accepted(fault(right));
      right.back().second[1] = diameter ? "1.000001" : "0.500001";
      accepted(fault(right));
      for (const char* wrong : {"0.9", "0.25", "1.001", "0.7"}) {
        right.back().second[1] = wrong;
        refused(fault(right), AllOf(HasSubstr("radius = 0.5"), HasSubstr(size), HasSubstr("contradict")));
      }
      options_.columns = {{"radius", "radius"}};
      accepted(fault(right));
      options_.columns = {{"diameter", diameter ? "diameter" : "r"}};
      accepted(fault(right));
      options_.columns.clear();
    }
    accepted(fault(with(kGrains, "id", {"7.000000000000000000e+00", "3.0"})));
    refused(fault(with(kGrains, "id", {"7.5", "3"})), testing::AnyOf(HasSubstr("integer"), HasSubstr("whole")));
  }
  fmt::print("{} formats of grains with columns: {} files refused, {} accepted\n", std::size(kGrainFormats),
             n_refused_, n_accepted_);
}

TEST_F(Contradictions, OfFilesWithFixedColumnsAreRefused) {
  const std::string data = "t\n\n2 atoms\n\n0 4 xlo xhi\n0 4 ylo yhi\n0 4 zlo zhi\n";
  const std::string atoms = "\nAtoms # sphere\n\n{} 1 1 1 1 1 1\n3 1 1 1 1.999 1 1\n";
  const auto with_id = [&](const std::string& id) { return fmt::format(fmt::runtime(atoms), id); };
  accepted(fault_of("lammps-data", data + with_id("7")));
  accepted(fault_of("lammps-data", data + with_id("7.0")));
  for (const char* line : {"2 atoms", "0 5 xlo xhi", "0 4 ylo yhi", "0 4 zlo zhi"})
    refused(fault_of("lammps-data", data + line + "\n" + with_id("7")), HasSubstr("is given twice"));
  refused(fault_of("lammps-data", data + with_id("7") + with_id("8")), HasSubstr("section Atoms occurs twice"));
  const std::string header = "N = 2 ,L1= { 4 , 0 } ,L2= { 0 , 4 } ,P0= 0.001";
  const std::string grains = "\n{\n1 , 1 , 0.5\n1.999 , 1 , 0.5\n}\n";
  accepted(fault_of("jambashbulk", header + grains));
  for (const char* again : {" ,N = 3", " ,L1= { 5 , 0 }", " ,L2= { 0 , 5 }", " ,P0= 0.002"})
    refused(fault_of("jambashbulk", header + again + grains), HasSubstr("is given twice"));
  refused(
      fault_of("extended-xyz",
               "2\nLattice=\"4 0 0 0 4 0 0 0 4\" Lattice=\"5 0 0 0 5 0 0 0 5\" Properties=pos:R:3:radius:R:1\n"
               "1 1 1 0.5\n1.999 1 1 0.5\n"),
      HasSubstr("Lattice: this key is given twice"));
  refused(fault_of("yade", "# cell 4 0 0 0 4 0 0 0 4\n# cell 5 0 0 0 5 0 0 0 5\n# x y z r\n1 1 1 0.5\n"),
          HasSubstr("the cell is given twice"));
  std::string dump = atoms_text(kGrains);
  dump.insert(dump.find("ITEM: ATOMS"), "ITEM: BOX BOUNDS pp pp pp\n0 5\n0 5\n0 5\n");
  refused(fault_of("lammps-dump", dump), HasSubstr("twice in one frame"));
  fmt::print("fixed columns and headers: {} files refused, {} accepted\n", n_refused_, n_accepted_);
}

TEST_F(Contradictions, OfContactsAreRefusedInEveryFormat) {
  for (const ContactFormat& format : kContactFormats) {
    SCOPED_TRACE(format.name);
    const bool yade = format.text == interactions_text;
    Columns right = kContacts;
    const std::string force = "1";  // K_N = 1000 times the overlap of 0.001
    if (yade)
      for (const auto& [name, value] : {std::pair{"fnx", force},
                                        {"fny", std::string("0")},
                                        {"fnz", std::string("0")},
                                        {"fsx", std::string("0")},
                                        {"fsy", std::string("0")},
                                        {"fsz", std::string("0")}})
        right.emplace_back(name, std::vector<std::string>{value});
    else
      right.emplace_back("normal_force", std::vector<std::string>{force});
    if (yade) right[3].first = "ks";
    const auto fault = [&](const Columns& columns) { return fault_of_contacts(format.text(columns)); };
    accepted(fault(right));
    for (const auto& column : right) {
      Columns twice = right;
      twice.push_back(column);
      refused(fault(twice), HasSubstr(fmt::format("both named \"{}\"", column.first)));
    }
    for (const char* name : {"kn", yade ? "ks" : "kt", "kr", "ktw"})
      for (const char* value : {"-1", "-1e5", "0"}) {
        const std::string said = fault(with(right, name, {value}));
        const bool normal = name == std::string("kn");
        if (!normal && value == std::string("0"))
          accepted(said);
        else
          refused(
              said,
              AllOf(HasSubstr(fmt::format("{} = {:g}", yade && name[1] == 's' ? "kt" : name, std::atof(value))),
                    HasSubstr("expected")));
      }
    accepted(fault(with(with(right, "id1", {"7.0"}), "id2", {"3.000e+00"})));
    refused(fault(with(right, "id1", {"7.2"})), AllOf(HasSubstr("id1 = \"7.2\""), HasSubstr("integer")));
    if (!yade) {
      const auto also = [&](double normal) {
        Columns columns = right;
        for (const auto& [axis, part] : {std::pair{1, -normal}, {2, 0.0}, {3, 0.0}})
          columns.emplace_back(fmt::format("force{}", axis), std::vector<std::string>{fmt::format("{}", part)});
        return columns;
      };
      accepted(fault(also(1)));
      refused(fault(also(2.0)),
              AllOf(HasSubstr("normal_force = 1"), HasSubstr("leave out one of these two forces")));
    }
  }
  fmt::print("{} formats of contacts: {} files refused, {} accepted\n", std::size(kContactFormats), n_refused_,
             n_accepted_);
}

}  // namespace
}  // namespace floc
