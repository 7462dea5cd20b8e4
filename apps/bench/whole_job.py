#!/usr/bin/env python3
"""Prints the processor time of a job as one table: the force loop for several numbers of grains, its passes, the
relaxation to equilibrium, a whole load path, and two jobs at a time.

  apps/bench/whole_job.py BUILD_DIRECTORY [SCENE]

It needs the benchmarks (cmake -DFLOC_BUILD_BENCHMARKS=ON). Times are processor times, except for the two jobs. The
load path is that of SCENE, by default data/scenes/type2_no_rolling.toml, which takes a minute or two.
"""
import csv
import json
import os
import resource
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(HERE, "..", "..", "data", "scenes")


def row(what, value):
    print(f"{what:<58} {value}", flush=True)


def benchmarks(build, pattern):
    text = subprocess.run(
        [os.path.join(build, "apps/bench/floc_bench"), f"--benchmark_filter={pattern}", "--benchmark_format=json"],
        check=True, capture_output=True, text=True).stdout
    return [b for b in json.loads(text)["benchmarks"] if not b.get("error_occurred")]


def arguments(benchmark):
    return dict(part.split(":") for part in benchmark["name"].split("/") if ":" in part)


def force_loop(build):
    physics = {"0": "frictionless", "1": "friction", "2": "friction, rolling"}
    for b in benchmarks(build, "force_loop/.*threads:1/instructions:2"):
        at = arguments(b)
        rate = b["items_per_second"]
        name = f"{at['grains']} grains, {physics[at['physics']]}{', adhesion' if at['adhesive'] == '1' else ''}"
        row(name, f"{rate / 1e6:6.1f} million contact updates/s, {1e9 / rate:5.1f} ns per contact, peak {b['peak_MB']:.0f} MB")
    for b in benchmarks(build, "passes/"):
        shares = ", ".join(f"{name} {100 * b[name]:.0f} %" for name in ("drift", "pairs", "sums"))
        row(f"{arguments(b)['grains']} grains, share of the passes",
            f"{shares}; a new list of pairs takes as long as {b['list_in_steps']:.0f} steps")


def to_equilibrium(build):
    for b in benchmarks(build, "gas_to_equilibrium/"):
        percent = arguments(b)["cell_mass_percent"]
        row(f"1400 grains, gas to equilibrium, cell of {percent} % of their mass", f"{b['cpu_time']:.2f} s")


def run(build, scene, folder, *options):
    """Makes a run and returns its processor time and its wall time (s)."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run([os.path.join(build, "apps/floc/floc"), "run", scene, "-o", folder, *options], check=True,
                   stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return cpu, time.monotonic() - start


def whole_path(build, scene, folder):
    cpu, _ = run(build, scene, folder)
    with open(os.path.join(folder, "path.csv")) as table:
        rows = list(csv.DictReader(table))
    steps = int(rows[-1]["n_steps"])
    loading = [r for r in rows if r["branch"] != "unload"]
    endings = [r["ending"] for r in rows]
    row(f"{os.path.basename(scene)}, whole path", f"{cpu:.1f} s, {steps} time steps, {1e6 * cpu / steps:.1f} us per step")
    row("  its assembly and loading", f"{sum(float(r['seconds']) for r in loading):.1f} s (wall time)")
    row("  steps by the way they ended", ", ".join(f"{e} {endings.count(e)}" for e in sorted(set(endings))))
    quiet = [float(r["seconds"]) for r in rows if r["ending"] == "static"]
    if quiet:
        row("  a static step", f"{sum(quiet) / len(quiet):.2f} s on average, {max(quiet):.2f} s at most (wall time)")


def two_jobs(build, folder):
    scene = os.path.join(SCENES, "demo.toml")
    options = ("--set", "grains.count=200", "--seeds", "1..4")
    _, one = run(build, scene, os.path.join(folder, "one"), *options, "--jobs", "1")
    _, two = run(build, scene, os.path.join(folder, "two"), *options, "--jobs", "2")
    row("four samples: one job at a time / two jobs at a time", f"{one:.1f} s / {two:.1f} s = {one / two:.2f}")


def main():
    build = sys.argv[1]
    scene = sys.argv[2] if len(sys.argv) > 2 else os.path.join(SCENES, "type2_no_rolling.toml")
    force_loop(build)
    to_equilibrium(build)
    with tempfile.TemporaryDirectory() as folder:
        whole_path(build, scene, os.path.join(folder, "path"))
        two_jobs(build, folder)


if __name__ == "__main__":
    main()
