#!/usr/bin/env python3
"""Load paths of loose cohesive packings with cells of several masses and rate caps: a row a path.

  study.py FLOC DIRECTORY [--seeds A..B] [--mass M,...] [--cap CAP,...] [--rolling none,small,large] [--to P] [--collect]

assembles data/scenes/type2_no_rolling.toml, type2_rolling_small.toml and type2_rolling_large.toml in DIRECTORY/asm/ROLLING-SEED,
then loads each sample to P* = 13.33, or P, from there (none.toml, small.toml, large.toml), once for each mass and cap, in
DIRECTORY/study/ROLLING/mMASS-cCAP/seed-SEED. Runs that are there already are resumed or kept. Writes DIRECTORY/points.csv,
of all paths that have come to P* = 1 at least; with --collect does nothing else.
"""
import argparse
import csv
import glob
import os
import re
import resource
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = {"none": "type2_no_rolling.toml", "small": "type2_rolling_small.toml", "large": "type2_rolling_large.toml"}
PRESSURES = (1.0, 13.33)
COLUMNS = ["rolling", "mass", "cap", "seed", "Phi_1", "Phi_13.33", "z_1", "z_13.33", "million_steps", "seconds"]


def numbers(text):
    return [float(part) for part in text.split(",")]


def seeds(text):
    first, _, last = text.partition("..")
    return range(int(first), int(last or first) + 1)


def run(floc, scene, directory, *arguments):
    """Processor time that the run took, written beside it."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [floc, "run", scene, "-o", directory, "--threads", "1", "--resume", *arguments]
    if subprocess.run(command, stderr=subprocess.DEVNULL).returncode != 0:
        sys.exit("failed: " + " ".join(command))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    with open(os.path.join(directory, "processor_seconds"), "a") as file:
        file.write(f"{after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime}\n")


def at(rows, pressure):
    """The state at a pressure, with empty cells where the path does not come there."""
    nearest = min(rows, key=lambda row: abs(float(row["P_star"]) - pressure))
    return nearest if abs(float(nearest["P_star"]) - pressure) < 0.01 * pressure else {"phi": "", "z": ""}


def point(directory, rolling, mass, cap, seed):
    """Nothing where the path has not come to the first of the pressures."""
    with open(os.path.join(directory, "path.csv")) as file:
        rows = list(csv.DictReader(file))
    if float(rows[-1]["P_star"]) < 0.99 * PRESSURES[0]:
        return None
    with open(os.path.join(directory, "processor_seconds")) as file:
        seconds = sum(float(line) for line in file)
    ends = [at(rows, p) for p in PRESSURES]
    return ([rolling, mass, cap, seed] + [row["phi"] for row in ends] + [row["z"] for row in ends] +
            [f"{(int(rows[-1]['n_steps']) - int(rows[0]['n_steps'])) / 1e6:g}", f"{seconds:.1f}"])


def collect(directory):
    points = []
    for path in glob.glob(os.path.join(directory, "study", "*", "m*-c*", "seed-*", "path.csv")):
        rolling, mass, cap, seed = re.search(r"study/(\w+)/m([^/]+)-c([^/]+)/seed-(\d+)/", path).groups()
        points.append(point(os.path.dirname(path), rolling, float(mass), float(cap), int(seed)))
    with open(os.path.join(directory, "points.csv"), "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(COLUMNS)
        table.writerows(sorted((p for p in points if p), key=lambda p: (p[0], -p[1], -p[2], p[3])))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("floc")
    parser.add_argument("directory")
    parser.add_argument("--seeds", type=seeds, default=range(1, 7))
    parser.add_argument("--mass", type=numbers, default=[1.0, 0.1, 0.03, 0.01])
    parser.add_argument("--cap", type=numbers, default=[0.05])
    parser.add_argument("--rolling", type=lambda text: text.split(","), default=["none", "small"])
    parser.add_argument("--to", type=float, default=PRESSURES[-1])
    parser.add_argument("--collect", action="store_true")
    options = parser.parse_args()
    floc = os.path.abspath(options.floc) if os.sep in options.floc else options.floc
    for seed in options.seeds if not options.collect else []:
        for rolling in options.rolling:
            start = os.path.abspath(os.path.join(options.directory, "asm", f"{rolling}-{seed}"))
            scene = os.path.join(HERE, "..", "..", "scenes", SCENES[rolling])
            run(floc, scene, start, "--seed", str(seed), "--until", "1")
            for mass in options.mass:
                for cap in options.cap:
                    run(floc, os.path.join(HERE, rolling + ".toml"),
                        os.path.join(options.directory, "study", rolling, f"m{mass:g}-c{cap:g}", f"seed-{seed}"),
                        "--set", f"assembly.state={start}/state-0001.h5", "--set", f"load.0.cell_mass={mass:g}",
                        "--set", f"load.0.strain_rate_cap={cap:g}", "--set", f"load.0.to={options.to:g}")
    collect(options.directory)


if __name__ == "__main__":
    main()
