#!/usr/bin/env python3
"""Executes the notebooks of the Python package in a directory with data/. Exits with code 77 if nbconvert is
missing."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(os.environ["FLOC_SOURCE_DIR"])


def main():
    try:
        import ipykernel
        import nbconvert
    except ImportError as error:
        print(f"notebooks are not executed: {error} (Debian: python3-nbconvert, python3-ipykernel)")
        return 77
    del ipykernel, nbconvert
    faults = 0
    notebooks = sorted((SOURCE / "apps/python/notebooks").glob("*.ipynb"))
    with tempfile.TemporaryDirectory() as directory:
        os.symlink(SOURCE / "data", os.path.join(directory, "data"))
        environment = dict(os.environ, MPLBACKEND="module://matplotlib_inline.backend_inline",
                           JUPYTER_DATA_DIR=os.path.join(directory, "jupyter"), IPYTHONDIR=os.path.join(directory, "ipython"))
        for notebook in notebooks:
            copied = shutil.copy(notebook, directory)
            done = subprocess.run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--inplace",
                                   "--ExecutePreprocessor.timeout=240", copied],
                                  cwd=directory, env=environment, capture_output=True, text=True)
            if done.returncode != 0:
                faults += 1
                print(f"FAULT: {notebook.name}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    if len(notebooks) < 2:
        faults += 1
        print(f"FAULT: {len(notebooks)} notebooks found")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
