#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "floc/io/table.h"
#include "floc/planning/plan.h"
#include "floc/planning/plan_check.h"
#include "floc/planning/plan_file.h"
#include "floc/scene/scene.h"

namespace floc {

/// A scene file, and the wishes of a user for plans of this scene.
struct PlanWishes {
  std::string scene;                   ///< path of the scene file
  std::vector<std::string> overrides;  ///< texts "key.path=value" that change the scene, see read_scene()
  std::string prices;                  ///< file of a table of prices; empty: the table shipped with floc
  std::string budget;                  ///< time that may be spent, see duration_of(); empty: no budget
  std::vector<std::string> wants;      ///< wanted errors, see wants_of()
  bool pilot = false;                  ///< whether small samples of the scene are run first, see run_pilot()
  int cores = 1;
  std::vector<std::string> observables;  ///< see PlanRequest::observables
};

/// Plans for a scene: the scene, the model of its prices, and the best plans.
class PlansOfScene {
 public:
  using Remark = std::function<void(const std::string&)>;

  /// Reads the scene and its prices, runs a pilot if the user requests it, and chooses the plans.
  /// @param tell  function that takes remarks, such as the measurements of a pilot
  /// @throws InputError as choose_plans(); also in three other cases: neither a budget nor a wanted error is given; the
  /// scene has faults, contains numerical settings or starts from a saved packing; or no table of prices applies and no
  /// pilot is requested
  PlansOfScene(PlanWishes wishes, const Remark& tell);
  // A PlansOfScene cannot be copied, because it contains references between its members: from the model to the scene,
  // and from the plans to rows of the table in the model.
  PlansOfScene(const PlansOfScene&) = delete;
  PlansOfScene& operator=(const PlansOfScene&) = delete;

  const Plan& best() const { return choice_.plans.front(); }

  /// Returns the table of `floc plan`: a row for each plan and observable.
  Table table() const;
  /// Returns the text of the file of the best plan, see plan_file().
  std::string file(const std::string& output) const;

 private:
  PriceModel make_model(const Remark& tell);
  PlanChoice choose();
  PlanSource source() const { return {wishes_.scene, wishes_.overrides, prices_, request_.cores}; }

  PlanWishes wishes_;
  PlanRequest request_;
  Scene scene_;
  std::string prices_;  ///< source of the prices in words: a table of prices or a pilot
  PriceModel model_;
  PlanChoice choice_;
};

/// Returns the table of `floc plan --check`.
Table check_table(const std::vector<PlanCheck>& checks);

}  // namespace floc
