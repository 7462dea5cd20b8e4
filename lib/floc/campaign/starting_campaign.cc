#include "floc/campaign/starting_campaign.h"

#include <fmt/format.h>

namespace floc {
namespace {

/// Doubled braces are those of TOML.
constexpr const char* kText =
    R"TOML(# A campaign to change: `floc campaign check` lists every fault, the runs and what they cost. Then
#
#   floc campaign plan {0}.toml -o {0}
#   cd {0} && snakemake --cores 4
#
# makes tables (runs.csv, means.csv, fits.csv, outcomes.csv) and a page (index.html).

[campaign]
name = "{0}"
scene = "{1}"                       # of all runs; keys below are changed in it as by floc run --set
seeds = "1..3"                      # samples of every case; or a list, [1, 2, 5]

[grid]                              # every combination of these values is a case
contact.friction.coefficient = [0.3, 0.5]
# contact.rolling.coefficient = [0.0, 0.005]

# Cases can be listed instead, or besides: each is combined with the grid.
# [[case]]
# name = "soft"                     # of its directory and curve; left out, its values are
# set = {{contact.normal.stiffness = 1e4, contact.friction.stiffness = 1e4}}

[[collect]]                         # columns of path.csv at all states: curves on the page
table = "path"
columns = ["phi", "z"]

[[collect]]                         # of floc moduli, network or structure: floc help columns lists them
table = "moduli"
columns = ["B", "G"]
states = {{branch = "load", P_star = [0.1, 1.334, 13.33]}}    # or "all", "last", {{step = [0, 5]}}
# options = ["--strains", "full"]   # of the command

[[collect]]                         # of floc compare: what became of one state in the others
table = "compare"
columns = ["kept_share"]
before = {{step = 1}}
states = {{branch = "load", P_star = 13.33}}

[[fit]]                             # of the samples of each case, and pooled: consolidation, elastic, preconsolidation
law = "consolidation"
# options = ["--law", "log"]

# Values to compare with: means agree where they differ by at most 2.6 sqrt(s^2/n + error^2/samples).
# [[reference]]
# of = "phi"                        # a column collected, or a parameter with fit = "consolidation"
# when = {{contact.friction.coefficient = 0.5}}               # left out: in all cases
# state = {{branch = "load", P_star = 13.33}}
# value = 0.772
# error = 0.004                     # standard deviation between so many samples; of one: the standard error
# samples = 4
# source = "Gilabert, Roux, Castellanos, PRE 78, 031305 (2008)"
)TOML";

}  // namespace

std::string starting_campaign(const std::string& name, const std::string& scene) {
  return fmt::format(fmt::runtime(kText), name, scene);
}

}  // namespace floc
