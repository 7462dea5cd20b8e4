#!/usr/bin/env python3
"""Biaxial and oedometric tests on several samples: a row a test.

  study.py FLOC DIRECTORY biaxial|oedometer|curves [--seeds A..B] [--set KEY=VALUE ...]

biaxial runs data/scenes/biaxial_dense.toml and biaxial_loose.toml, to a strain of 25 % in steps of 1e-3, and writes
DIRECTORY/biaxial.csv. oedometer runs oedometer.toml, which stands beside this script, data/scenes/oedometer.toml with small
steps of unloading first, and writes DIRECTORY/oedometer.csv. curves consolidates the samples of oedometer.toml under the same
pressure on both axes to P* = 13.33, and in the oedometer to 133.3, and writes DIRECTORY/curves.csv, a row a state. Runs that
are there already are resumed or kept.
"""
import argparse
import csv
import io
import os
import statistics
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(HERE, "..", "..", "scenes")
STEADY = 0.20  # strain from which a test counts as steady
RISEN = 3.0    # factor on the driven stress from which K0 is looked at
CURVES = {     # what oedometer.toml is changed to
    "isotropic": ["--set", 'load.0.control="isotropic"', "--until", "26"],
    "oedometric": ["--set", "load.0.to=133.3", "--until", "34"],
}


def seeds(text):
    first, _, last = text.partition("..")
    return range(int(first), int(last or first) + 1)


def run(floc, scene, directory, *arguments):
    command = [floc, "run", scene, "-o", directory, "--threads", "1", "--resume", *arguments]
    done = subprocess.run(command, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: {done.stderr.strip().splitlines()[-1]}")
    with open(os.path.join(directory, "path.csv")) as file:
        return list(csv.DictReader(file))


def mean(rows, column):
    return statistics.mean(float(row[column]) for row in rows)


def biaxial_row(floc, directory, packing, seed, arguments):
    rows = run(floc, os.path.join(SCENES, f"biaxial_{packing}.toml"), directory, "--seed", str(seed), *arguments)
    test = [row for row in rows if row["control"] == "triaxial"]
    peak = max(test, key=lambda row: float(row["mobilised_friction"]))
    steady = [row for row in test if float(row["strain_2"]) >= STEADY]
    return {
        "packing": packing, "seed": seed, "phi": rows[0]["phi"], "peak_friction": peak["mobilised_friction"],
        "peak_strain": peak["strain_2"], "least_volumetric_strain": min(float(row["volumetric_strain"]) for row in test),
        "steady_friction": mean(steady, "mobilised_friction"), "steady_phi": mean(steady, "phi"), "steady_z": mean(steady, "z"),
        "steps": len(test), "static_steps": sum(row["ending"] == "static" for row in test),
        "polished_steps": sum(row["ending"] == "polished" for row in test),
    }


def stiffness_ratio(floc, state):
    """Lateral over driven stress that the moduli of a state give for a strain of the second axis."""
    out = subprocess.run([floc, "moduli", state, "--prestress", "--format", "csv", "--columns", "C22,C12"], capture_output=True,
                         text=True, check=True).stdout
    row = next(csv.DictReader(io.StringIO(out)))
    return float(row["C12"]) / float(row["C22"])


def oedometer_rows(floc, directory, seed, arguments):
    rows = run(floc, os.path.join(HERE, "oedometer.toml"), os.path.join(directory, "oedometer"), "--seed", str(seed), *arguments)
    first = float(rows[0]["stress_2"])
    load = [row for row in rows if row["branch"] == "load"]
    top = load[-1]
    unload = [row for row in rows if row["branch"] == "unload"]
    k0 = [float(row["K0"]) for row in load if float(row["stress_2"]) >= RISEN * first]
    found = {"seed": seed, "first_phi": rows[0]["phi"], "last_phi": top["phi"], "states": len(k0),
             "K0_mean": statistics.mean(k0), "K0_stddev": statistics.stdev(k0), "K0_top": top["K0"],
             "ratio_of_moduli": stiffness_ratio(floc, os.path.join(directory, "oedometer", top["state"]))}
    for k in range(3):
        change = [float(unload[k][f"stress_{axis}"]) - float(top[f"stress_{axis}"]) for axis in (1, 2)]
        found[f"driven_{k + 1}"] = float(unload[k]["stress_2"]) / float(top["stress_2"])
        found[f"ratio_{k + 1}"] = change[0] / change[1]
    found["K0_unloaded"] = unload[-1]["K0"]
    return found


def curve_rows(floc, directory, control, seed, arguments):
    rows = run(floc, os.path.join(HERE, "oedometer.toml"), directory, "--seed", str(seed), *CURVES[control], *arguments)
    return [{"control": control, "seed": seed, "P_star": row["stress_2"], "phi": row["phi"], "K0": row["K0"]}
            for row in rows if float(row["P_star"]) > 0.0]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("floc")
    parser.add_argument("directory")
    parser.add_argument("test", choices=["biaxial", "oedometer", "curves"])
    parser.add_argument("--seeds", type=seeds, default=range(1, 6))
    parser.add_argument("--set", action="append", default=[], dest="changes")
    options = parser.parse_args()
    floc, top = os.path.abspath(options.floc), os.path.abspath(options.directory)
    changes = [word for change in options.changes for word in ("--set", change)]
    found = []
    for seed in options.seeds:
        if options.test == "curves":
            for control in CURVES:
                found += curve_rows(floc, os.path.join(top, control, f"seed-{seed}"), control, seed, changes)
        elif options.test == "biaxial":
            for packing in ("dense", "loose"):
                found.append(biaxial_row(floc, os.path.join(top, packing, f"seed-{seed}"), packing, seed, changes))
        else:
            directory = os.path.join(top, f"seed-{seed}")
            found.append(oedometer_rows(floc, directory, seed, changes))
        print(found[-1], flush=True)
    with open(os.path.join(top, options.test + ".csv"), "w", newline="") as file:
        table = csv.DictWriter(file, list(found[0]))
        table.writeheader()
        table.writerows(found)


if __name__ == "__main__":
    main()
