"""Scenes of 20 to 60 grains, one or more for every kind of packing that the columns are checked on."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from scene_texts import scene_text  # noqa: E402

POWDER = scene_text("small", ("stiffness = 1e4}\nrolling", "stiffness = 7e3}\nrolling")) + """[[load]]
name = "load"
to = 1.0
steps = 2
[[load]]
name = "biaxial"
control = "triaxial"
axis = 1
strain = 0.01
steps = 1
[[load]]
name = "shear"
control = "simple_shear"
strain = 0.01
steps = 1
[run]
seed = 3
"""

DISKS = """[scene]
name = "disks"
dimension = 2
units = "reduced"
[grains]
count = 50
diameter = {distribution = "uniform", min = 0.4, max = 1.0}
[contact]
normal = {law = "linear", stiffness = 1.0}
damping = {restitution = 0.1, mass = "effective"}
friction = {coefficient = 0.3, stiffness = 0.8}
[cell]
solid_fraction = 0.5
mass = 1.0
inertial_number_cap = 0.01
[assembly]
protocol = "direct"
pressure = 1e-3
[[load]]
name = "oedometer"
control = "oedometric"
to = 3e-3
steps = 1
[run]
seed = 2
"""

BEADS = scene_text("beads", ("count = 70", "count = 60"), ("pressure = 1e6", "pressure = 10e6")) + """[[load]]
name = "biaxial"
control = "triaxial"
strain = 0.001
steps = 1
[run]
seed = 3
"""

CLAY = """[scene]
name = "clay"
dimension = 3
units = "reduced"
[grains]
count = 30
diameter = {distribution = "uniform", min = 0.6, max = 1.0}
[contact]
normal = {law = "linear", stiffness = 1e4}
adhesion = {law = "tail", force = 1.0, range = 0.02}
damping = {restitution = 0.015, mass = "effective"}
friction = {coefficient = 0.5, stiffness = 8e3}
rolling = {coefficient = 0.01, stiffness = 2.0}
twisting = {coefficient = 0.01, stiffness = 3.0}
[cell]
solid_fraction = 0.4
mass = 1.0
strain_rate_cap = 0.05
[assembly]
protocol = "direct"
pressure = 0.05
[[load]]
to = 0.5
steps = 1
[run]
seed = 5
"""

WET = scene_text("wet", ("water_content = 0", "water_content = 0.02")) + """friction = 0.0
[[load]]
to = 300
steps = 1
[run]
seed = 1
"""

BOX = scene_text("box") + """[run]
seed = 3
"""

CUBE = """[scene]
name = "cube"
dimension = 3
units = "reduced"
[grains]
count = 30
diameter = {distribution = "constant", value = 1.0}
[contact]
normal = {law = "linear", stiffness = 1e3}
adhesion = {law = "constant", force = 0.2}
damping = {restitution = 0.4472136}
friction = {coefficient = 0.4, stiffness = 1.5e3}
rolling = {coefficient = 0.02, stiffness = 5.0}
[box]
sides = [1, 1, 1]
boundary = {x = "walls", y = "periodic", z = "walls"}
mass = 20
pressure = 0.1
friction = 0.4
adhesion = 0
[assembly]
protocol = "direct"
solid_fraction = 0.35
kinetic_pressure = 0.02
[run]
seed = 3
"""

# Scene of rigid grains; all kinds of rigid grains use the same assembly.
RIGID = """[scene]
name = "rigid"
dimension = {dimension}
units = "reduced"
[grains]
count = {count}
diameter = {{distribution = "uniform", min = 0.5, max = 1.0}}
{shape}
[contact]
normal = {{law = "rigid"}}
{contact}
[cell]
solid_fraction = {solid_fraction}
inertial_number_cap = 0.02
[assembly]
protocol = "direct"
pressure = 1.0
[[load]]
name = "load"
to = 3.0
steps = 1
[dynamics]
finish = "{finish}"
[run]
seed = {seed}
"""

FRICTION = "friction = {coefficient = 0.5}"
RIGID_DISKS = RIGID.format(dimension=2, count=40, shape="", contact=FRICTION, solid_fraction=0.4, finish="closest", seed=1)
SMOOTH_DISKS = RIGID.format(dimension=2, count=30, shape="", contact="", solid_fraction=0.4, finish="closest", seed=2)
HULLS = RIGID.format(dimension=2, count=30, contact=FRICTION, solid_fraction=0.25, finish="none", seed=1,
                     shape='shape = {kind = "hull", vertices = [4, 9], rounding = 0.05, count = 7}')
PENTAGONS = RIGID.format(dimension=2, count=30, contact=FRICTION, solid_fraction=0.3, finish="closest", seed=1,
                         shape='shape = {kind = "polygon", sides = 5}').replace("[dynamics]", """[[load]]
control = "oedometric"
to = 5.0
steps = 1
[[load]]
control = "simple_shear"
strain = 0.04
steps = 1
[dynamics]""")
STONES = RIGID.format(dimension=3, count=16, contact=FRICTION, solid_fraction=0.08, finish="closest", seed=1,
                      shape='shape = {kind = "cut", faces = [6, 10], count = 5}')
STICKY_SPHERES = RIGID.format(dimension=3, count=30, shape="", solid_fraction=0.3, finish="canonical", seed=1, contact=(
    'adhesion = {law = "constant", force = 0.2}\n' + FRICTION))

SCENES = {"powder": POWDER, "disks": DISKS, "beads": BEADS, "clay": CLAY, "wet": WET, "box": BOX, "cube": CUBE,
          "rigid_disks": RIGID_DISKS, "smooth_disks": SMOOTH_DISKS, "hulls": HULLS, "pentagons": PENTAGONS,
          "stones": STONES, "sticky_spheres": STICKY_SPHERES}
