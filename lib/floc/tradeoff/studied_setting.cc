#include "floc/tradeoff/studied_setting.h"

#include <fmt/format.h>

namespace floc {
namespace {

/// Builds the list of variants of a scene that a study compares.
class SettingList {
 public:
  explicit SettingList(const Scene& scene) { base_.numerical = NumericalSettings::of(scene.relaxation); }

  template <class Change>
  void add(const std::string& parameter, const std::string& value, const Change& change) {
    StudiedSetting setting = base_;
    setting.parameter = parameter;
    setting.value = value;
    change(setting);
    settings_.push_back(setting);
  }

  void add_numerical(const std::string& parameter, const std::string& value,
                     const NumericalSettings& numerical) {
    add(parameter, value, [&](StudiedSetting& s) { s.numerical = numerical; });
  }

  std::vector<StudiedSetting> take() { return std::move(settings_); }

 private:
  StudiedSetting base_;
  std::vector<StudiedSetting> settings_;
};

void add_together(SettingList& list) {
  const auto add = [&](const char* value, const NumericalSettings& s) {
    list.add_numerical("together", value, s);
  };
  add("coarse", {1e-2, 0.36, Finish::statics, 0.2});
  add("medium", {1e-4, 0.36, Finish::statics, 0.2});
  add("fine", {1e-5, 0.36, Finish::statics, 0.2});
  add("careful", {1e-4, 0.14, Finish::automatic, 1.0});
}

void add_moduli(SettingList& list) {
  const auto add = [&](const char* value, ModuliMethod method, double tolerance) {
    list.add("moduli", value, [&](StudiedSetting& s) {
      s.moduli.method = method;
      s.moduli.tolerance = tolerance;
    });
  };
  add("bounds", ModuliMethod::bounds, 1.0);
  add("iterative 1e-2", ModuliMethod::iterative, 1e-2);
  add("iterative 1e-6", ModuliMethod::iterative, 1e-6);
  add("single-factor 1e-6", ModuliMethod::single_factor, 1e-6);
  add("factor 1e-10", ModuliMethod::factor, 1e-10);
}

}  // namespace

NumericalSettings strict_settings() {
  return {1e-8, 0.07, Finish::automatic, 2.0};
}

std::vector<StudiedSetting> studied_settings(const Scene& scene) {
  SettingList list(scene);
  list.add_numerical("strict", "all", strict_settings());
  list.add("scene", "as it is", [](StudiedSetting&) {});
  add_moduli(list);
  add_together(list);
  using Setting = StudiedSetting;
  list.add("finish", "dynamic", [](Setting& s) { s.numerical.finish = Finish::dynamic; });
  list.add("finish", "static", [](Setting& s) { s.numerical.finish = Finish::statics; });
  // The tolerance is varied together with finish = "dynamic", which reaches equilibrium by motion alone. Newton steps
  // would reach a residual of 1e-8 with every tolerance.
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6, 1e-8})
    list.add("tolerance", fmt::format("{:.0e} dynamic", tolerance), [&](Setting& s) {
      s.numerical.tolerance = tolerance;
      s.numerical.finish = Finish::dynamic;
    });
  for (const double step : {0.28, 0.2, 0.1})
    list.add("time_step", fmt::format("{}", step), [&](Setting& s) { s.numerical.time_step = step; });
  for (const double patience : {0.2, 0.5, 2.0})
    list.add("patience", fmt::format("{}", patience), [&](Setting& s) { s.numerical.patience = patience; });
  for (const double factor : {5.0, 0.2})
    list.add("strain_rate_cap", fmt::format("{} times", factor),
             [&](Setting& s) { s.rate_cap_factor = factor; });
  for (const double factor : {10.0, 0.1})
    list.add("cell_mass", fmt::format("{} times", factor), [&](Setting& s) { s.cell_mass_factor = factor; });
  for (const int share : {4, 2})
    if (const int n = scene.grains.count / share; n >= 20)
      list.add("count", fmt::format("{}", n), [&](Setting& s) { s.n_grains = n; });
  return list.take();
}

}  // namespace floc
