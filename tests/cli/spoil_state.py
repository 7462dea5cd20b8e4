"""Changes every dataset and attribute of state files, one at a time, and checks the answer of floc verify: the state
is not in equilibrium, or the file is refused with the name of the changed part, or, for parts that may have any
value, no complaint.

Usage: spoil_state.py FLOC SCRATCH STATE...
"""

import collections
import hashlib
import json
import os
import shutil
import subprocess
import sys

import h5py
import numpy as np

SEAL = 80  # bytes behind the content

# Parts of a state file that may have any value: they describe the origin of the state, or nothing depends on them.
FREE = {
    "path@time": "simulated time",
    "path@n_steps": "time steps",
    "path@ending": "how the relaxation ended",
    "grains/angle": "disks look alike from every side",
    "provenance@program": "", "provenance@commit": "", "provenance@compiler": "", "provenance@seed": "",
    "provenance@stream_state": "", "provenance@parent_sha256": "", "provenance@source": "",
}


def free(f, name):
    """Returns whether a part of this file may have any value."""
    imposed = f["equilibrium/target_side"][:] if "equilibrium/target_side" in f else None
    # The stress at the start of a stage matters only for axes under imposed stress, the length only for axes of
    # imposed length.
    if name == "path/turn_stress":
        return imposed is not None and imposed[np.argmax(np.abs(f[name][:]))] != 0
    if name == "path/turn_sides":
        return imposed is None or imposed[np.argmax(np.abs(f[name][:]))] == 0
    return name in FREE


def changed(name, value):
    """Returns a value of the same type that differs in one place. The difference is large, except for speeds of
    grains at rest."""
    value = np.asarray(value)
    if name.startswith("equilibrium@worst"):
        return value + 1000000
    if value.dtype.kind in "SUO":
        text = value.item()
        return (text + b"x") if isinstance(text, bytes) else text + "x"
    if value.dtype.kind in "iu" or value.dtype.kind == "b":
        out = value.copy()
        flat = out.reshape(-1)
        flat[flat.size // 2] = (1 - flat[flat.size // 2]) if set(np.unique(value)) <= {0, 1} else flat[flat.size // 2] + 1
        return out
    out = value.copy()
    place = np.argmax(np.abs(value))
    small = name.endswith("velocity") or name.endswith(("position_low", "residuals")) or value.flat[place] == 0
    out.flat[place] += (0.0 if small else 1e-2 * value.flat[place]) or 1.0
    return out


def places(content):
    """Returns all datasets, then all attributes of groups, as (path, attribute or None)."""
    found = []
    with h5py.File(content, "r") as f:
        for name in f.attrs:
            found.append(("", name))
        def visit(name, item):
            if isinstance(item, h5py.Dataset):
                if item.size != 0:
                    found.append((name, None))
            else:
                found.extend((name, attribute) for attribute in item.attrs)
        f.visititems(visit)
    return found


def group_of(name):
    """Returns the part of a name that an error message must contain at least."""
    return name.split("@")[0].split("/")[0]


def spoil(content, place, attribute):
    with h5py.File(content, "r+") as f:
        if attribute is not None:
            group = f[place] if place else f
            group.attrs[attribute] = changed(f"{place}@{attribute}", group.attrs[attribute])
        else:
            f[place][()] = changed(place, f[place][()])


def main(floc, scratch, states):
    counts = collections.Counter()
    faults = []
    for state in states:
        whole = open(state, "rb").read()
        body, old_seal = whole[:-SEAL], whole[-SEAL:]
        prefix = old_seal[:old_seal.rindex(hashlib.sha256(body).hexdigest().encode())]
        suffix = old_seal[len(prefix) + 64:]
        directory = os.path.join(scratch, hashlib.sha256(state.encode()).hexdigest()[:8])
        os.makedirs(directory)
        content = os.path.join(scratch, "content.h5")
        open(content, "wb").write(body)
        files = {}
        for place, attribute in places(content):
            name = place + ("@" + attribute if attribute is not None else "")
            work = os.path.join(directory, f"{len(files):04d}.h5")
            shutil.copy(content, work)
            spoil(work, place, attribute)
            changed_body = open(work, "rb").read()
            with open(work, "wb") as out:
                out.write(changed_body + prefix + hashlib.sha256(changed_body).hexdigest().encode() + suffix)
            files[work] = name
        made = subprocess.run([floc, "verify", *files, "--format", "json"], capture_output=True, text=True)
        rows = {row["file"]: row for row in json.loads(made.stdout or "[]")}
        for work, name in files.items():
            if work not in rows:
                outcome = "refused"
                if not any(work in line and group_of(name) in line for line in made.stderr.splitlines()):
                    faults.append(f"{state}: {name}: refused without its name")
            else:
                outcome = "fails" if rows[work]["failed"] else "passes"
            counts[outcome] += 1
            with h5py.File(content, "r") as f:
                expected = free(f, name)
            if (outcome == "passes") != expected:
                faults.append(f"{state}: {name}: {outcome} {rows.get(work, {}).get('failed')}")
        if made.returncode not in (4, 5):
            faults.append(f"{state}: exit code {made.returncode}")
    print(f"{sum(counts.values())} changes of {len(states)} states: {dict(counts)}")
    sys.exit("\n".join(faults) if faults else 0)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
