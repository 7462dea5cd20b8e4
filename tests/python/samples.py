"""Small runs that the tests of the Python package share, and calls of the program for comparison."""
import atexit
import functools
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import floc

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from scene_texts import scene_text  # noqa: E402

PROGRAM = os.environ["FLOC_PROGRAM"]
SOURCE = pathlib.Path(os.environ["FLOC_SOURCE_DIR"])

POWDER = scene_text("small") + """[[load]]
name = "load"
to = 1.0
steps_per_decade = 3
[[load]]
name = "unload"
to = 0.1
steps_per_decade = 3
[run]
seed = 3
checkpoint_every = 0.02
"""

BEADS = scene_text("beads") + """[[load]]
name = "load"
to = 10e6
steps_per_decade = 1
[equilibrium]
force = 1e-4
moment = 1e-4
stress = 1e-4
energy = 1e-7
[run]
seed = 3
"""

BOX = scene_text("box") + """[equilibrium]
stop_time = 200
[run]
seed = 3
"""

SCENES = {"powder": POWDER, "beads": BEADS, "box": BOX}


@functools.lru_cache(maxsize=None)
def directory():
    """Returns a directory that is removed at the end of the tests."""
    path = pathlib.Path(tempfile.mkdtemp(prefix="floc-python-"))
    atexit.register(shutil.rmtree, path, ignore_errors=True)
    return path


def scene_file(name):
    path = directory() / f"{name}.toml"
    path.write_text(SCENES[name])
    return path


@functools.lru_cache(maxsize=None)
def run(name):
    """Returns the run of one of the scenes, which is made once."""
    return floc.run(scene_file(name), directory() / name, timing=False)


def last_state(name):
    return str(run(name).states[-1])


def floc_program(*arguments, code=0):
    """Returns the stdout of a command."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=directory())
    assert done.returncode == code, (arguments, done.returncode, done.stderr)
    return done.stdout


def rows_of(*arguments, code=0):
    """Returns the rows that a command prints as json, with all digits."""
    return json.loads(floc_program(*arguments, "--format", "json", code=code))
