#!/usr/bin/env python3
"""Load paths of loose cohesive packings that collapse on softer springs: a row a path.

  study.py FLOC DIRECTORY [--seeds A..B] [--softening S,...] [--patience P] [--masses own|equal] [--count N]

runs path.toml in DIRECTORY/soft-S/patience-P/masses-M/seed-SEED, once for each S, five factors by which springs are softer (1: as they
are), such as 10-10-1-1-1: in the assembly, up to P* = 0.1, up to 0.316, up to 1, and beyond. Computes the moduli at P* = 1 and 13.33. Runs
that are there already are resumed or kept. Writes DIRECTORY/points.csv.
"""
import argparse
import csv
import glob
import os
import re
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
SCENE = os.path.join(HERE, "path.toml")
STEPS = {"0.01": 1, "0.1": 9, "1": 17, "13.33": 26}  # number of the state at each P*
PARTS = ["assembly", "to_0.1", "to_0.316", "to_1", "beyond"]
KEYS = ["assembly.softening"] + [f"load.{stage}.softening" for stage in range(4)]
COLUMNS = (PARTS + ["patience", "seed"] + ["Phi_" + p for p in STEPS] + ["z_" + p for p in STEPS] +
           ["B_1", "B_13.33", "million_steps", "masses"])


def run(floc, scene, directory, seed, changes):
    command = [floc, "run", scene, "-o", directory, "--threads", "1", "--resume", "--seed", str(seed)]
    for change in changes:
        command += ["--set", change]
    if subprocess.run(command, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL).returncode != 0:
        sys.exit("failed: " + " ".join(command))


def path_of(directory):
    """Rows of path.csv by the number of the state."""
    with open(os.path.join(directory, "path.csv")) as file:
        return {int(row["step"]): row for row in csv.DictReader(file)}


def moduli(floc, directory, numbers):
    """Rows of floc moduli of some states of a run."""
    states = [os.path.join(directory, f"state-{k:04}.h5") for k in numbers]
    table = subprocess.run([floc, "moduli", *states, "--format", "csv"], stdout=subprocess.PIPE, check=True, text=True).stdout
    return list(csv.DictReader(table.splitlines()))


def point(floc, directory):
    factors, patience, masses, seed = re.search(r"soft-([^/]+)/patience-([^/]+)/masses-([^/]+)/seed-(\d+)$", directory).groups()
    rows = path_of(directory)
    ends = [rows[step] for step in STEPS.values()]
    bulk = [row["B"] for row in moduli(floc, directory, [STEPS["1"], STEPS["13.33"]])]
    return (factors.split("-") + [patience, seed] + [row["phi"] for row in ends] + [row["z"] for row in ends] + bulk +
            [f"{int(ends[-1]['n_steps']) / 1e6:g}", masses])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("floc")
    parser.add_argument("directory")
    parser.add_argument("--seeds", default="1..24")
    parser.add_argument("--softening", default="1-1-1-1-1,10-10-1-1-1")
    parser.add_argument("--patience", default="1")
    parser.add_argument("--masses", default="own", choices=["own", "equal"])
    parser.add_argument("--count", default="1400")
    options = parser.parse_args()
    floc = os.path.abspath(options.floc) if os.sep in options.floc else options.floc
    first, _, last = options.seeds.partition("..")
    for seed in range(int(first), int(last or first) + 1):
        for factors in options.softening.split(","):
            changes = [f"{key}={factor}" for key, factor in zip(KEYS, factors.split("-"), strict=True)]
            changes += [f"equilibrium.patience={options.patience}", f"equilibrium.masses={options.masses}", f"grains.count={options.count}"]
            place = os.path.join(options.directory, f"soft-{factors}", f"patience-{options.patience}", f"masses-{options.masses}", f"seed-{seed}")
            run(floc, SCENE, place, seed, changes)
    points = [point(floc, d) for d in glob.glob(os.path.join(options.directory, "soft-*", "patience-*", "masses-*", "seed-*"))]
    with open(os.path.join(options.directory, "points.csv"), "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        table.writerows(sorted(points, key=lambda p: (p[-1] == "equal", [float(x) for x in p[:len(PARTS) + 2]])))


if __name__ == "__main__":
    main()
