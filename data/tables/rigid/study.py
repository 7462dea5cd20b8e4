#!/usr/bin/env python3
"""Packings of rigid grains at rest and at the critical state: a row a sample.

  study.py FLOC DIRECTORY [--only CASE,...] [--seeds A..B]

runs each case in DIRECTORY/CASE/seed-SEED. Runs that are there already are resumed or kept. Writes DIRECTORY/points.csv: for each sample
the means of columns of floc network and floc verify over its states.
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

# name of the case: scene, changes of the scene, numbers of the states
CASES = {
    "polygons-5": ("pentagons", [], CRITICAL),
    "polygons-8": ("pentagons", ["grains.shape.sides=8"], CRITICAL),
    "polygons-20": ("pentagons", ["grains.shape.sides=20"], CRITICAL),
    **{f"rolling-{c}": ("rolling_shear", [f"contact.rolling.coefficient={c}"], CRITICAL) for c in ("0.001", "0.02", "0.05", "0.1", "0.2")},
    "span-0.2": ("wide_span", ["grains.count=1000", "grains.diameter.min=0.667"], CRITICAL),
    "span-0.6": ("wide_span", ["grains.count=1000", "grains.diameter.min=0.25"], CRITICAL),
    "span-0.9": ("wide_span", ["grains.count=1500", "grains.diameter.min=0.0526"], CRITICAL),
    "spheres-sheared": ("rigid_spheres", ["grains.count=2000", "contact.friction.coefficient=0.5"], range(6, 11)),
    "spheres": ("rigid_spheres", ["grains.count=2000", "contact.friction.coefficient=0.5"], AT_REST),
    "cut": ("polyhedra", ["grains.count=1000"], AT_REST),
    "hull": ("polyhedra", ["grains.count=1000", HULL], AT_REST),
    "cubes": ("polyhedra", ["grains.count=1000", CUBE], AT_REST),
    "cut-smooth": ("polyhedra", ["grains.count=300", SMOOTH], AT_REST),
    "hull-smooth": ("polyhedra", ["grains.count=300", SMOOTH, HULL], AT_REST),
}
KINDS = ["vertex_face", "edge_edge", "edge_face", "face_face"]
COLUMNS = (["phi", "z_star", "z_pairs_star", "x0", "below_mean", "alpha", "beta", "below_mean_pairs", "alpha_pairs", "beta_pairs"] +
           ["pairs_" + kind for kind in KINDS] + ["force_" + kind for kind in KINDS] +
           ["sliding_share", "stress_ratio", "stress_ratio_predicted", "a_normals", "a_normal_force", "a_tangential_force"])


def run(floc, case, seed, directory):
    scene, changes, _ = CASES[case]
    command = [floc, "run", os.path.join(SCENES, scene + ".toml"), "-o", directory, "--threads", "1", "--resume", "--seed", str(seed)]
    for change in changes:
        command += ["--set", change]
    if subprocess.run(command, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL).returncode != 0:
        sys.exit("failed: " + " ".join(command))


def table(floc, *arguments):
    text = subprocess.run([floc, *arguments, "--format", "csv"], stdout=subprocess.PIPE, check=True, text=True).stdout
    return list(csv.DictReader(text.splitlines()))


def mean(rows, column):
    values = [float(row[column]) for row in rows if row[column] not in ("", "nan")]
    return f"{statistics.fmean(values):.6g}" if values else ""


def point(floc, directory):
    case, seed = re.search(r"([^/]+)/seed-(\d+)$", directory).groups()
    states = [os.path.join(directory, f"state-{k:04}.h5") for k in CASES[case][2]]
    rows = table(floc, "network", *states, "--columns", "all")
    with open(os.path.join(directory, "path.csv")) as file:
        freedom = next(csv.DictReader(file)).get("force_freedom", "") if CASES[case][2] == AT_REST else ""
    return [case, seed, rows[0]["n_grains"], *[mean(rows, column) for column in COLUMNS], freedom]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("floc")
    parser.add_argument("directory")
    parser.add_argument("--only", default=",".join(CASES))
    parser.add_argument("--seeds", default="1..2")
    options = parser.parse_args()
    floc = os.path.abspath(options.floc) if os.sep in options.floc else options.floc
    first, _, last = options.seeds.partition("..")
    for case in options.only.split(","):
        for seed in range(int(first), int(last or first) + 1):
            run(floc, case, seed, os.path.join(options.directory, case, f"seed-{seed}"))
    points = [point(floc, d) for d in glob.glob(os.path.join(options.directory, "*", "seed-*"))]
    with open(os.path.join(options.directory, "points.csv"), "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["case", "seed", "n_grains", *COLUMNS, "force_freedom"])
        out.writerows(sorted(points, key=lambda p: (list(CASES).index(p[0]), int(p[1]))))


if __name__ == "__main__":
    main()
