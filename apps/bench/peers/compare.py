#!/usr/bin/env python3
"""Contact updates per processor second of floc, LAMMPS and YADE on one packing, in one run, and their ratios.

  apps/bench/peers/compare.py BUILD_DIRECTORY

needs the benchmarks (cmake -DFLOC_BUILD_BENCHMARKS=ON); programs that are not installed are left out.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))


def output(*command, **options):
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout


def make_packing(floc, folder):
    """The relaxed packing, for LAMMPS (packing.data) and YADE (packing.xyz)."""
    output(floc, "run", os.path.join(HERE, "friction.toml"), "-o", os.path.join(folder, "run"))
    for name in "packing.data", "packing.xyz":
        output(floc, "convert", os.path.join(folder, "run", "state-0000.h5"), os.path.join(folder, name))


def floc_rate(build):
    text = output(
        os.path.join(build, "apps/bench/floc_bench"),
        "--benchmark_filter=force_loop/grains:1400/physics:1/adhesive:0/threads:1/instructions:2",
        "--benchmark_format=json",
    )
    return json.loads(text)["benchmarks"][0]["items_per_second"]


def lammps_rate(folder, barostat):
    text = output("lmp", "-in", os.path.join(HERE, "friction.in"), "-var", "data", "packing.data", "-var", "barostat",
                  barostat, cwd=folder, env={**os.environ, "OMP_NUM_THREADS": "1"})
    share = float(re.search(r"([\d.]+)% CPU use", text).group(1)) / 100
    seconds = share * float(re.search(r"Loop time of ([\d.e+-]+)", text).group(1))
    contacts, steps = map(float, re.search(r"^contacts ([\d.]+) steps (\d+)", text, re.M).groups())
    return contacts * steps / seconds


def yade_rate(folder):
    text = output("yade", "-n", "-x", "-j1", os.path.join(HERE, "friction_yade.py"), "packing.xyz", cwd=folder)
    contacts, steps, seconds = map(float, re.search(r"contacts (\d+) steps (\d+) seconds ([\d.]+)", text).groups())
    return contacts * steps / seconds


def main():
    build = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        make_packing(os.path.join(build, "apps/floc/floc"), folder)
        rates = {"floc, stress control": floc_rate(build)}
        if shutil.which("lmp"):
            rates["LAMMPS gran/hooke/history, fix nph"] = lammps_rate(folder, "yes")
            rates["LAMMPS gran/hooke/history, no barostat"] = lammps_rate(folder, "no")
        if shutil.which("yade"):
            rates["YADE CundallStrack, stress control"] = yade_rate(folder)
    own = rates["floc, stress control"]
    print(f"{'1400 disks, friction, one core':42s} {'million contact updates/s':>26s} {'floc is faster by':>18s}")
    for name, rate in rates.items():
        print(f"{name:42s} {rate / 1e6:26.1f} {own / rate:18.1f}")


if __name__ == "__main__":
    main()
