#!/usr/bin/env python3
"""Cycles of glass beads with the settings of spheres_a.toml, and with fast ones: a row a cycle.

  beads.py FLOC DIRECTORY [--seeds A..B] [--count N]

runs data/scenes/spheres_a.toml in DIRECTORY/as_it_is/seed-SEED and with the changes FAST in DIRECTORY/fast/seed-SEED. Runs that are there
already are resumed or kept. Writes DIRECTORY/beads.csv: Phi, z and the bulk modulus B (Pa) at 10 kPa, at 100 MPa and back at 10 kPa, and the
time steps of the first compression and of the whole cycle.
"""
import argparse
import csv
import glob
import os
import re

from study import moduli, path_of, run

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scenes", "spheres_a.toml")
FAST = ["assembly.softening=100", "assembly.time_step=0.72", "contact.damping.critical_fraction=0.3", "equilibrium.patience=0.1",
        "load.0.cell_mass=0.03", "load.1.cell_mass=0.03"]
STATES = {"10kPa": 0, "100MPa": 8, "back": 16}  # number of the state at each pressure
COLUMNS = ["settings", "seed", "n_grains", *[f"{q}_{p}" for p in STATES for q in ("Phi", "z", "B")], "steps_first", "steps"]


def row(floc, directory):
    settings, seed = re.search(r"([^/]+)/seed-(\d+)$", directory).groups()
    path = path_of(directory)
    rows = moduli(floc, directory, STATES.values())
    values = [x for k, m in zip(STATES.values(), rows, strict=True) for x in (path[k]["phi"], path[k]["z"], m["B"])]
    return [settings, seed, rows[0]["n_grains"], *values, path[0]["n_steps"], path[max(STATES.values())]["n_steps"]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("floc")
    parser.add_argument("directory")
    parser.add_argument("--seeds", default="1..24")
    parser.add_argument("--count", default="1000")
    options = parser.parse_args()
    floc = os.path.abspath(options.floc) if os.sep in options.floc else options.floc
    first, _, last = options.seeds.partition("..")
    for seed in range(int(first), int(last or first) + 1):
        for settings, changes in {"as_it_is": [], "fast": FAST}.items():
            run(floc, SCENE, os.path.join(options.directory, settings, f"seed-{seed}"), seed, [f"grains.count={options.count}", *changes])
    rows = [row(floc, directory) for directory in glob.glob(os.path.join(options.directory, "*", "seed-*"))]
    with open(os.path.join(options.directory, "beads.csv"), "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        table.writerows(sorted(rows, key=lambda r: (r[0], int(r[1]))))


if __name__ == "__main__":
    main()
