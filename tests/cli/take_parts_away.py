"""Removes each dataset and each attribute of a state file in turn, seals the rest in the way of floc, and requires
`floc info` to refuse the file with exit code 4 and the name of the missing part.

Usage: take_parts_away.py FLOC STATE SCRATCH_DIRECTORY
"""

import hashlib
import os
import subprocess
import sys

import h5py

SEAL_SIZE = 80
# These attributes inform human readers or belong to later versions; floc does not need them.
UNREAD = {"units", "meaning", "boundary", "scene_sha256", "ending"}


def parts(path):
    """Returns every dataset and attribute that floc reads, as (object, attribute or None)."""
    found = []

    def visit(name, item):
        if isinstance(item, h5py.Dataset):
            found.append((name, None))
        found.extend((name, attribute) for attribute in item.attrs if attribute not in UNREAD)

    with h5py.File(path, "r") as f:
        f.visititems(visit)
        found.extend(("/", attribute) for attribute in f.attrs)
    return found


def take_away(path, copy, name, attribute):
    with open(path, "rb") as f:
        image = f.read()[:-SEAL_SIZE]
    with open(copy, "wb") as f:
        f.write(image)
    with h5py.File(copy, "r+") as f:
        if attribute is None:
            del f[name]
        else:
            del f[name].attrs[attribute]
    with open(copy, "rb") as f:
        image = f.read()
    with open(copy, "ab") as f:
        f.write(b"\nfloc-sha256 = " + hashlib.sha256(image).hexdigest().encode() + b"\n")


def main(floc, state, scratch):
    copy = os.path.join(scratch, "part.h5")
    everything = parts(state)
    assert len(everything) > 60, everything
    for name, attribute in everything:
        take_away(state, copy, name, attribute)
        run = subprocess.run([floc, "info", copy], capture_output=True, text=True)
        missing = attribute or name
        if run.returncode != 4 or missing not in run.stderr or "missing" not in run.stderr:
            sys.exit(f"without {name} {attribute}: exit code {run.returncode}, {run.stderr!r}")
    print(f"{len(everything)} parts")


if __name__ == "__main__":
    main(*sys.argv[1:])
