#include <filesystem>

#include "arguments.h"
#include "floc/base/error.h"
#include "floc/campaign/campaign_directory.h"
#include "floc/io/atomic_file.h"
#include "floc/planning/plans_of_scene.h"

namespace floc::python {
namespace {

/// Refuses to replace the scene file, or another file if the user does not allow it.
void require_output(const std::string& output, const std::string& scene, bool overwrite) {
  namespace fs = std::filesystem;
  if (output.empty() || !fs::exists(output)) return;
  if (fs::exists(scene) && fs::equivalent(output, scene))
    throw InputError(output, "this is the scene file, which the plan would replace: expected another name");
  if (!overwrite) throw InputError(output, "this file exists already; give overwrite=True to replace it");
}

/// Chooses plans for a scene, and writes the file of the best plan if `output` is not empty.
/// @return the table of the plans, and remarks about them
py::tuple plan(const std::string& scene, const std::vector<std::string>& changes, const std::string& prices,
               const std::string& budget, const std::vector<std::string>& want, const py::object& cores,
               const py::object& observables, const py::object& pilot, const std::string& output,
               const py::object& overwrite) {
  require_output(output, scene, flag_of("overwrite", overwrite));
  PlanWishes wishes{
      scene, changes, prices, budget, want, flag_of("pilot", pilot), 1, texts_of("observables", observables)};
  wishes.cores = whole_of("cores", cores, PlanRequest::kCores);
  std::vector<std::string> remarks;
  const Table table = without_gil([&] {
    try {
      const PlansOfScene plans(wishes, [&](const std::string& remark) { remarks.push_back(remark); });
      if (!output.empty()) write_bytes_atomically(output, plans.file(output));
      return plans.table();
    } catch (const NoResult& error) {
      throw NumericalError(scene + ": " + error.what());
    }
  });
  return py::make_tuple(to_python(table), remarks);
}

py::tuple check(const std::string& directory) {
  return to_python(without_gil([&] {
    const auto [campaign, plans] = campaign_of(directory);
    return check_table(check_plan(campaign, plans, directory));
  }));
}

}  // namespace

void bind_plan(py::module_& module) {
  module.def("plan", &plan, py::arg("scene"), py::kw_only(), py::arg("changes"), py::arg("prices"),
             py::arg("budget"), py::arg("want"), py::arg("cores"), py::arg("observables"), py::arg("pilot"),
             py::arg("output"), py::arg("overwrite"));
  module.def("check_plan", &check, py::arg("directory"));
}

}  // namespace floc::python
