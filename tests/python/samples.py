"""Small runs that the tests of the Python package share, and the program to compare with."""
import atexit
import functools
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

import floc

PROGRAM = os.environ["FLOC_PROGRAM"]
SOURCE = pathlib.Path(os.environ["FLOC_SOURCE_DIR"])

POWDER = """[scene]
name = "powder"
dimension = 2
units = "reduced"
[grains]
count = 40
diameter = {distribution = "uniform", min = 0.5, max = 1.0}
[contact]
normal = {law = "linear", stiffness = 1e4}
adhesion = {law = "tail", force = 1.0, range = 1e-2}
damping = {restitution = 0.015, mass = "effective"}
friction = {coefficient = 0.5, stiffness = 1e4}
rolling = {coefficient = 0.005, stiffness = 1.0}
[cell]
solid_fraction = 0.5
mass = 1.0
strain_rate_cap = 0.05
[assembly]
protocol = "aggregation"
agitation = 3.0
pressure = 0.01
[[load]]
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

BEADS = """[scene]
name = "beads"
dimension = 3
units = "SI"
[grains]
count = 70
density = 2500
diameter = {distribution = "constant", value = 1e-3}
[contact]
normal = {law = "hertz", modulus = 70e9, poisson = 0.3}
friction = {law = "mindlin", coefficient = 0.3}
damping = {critical_fraction = 0.98}
[cell]
solid_fraction = 0.45
mass = 1.0
inertial_number_cap = 0.03
[assembly]
protocol = "direct"
pressure = 1e6
friction = 0.02
[[load]]
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

BOX = """[scene]
name = "box"
dimension = 2
units = "reduced"
[grains]
count = 60
diameter = {distribution = "uniform", min = 0.8, max = 1.0}
[contact]
normal = {law = "linear", stiffness = 1e3}
adhesion = {law = "constant", force = 0.2}
damping = {restitution = 0.4472136}
friction = {coefficient = 0.4, stiffness = 1.5e3}
[box]
sides = [1, 1.3]
mass = 20
pressure = 0.1
friction = 0.4
adhesion = 0
[assembly]
protocol = "direct"
solid_fraction = 0.35
kinetic_pressure = 0.02
[equilibrium]
stop_time = 200
[run]
seed = 3
"""

SCENES = {"powder": POWDER, "beads": BEADS, "box": BOX}


@functools.lru_cache(maxsize=None)
def directory():
    """Removed when the tests are done."""
    path = pathlib.Path(tempfile.mkdtemp(prefix="floc-python-"))
    atexit.register(shutil.rmtree, path, ignore_errors=True)
    return path


def scene_file(name):
    path = directory() / f"{name}.toml"
    path.write_text(SCENES[name])
    return path


@functools.lru_cache(maxsize=None)
def run(name):
    """The run of one of the scenes, made once."""
    return floc.run(scene_file(name), directory() / name, timing=False)


def last_state(name):
    return str(run(name).states[-1])


def floc_program(*arguments, code=0):
    """What a command prints on stdout."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=directory())
    assert done.returncode == code, (arguments, done.returncode, done.stderr)
    return done.stdout


def rows_of(*arguments, code=0):
    """Rows that a command prints, from json: every digit of every number."""
    return json.loads(floc_program(*arguments, "--format", "json", code=code))
