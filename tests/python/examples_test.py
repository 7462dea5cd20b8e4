#!/usr/bin/env python3
"""Runs the example scripts of the Python package in a directory with data/."""
import os
import pathlib
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(os.environ["FLOC_SOURCE_DIR"])
# A part of the output of each script.
EXPECTED = {
    "moduli_of_a_run.py": "B_voigt",
    "own_packing.py": "contacts, B = 86602.5, closed form 86602.5\nG = 77942.3, closed form 77942.3\n"
                      "with contacts listed: B = 86602.5",
    "fit_with_errors.py": "lambda = 0.199",
}


def main():
    faults = []
    scripts = sorted((SOURCE / "apps/python/examples").glob("*.py"))
    if {script.name for script in scripts} != set(EXPECTED):
        faults.append(f"examples are {[script.name for script in scripts]}, this test knows {sorted(EXPECTED)}")
    with tempfile.TemporaryDirectory() as directory:
        os.symlink(SOURCE / "data", os.path.join(directory, "data"))
        for script in scripts:
            done = subprocess.run([sys.executable, str(script)], cwd=directory, capture_output=True, text=True)
            if done.returncode != 0 or EXPECTED.get(script.name, "") not in done.stdout:
                faults.append(f"{script.name}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    for fault in faults:
        print("FAULT:", fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
