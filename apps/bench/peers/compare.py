#!/usr/bin/env python3
"""Measures the contact updates per second of processor time of floc, LAMMPS and YADE on the same packings of disks and
spheres, and prints their ratios.

  apps/bench/peers/compare.py BUILD_DIRECTORY [SCENE...]

It needs the benchmarks (cmake -DFLOC_BUILD_BENCHMARKS=ON); programs that are not installed are left out. The programs
run in turn, several times each. The fastest run of each counts, because other work of the machine only slows a run
down. Contacts are the pairs between which a force acts: at the end of the steps in LAMMPS and YADE, and in the
packing from which the steps start in floc.
"""
import functools
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

ROUNDS = 5
HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = {  # grains; script and laws of LAMMPS; script and law of YADE
    "friction": ("1400 disks", "lammps_steps.in", {"hooke": "gran/hooke/history"}, "yade_steps.py", "CundallStrack"),
    "cohesion": ("1400 disks", "lammps_steps.in", {"jkr": "granular, JKR", "dmt": "granular, DMT"}, "yade_steps.py",
                 "CohesionMoment"),
    "spheres": ("4000 glass beads", "lammps_spheres.in",
                {"hertz": "gran/hertz/history", "mindlin": "granular, mindlin_rescale/force"}, "yade_spheres.py",
                "HertzMindlin"),
}


def output(*command, **options):
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout


def make_packing(floc, scene, folder):
    """Makes a relaxed packing for LAMMPS (packing.data) and YADE (packing.xyz). Returns the name of its state file."""
    output(floc, "run", os.path.join(HERE, scene + ".toml"), "-o", folder)
    state = sorted(name for name in os.listdir(folder) if name.startswith("state-"))[-1]
    state = os.path.join(folder, state)
    for name in "packing.data", "packing.xyz":
        output(floc, "convert", state, os.path.join(folder, name))
    return state


def floc_steps(build, state):
    """Returns the number of contacts and the contact updates per second."""
    text = output(os.path.join(build, "apps/bench/floc_bench"), "--benchmark_filter=steps_of_state",
                  "--benchmark_format=json", env={**os.environ, "FLOC_BENCH_STATE": state})
    result = json.loads(text)["benchmarks"][0]
    return result["contacts"], result["items_per_second"]


def lammps_steps(folder, script, law, barostat):
    text = output("lmp", "-in", os.path.join(HERE, script), "-var", "data", "packing.data", "-var", "law",
                  law, "-var", "barostat", barostat, cwd=folder, env={**os.environ, "OMP_NUM_THREADS": "1"})
    share = float(re.search(r"([\d.]+)% CPU use", text).group(1)) / 100
    seconds = share * float(re.search(r"Loop time of ([\d.e+-]+)", text).group(1))
    contacts, steps = map(float, re.search(r"^contacts ([\d.]+) steps (\d+)", text, re.M).groups())
    return contacts, contacts * steps / seconds


def yade_steps(folder, script, scene):
    text = output("yade", "-n", "-x", "-j1", os.path.join(HERE, script), "packing.xyz", scene, cwd=folder)
    contacts, steps, seconds = map(float, re.search(r"contacts (\d+) steps (\d+) seconds ([\d.]+)", text).groups())
    return contacts, contacts * steps / seconds


def compare(build, scene, folder):
    _, script, laws, yade_script, yade_law = SCENES[scene]
    state = make_packing(os.path.join(build, "apps/floc/floc"), scene, folder)
    programs = {"floc, stress control": functools.partial(floc_steps, build, state)}
    if shutil.which("lmp"):
        for law, name in laws.items():
            for barostat, how in {"yes": "fix nph", "no": "no barostat"}.items():
                programs[f"LAMMPS {name}, {how}"] = functools.partial(lammps_steps, folder, script, law, barostat)
    if shutil.which("yade"):
        programs[f"YADE {yade_law}, stress control"] = functools.partial(yade_steps, folder, yade_script, scene)
    rounds = [{name: steps() for name, steps in programs.items()} for _ in range(ROUNDS)]
    return {name: max((one[name] for one in rounds), key=lambda run: run[1]) for name in programs}


def main():
    build = sys.argv[1]
    for scene in sys.argv[2:] or SCENES:
        with tempfile.TemporaryDirectory() as folder:
            rows = compare(build, scene, folder)
        _, own = rows["floc, stress control"]
        print(f"{f'{SCENES[scene][0]}, {scene}, one core':40s} contacts  million contact updates/s  floc is faster by")
        for name, (contacts, rate) in rows.items():
            print(f"{name:40s} {contacts:8.0f} {rate / 1e6:26.1f} {own / rate:18.1f}", flush=True)


if __name__ == "__main__":
    main()
