#include "floc/campaign/starting_campaign.h"

#include <fmt/format.h>

namespace floc {
namespace {

/// Format string for the text of a campaign file, with {0} for the name of the campaign and {1} for the name of the
/// scene file. Braces of TOML are therefore doubled.
constexpr const char* kText =
    R"TOML(# A campaign to start from. `floc campaign check` lists errors, runs and expected cost. The commands
#
#   floc campaign plan {0}.toml -o {0}
#   cd {0} && snakemake --cores 4
#
# make its runs, tables (runs.csv, means.csv, fits.csv, outcomes.csv) and an html page (index.html).

[campaign]
name = "{0}"
scene = "{1}"                       # scene file of all runs; each case below changes keys of it
seeds = "1..3"                      # seeds, each of which gives a sample of every case; or a list, [1, 2, 5]

[grid]                              # keys of the scene; every combination of these values is a case
contact.friction.coefficient = [0.3, 0.5]
# contact.rolling.coefficient = [0.0, 0.005]

# Cases can also be listed; each listed case is combined with all values of the grid.
# [[case]]
# name = "soft"                     # name of its directory and its curve; if left out, made of its values
# set = {{contact.normal.stiffness = 1e4, contact.friction.stiffness = 1e4}}

[[collect]]                         # columns of path.csv at all states, drawn as curves on the page
table = "path"
columns = ["phi", "z"]

[[collect]]                         # columns of floc moduli, network or structure; floc help columns lists them
table = "moduli"
columns = ["B", "G"]
states = {{branch = "load", P_star = [0.1, 1.334, 13.33]}}    # or "all", "last", {{step = [0, 5]}}
# options = ["--strains", "full"]   # options of the command, here floc moduli

[[collect]]                         # columns of floc compare: changes from the state `before` to the other states
table = "compare"
columns = ["kept_share"]
before = {{step = 1}}
states = {{branch = "load", P_star = 13.33}}

[[fit]]                             # fit to the samples of each case
law = "consolidation"               # or elastic, preconsolidation, strength
# options = ["--law", "log"]

# A reference value. A mean of n samples with standard deviation s agrees with it if they differ by at most
# 2.6 sqrt(s^2/n + error^2/samples).
# [[reference]]
# of = "phi"                        # a collected column, or (with fit = "consolidation") a parameter of the fit
# when = {{contact.friction.coefficient = 0.5}}               # cases to compare; if left out, all
# state = {{branch = "load", P_star = 13.33}}
# value = 0.772
# error = 0.004                     # standard deviation of the reference samples; for a single one its standard error
# samples = 4                       # number of reference samples
# source = "Gilabert, Roux, Castellanos, PRE 78, 031305 (2008)"
)TOML";

}  // namespace

std::string starting_campaign(const std::string& name, const std::string& scene) {
  return fmt::format(fmt::runtime(kText), name, scene);
}

}  // namespace floc
