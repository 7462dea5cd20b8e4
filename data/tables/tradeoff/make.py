#!/usr/bin/env python3
"""Makes the tables KIND.csv in this folder: for each kind of scene, one study by floc tradeoff."""

import argparse
import concurrent.futures
import csv
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(HERE, os.pardir, os.pardir, "scenes")

# Kind of scene -> shipped scene and the keys that make samples of it cheap.
STUDIES = {
    "disks-cohesive": ("demo", ["grains.count=200", "load.0.steps_per_decade=3", "load.1.steps_per_decade=1"]),
    "disks-cohesionless": (
        "cohesionless_cycle", ["grains.count=150", "load.0.steps_per_decade=2", "load.1.steps_per_decade=1"]),
    "beads-hertz": ("spheres_demo", ["grains.count=200", "load.0.to=1e6"]),
    "spheres-cohesive": (
        "powder3d", ["grains.count=100", "load.0.to=1", "load.0.steps_per_decade=2", "load.1.steps_per_decade=1"]),
    "spheres-wet": ("wet_demo", ["grains.count=150"]),
    "spheres-cohesive-walls": ("compaction_demo", ["grains.count=150"]),
    "disks-cohesive-oedometer": (
        "oedometer", ["grains.count=80", "load.0.steps_per_decade=3", "load.1.steps_per_decade=3",
                      "load.2.steps_per_decade=3"]),
    "disks-cohesionless-biaxial": (
        "biaxial_dense", ["grains.count=150", "load.0.strain=0.1", "load.0.strain_step=5e-3"]),
    "disks-cohesive-biaxial": (
        "biaxial_cohesive", ["grains.count=80", "load.0.steps_per_decade=1", "load.1.strain_step=1e-2"]),
    "disks-cohesionless-simple-shear": (
        "biaxial_dense", ["grains.count=150", "load.0.control=simple_shear", "load.0.strain=0.1",
                          "load.0.strain_step=5e-3"]),
    "disks-cohesionless-constant-volume": (
        "constant_volume", ["grains.count=150", "load.0.strain=0.05", "load.0.strain_step=2.5e-3"]),
    "rigid-disks": ("rigid_disks_demo", ["grains.count=80"]),
    "rigid-polygons": ("pentagons_demo", ["grains.count=60"]),
    "rigid-polyhedra": ("polyhedra_demo", ["grains.count=30", "cell.solid_fraction=0.08"]),
    "disks-cemented": ("cemented2d", ["grains.count=100", 'grains.diameter={distribution="uniform", min=0.5, max=1.5}']),
    "spheres-cemented": ("cemented3d", ["grains.count=40", 'grains.diameter={distribution="uniform", min=0.5, max=1.0}']),
}
# Factor on the budget of kinds whose table is to have eight samples.
BUDGET = {"disks-cohesive": 3.0, "beads-hertz": 3.0, "disks-cohesive-biaxial": 3.0, "disks-cohesive-oedometer": 2.0,
          "rigid-polyhedra": 3.75, "spheres-cemented": 3.75, "spheres-cohesive": 3.75}
# Matrix content of the kinds of cemented grains, whose lattices are studied.
MATRIX = {"disks-cemented": 0.1, "spheres-cemented": 0.2}

# Values of columns that tables of earlier versions do not have.
UNSTUDIED = {"softening": "1", "assembly_softening": "1", "masses": "own", "version": "1"}


def append(table, new):
    """Appends the rows of a later study of some parameters to a table of the same samples. Returns whether the samples are the same.

    Processor times become those of the machine that made the table: the strict settings take as long as in the table. Rows of the same
    parameters that the table has already are replaced.
    """
    with open(table, newline="") as file:
        old = list(csv.DictReader(file))
    strict_of = [next(row for row in rows if row["knob"] == "strict") for rows in (old, new)]
    if strict_of[0]["sample_scatter"] != strict_of[1]["sample_scatter"]:
        return False
    added = [row for row in new if row["knob"] not in {"strict", "scene", "samples"}]
    for row in added:
        for column in ("core_seconds", "moduli_seconds"):
            if row[column]:
                row[column] = repr(float(row[column]) * float(strict_of[0][column]) / float(strict_of[1][column]))
    studied = {row["knob"] for row in added}
    columns = list(new[0])
    kept = [{column: row.get(column) or UNSTUDIED.get(column, "") for column in columns} for row in old if row["knob"] not in studied]
    with open(table, "w", newline="") as out:
        writer = csv.DictWriter(out, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(kept + added)
    return True


def make(kind, floc, budget, samples, folder, knobs=None):
    """Runs the study of one kind and writes its table, or appends some parameters to it. Returns a line about it, and whether it succeeded."""
    scene, changes = STUDIES[kind]
    command = [floc, "tradeoff", os.path.join(SCENES, scene + ".toml")]
    for change in changes:
        command += ["--set", change]
    if knobs:
        command += ["--knobs", knobs]
    if kind in MATRIX:
        command += ["--lattice", str(MATRIX[kind])]
    command += ["--budget", str(BUDGET.get(kind, 1.0) * budget), "--samples", str(samples), "--format", "csv"]
    table, log = os.path.join(folder, kind + ".csv"), os.path.join(folder, kind + ".log")
    with open(log, "w") as messages:
        study = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=messages, env={**os.environ, "OMP_NUM_THREADS": "1"})
        text = study.stdout.read()
        _, status, usage = os.wait4(study.pid, 0)
    seconds = usage.ru_utime + usage.ru_stime
    code = os.waitstatus_to_exitcode(status)
    if code != 0:
        return f"{kind}: exit code {code} after {seconds:.0f} s of processor time; its messages are in {log}", False
    rows = list(csv.DictReader(text.decode().splitlines()))
    if not knobs:
        with open(table, "wb") as out:
            out.write(text)
    elif not append(table, rows):
        return f"{kind}: the samples of the strict settings are not those of {table}", False
    strict = next(row for row in rows if row["knob"] == "strict")
    return (f"{kind}: {seconds:.0f} s of processor time, {strict['n_samples']} samples of {strict['n_grains']} grains "
            f"and {strict['n_states']} states", True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--floc", default="floc", help="program [floc]")
    parser.add_argument("--only", action="append", choices=sorted(STUDIES), metavar="KIND", help="kind to make [all]")
    parser.add_argument("--knobs", help="parameters to append to the tables that there are: softening,... [new tables of all parameters]")
    parser.add_argument("--jobs", type=int, default=1, help="studies at a time, each on one core [1]")
    parser.add_argument("--budget", type=float, default=400.0, help="processor time of a study (s) [400]")
    parser.add_argument("--samples", type=int, default=8, help="largest number of samples of a study [8]")
    parser.add_argument("-o", "--output", default=HERE, metavar="DIR", help="folder of the tables [that of this script]")
    options = parser.parse_args()
    os.makedirs(options.output, exist_ok=True)
    succeeded = True
    lines = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        studies = [pool.submit(make, kind, options.floc, options.budget, options.samples, options.output, options.knobs)
                   for kind in options.only or STUDIES]
        for study in concurrent.futures.as_completed(studies):
            line, whole = study.result()
            print(line, flush=True)
            lines.append(line + "\n")
            succeeded = succeeded and whole
    if not options.knobs:
        with open(os.path.join(options.output, "times.txt"), "w", encoding="utf-8") as times:
            times.writelines(sorted(lines))
    sys.exit(0 if succeeded else 1)


if __name__ == "__main__":
    main()
