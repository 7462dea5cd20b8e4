#!/usr/bin/env python3
"""Packings of rigid grains at rest and at the critical state: a row a sample.

  study.py FLOC DIRECTORY [--only RUN,...] [--seeds A..B]

makes each run in DIRECTORY/RUN/seed-SEED. Runs that are there already are resumed or kept. Writes DIRECTORY/points.csv: for each sample
the means of columns of floc network over its states, and for packings at rest force_freedom of path.csv.
"""
import argparse
import csv
import glob
import os
import re
import statistics
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(HERE, "..", "..", "scenes")
CRITICAL = range(30, 61)  # states at strains from 0.6 to 1.2
AT_REST = range(1)
HULL = 'grains.shape={kind="hull", vertices=[12,24], aspect=1.4, count=60}'
CUBE = 'grains.shape={kind="box", sides=[1,1,1]}'
SMOOTH = "contact.friction.coefficient=0"
# The cell and the sweeps with which the polyhedra of points.csv were made; polyhedra.toml has others for its 20 000 grains.
HEAVY = ["cell.mass=1", "dynamics.max_sweeps=2000"]

# A fast shear, whose start need not be at rest
FROM_MOTION = ["load.0.inertial_number=0.1", "dynamics.gap_tolerance=0.1", 'dynamics.finish="none"', "equilibrium.force=0.2",
               "equilibrium.moment=0.2", "equilibrium.stress=0.1", "equilibrium.energy=0.01"]

# name of the run: scene, changes of the scene, numbers of the states whose means are a row (or of several such cases)
RUNS = {
    "polygons-5": ("pentagons", [], CRITICAL),
    "polygons-8": ("pentagons", ["grains.shape.sides=8"], CRITICAL),
    "polygons-20": ("pentagons", ["grains.shape.sides=20"], CRITICAL),
    **{f"rolling-{c}": ("rolling_shear", [f"contact.rolling.coefficient={c}"], CRITICAL) for c in ("0.001", "0.02", "0.05", "0.1", "0.2")},
    "span-0.2": ("wide_span", ["grains.count=1000", "grains.diameter.min=0.667"], CRITICAL),
    "span-0.2-10000": ("wide_span", ["grains.diameter.min=0.667"], CRITICAL),
    "span-0.6": ("wide_span", ["grains.count=1000", "grains.diameter.min=0.25"], CRITICAL),
    "span-0.6-10000": ("wide_span", ["grains.diameter.min=0.25"], CRITICAL),
    "span-0.9": ("wide_span", ["grains.count=1500", "grains.diameter.min=0.0526"], CRITICAL),
    **{f"span-0.9-rate-{i}": ("wide_span", ["grains.count=1500", "grains.diameter.min=0.0526", f"load.0.inertial_number={i}"], CRITICAL)
       for i in ("0.03", "0.054")},
    # A start at rest is not found: small disks keep leaving their places. Sheared states do not depend on it.
    "span-0.9-rate-0.1-10000": ("wide_span", ["grains.diameter.min=0.0526", *FROM_MOTION], CRITICAL),
    "span-0.96-rate-0.1-10000": ("wide_span", FROM_MOTION, CRITICAL),
    "spheres": ("rigid_spheres", ["grains.count=2000", "contact.friction.coefficient=0.5"], {"spheres-sheared": range(6, 11), "spheres": AT_REST}),
    "spheres-20000": ("rigid_spheres", ["contact.friction.coefficient=0.5"], AT_REST),
    "spheres-elastic": ("elastic_spheres", [], AT_REST),
    "cut": ("polyhedra", ["grains.count=1000", *HEAVY], AT_REST),
    "cut-5000": ("polyhedra", ["grains.count=5000", *HEAVY], AT_REST),
    "cut-20000": ("polyhedra", [], AT_REST),
    "hull": ("polyhedra", ["grains.count=1000", HULL, *HEAVY], AT_REST),
    "hull-5000": ("polyhedra", ["grains.count=5000", HULL, *HEAVY], AT_REST),
    "cubes": ("polyhedra", ["grains.count=1000", CUBE, *HEAVY], AT_REST),
    "cut-smooth": ("polyhedra", ["grains.count=300", SMOOTH, *HEAVY], AT_REST),
    "hull-smooth": ("polyhedra", ["grains.count=300", SMOOTH, HULL, *HEAVY], AT_REST),
}
KINDS = ["vertex_face", "edge_edge", "edge_face", "face_face"]
COLUMNS = (["phi", "z_star", "z_pairs_star", "x0", "below_mean", "alpha", "beta", "below_mean_pairs", "alpha_pairs", "beta_pairs"] +
           ["pairs_" + kind for kind in KINDS] + ["force_" + kind for kind in KINDS] +
           ["sliding_share", "stress_ratio", "stress_ratio_predicted", "a_normals", "a_normal_force", "a_tangential_force"])


def run(floc, name, seed, directory):
    scene, changes, states = RUNS[name]
    places = [os.path.join(folder, scene + ".toml") for folder in (HERE, SCENES)]
    command = [floc, "run", next(filter(os.path.exists, places)), "-o", directory, "--threads", "1", "--resume", "--seed", str(seed)]
    for change in changes:
        command += ["--set", change]
    if states == AT_REST:
        command += ["--until", "0"]
    if subprocess.run(command, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL).returncode != 0:
        sys.exit("failed: " + " ".join(command))


def table(floc, *arguments):
    text = subprocess.run([floc, *arguments, "--format", "csv"], stdout=subprocess.PIPE, check=True, text=True).stdout
    return list(csv.DictReader(text.splitlines()))


def mean(rows, column):
    values = [float(row[column]) for row in rows if row[column] not in ("", "nan")]
    return f"{statistics.fmean(values):.6g}" if values else ""


def points(floc, directory):
    name, seed = re.search(r"([^/]+)/seed-(\d+)$", directory).groups()
    cases = RUNS[name][2]
    for case, states in (cases if isinstance(cases, dict) else {name: cases}).items():
        rows = table(floc, "network", *[os.path.join(directory, f"state-{k:04}.h5") for k in states], "--columns", "all")
        with open(os.path.join(directory, "path.csv")) as file:
            freedom = next(csv.DictReader(file)).get("force_freedom", "") if states == AT_REST else ""
        yield [case, seed, rows[0]["n_grains"], *[mean(rows, column) for column in COLUMNS], freedom]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("floc")
    parser.add_argument("directory")
    parser.add_argument("--only", default=",".join(RUNS))
    parser.add_argument("--seeds", default="1..2")
    options = parser.parse_args()
    floc = os.path.abspath(options.floc) if os.sep in options.floc else options.floc
    first, _, last = options.seeds.partition("..")
    for name in options.only.split(","):
        for seed in range(int(first), int(last or first) + 1):
            run(floc, name, seed, os.path.join(options.directory, name, f"seed-{seed}"))
    with open(os.path.join(options.directory, "points.csv"), "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["case", "seed", "n_grains", *COLUMNS, "force_freedom"])
        for name in RUNS:
            found = glob.glob(os.path.join(options.directory, name, "seed-*"))
            rows = [row for directory in found for row in points(floc, directory)]
            out.writerows(sorted(rows, key=lambda row: (row[0] == name, int(row[1]))))


if __name__ == "__main__":
    main()
