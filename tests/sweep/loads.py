"""Scenes of a few grains, each of which runs in a fraction of a second: every control of a stage, every way to
assemble a packing and every kind of contact, in each dimension that has them; and stages that are refused.

ways_test.py runs them in every possible way, and tests/sanitized does so with sanitizers."""
import dataclasses

GRAINS = 24


def head(dimension):
    return f"""[scene]
name = "small"
dimension = {dimension}
units = "reduced"
[grains]
count = {GRAINS}
diameter = {{distribution = "uniform", min = 0.7, max = 1.0}}
density = 1.0
[equilibrium]
force = 1e-3
moment = 1e-3
stress = 1e-3
energy = 1e-5
[run]
seed = 1
checkpoint_every = 0.02
"""


def cell(dimension):
    return f"[cell]\nsolid_fraction = {0.5 if dimension == 2 else 0.4}\n"


def contact(**slots):
    slots.setdefault("normal", '{law = "linear", stiffness = 1e3}')
    slots.setdefault("damping", "{restitution = 0.1}")
    slots.setdefault("friction", "{coefficient = 0.4, stiffness = 1e3}")
    return "[contact]\n" + "".join(f"{slot} = {law}\n" for slot, law in slots.items())


DIRECT = '[assembly]\nprotocol = "direct"\npressure = 0.5\n'
TAIL = '{law = "tail", force = 1.0, range = 1e-2}'
LIQUID = ('{law = "capillary", surface_tension = 0.3, contact_angle = 10, water_content = 0.01, density_ratio = 2.0, '
          'form = "%s", formation = "%s"}')


def powder(dimension):
    """Returns a scene of cohesive grains with every spring that the dimension has."""
    slots = {"adhesion": TAIL, "rolling": "{coefficient = 0.02, stiffness = 10.0}"}
    if dimension == 3:
        slots["twisting"] = "{coefficient = 0.02, stiffness = 10.0}"
    return head(dimension) + contact(**slots) + cell(dimension) + DIRECT


def clusters(dimension):
    """Returns a scene of grains that are assembled by aggregation."""
    return (head(dimension) + contact(adhesion=TAIL) + cell(dimension)
            + '[assembly]\nprotocol = "aggregation"\nagitation = 2.0\npressure = 0.5\n')


def sand(dimension):
    """Returns a scene of grains without adhesion, from a gas made by sequential addition, with vibration."""
    return (head(dimension) + contact() + cell(dimension) + DIRECT
            + 'friction = 0.1\ngas = "sequential_addition"\nvibration = {dilation = 1.01, collisions = 5}\n')


def wet(dimension, form="exponential", formation="gap"):
    return head(dimension) + contact(adhesion=LIQUID % (form, formation)) + cell(dimension) + DIRECT


def beads(dimension):
    """Returns a scene of elastic spheres."""
    return (head(dimension) + contact(normal='{law = "hertz", modulus = 1e5, poisson = 0.3}',
                                      damping="{critical_fraction = 0.9}",
                                      friction='{law = "mindlin", coefficient = 0.3}') + cell(dimension) + DIRECT)


def box(dimension, boundary="", adhesion='{law = "constant", force = 0.2}'):
    slots = {"adhesion": adhesion} if adhesion else {}
    return head(dimension) + contact(**slots) + f"""[box]
sides = {[1, 1.3] if dimension == 2 else [1, 1, 1.3]}
mass = 20
pressure = 0.5
friction = 0.3
adhesion = 0
{boundary}
[assembly]
protocol = "direct"
solid_fraction = 0.35
kinetic_pressure = 0.02
"""


def saved(dimension):
    """Returns a scene that starts from the state SAVED_STATE in the directory of the scene."""
    scene = powder(dimension)
    parts = {name: scene.index(f"[{name}]") for name in ("grains", "equilibrium", "cell", "assembly")}
    return (scene[:parts["grains"]] + scene[parts["equilibrium"]:parts["cell"]]
            + f'[assembly]\nprotocol = "state"\nstate = "{SAVED_STATE[dimension]}"\n'
            + f"copies = {[1] * dimension}\nagitation = 0.5\npressure = 0.5\n")


SAVED_STATE = {2: "saved2.h5", 3: "saved3.h5"}


def stage(*lines):
    return "[[load]]\n" + "".join(f"{line}\n" for line in lines)


def each_axis(control, *lines, first=1):
    """Returns one stage for each axis."""
    def stages(dimension):
        return "".join(stage(f'control = "{control}"', f"axis = {axis}", *lines) for axis in range(first, dimension + 1))
    return stages


def axes(*loads, lines=("steps = 2",)):
    """Returns a stage with a load for each axis; in 2D the last loads are left out."""
    def stages(dimension):
        return stage('control = "axes"', f"axes = [{', '.join(loads[:dimension])}]", *lines)
    return stages


def both(*parts):
    return lambda dimension: "".join(part if isinstance(part, str) else part(dimension) for part in parts)


@dataclasses.dataclass
class Scene:
    name: str
    base: object          # a function of the dimension
    stages: object        # text, or a function of the dimension
    dimensions: tuple = (2, 3)
    refused: str = ""     # words of the refusal
    code: int = 4

    def text(self, dimension):
        stages = self.stages if isinstance(self.stages, str) else self.stages(dimension)
        return self.base(dimension) + stages


ISOTROPIC = (stage("to = 1.0", "steps_per_decade = 4") + stage("to = 0.7", "steps = 1")
             + stage("to = 0.7", "set = {friction.coefficient = 0.2}"))
THEN_ISOTROPIC = stage("to = 1.0", "steps = 1")

SCENES = [
    Scene("isotropic, held under another law", powder, ISOTROPIC),
    Scene("isotropic to zero and back", powder, stage("to = 0.0") + stage("to = 0.5")),
    Scene("isotropic at rates of its own", powder,
          stage("to = 0.8", "steps = 1", "strain_rate_cap = 0.02", "cell_mass = 0.5")
          + stage("to = 1.0", "steps = 1", "inertial_number_cap = 1e-2")),
    Scene("oedometric by stress", powder, both(each_axis("oedometric", "to = 0.8", "steps = 1"), THEN_ISOTROPIC)),
    Scene("oedometric by decades", powder,
          stage('control = "oedometric"', "to = 0.8", "steps_per_decade = 8")),
    Scene("oedometric by strain", powder,
          both(each_axis("oedometric", "strain = 0.01", "steps = 1"),
               each_axis("oedometric", "strain = -0.002", "strain_step = 0.001"))),
    Scene("triaxial by stress", powder, both(each_axis("triaxial", "to = 0.8", "steps = 1"), THEN_ISOTROPIC)),
    Scene("triaxial by strain", powder, both(each_axis("triaxial", "strain = 0.01", "steps = 1"), THEN_ISOTROPIC)),
    Scene("constant volume", powder, each_axis("constant_volume", "strain = 0.01", "strain_step = 0.005")),
    Scene("axes under stresses", powder, both(axes("{stress = 0.6}", "{stress = 0.8}", "{as = 1}"), THEN_ISOTROPIC)),
    Scene("axes alike", powder, axes("{stress = 0.8}", "{as = 1}", "{as = 2}")),
    Scene("axes given lengths", powder, axes("{strain = 0.01}", "{strain = 0.002}", "{as = 2}")),
    Scene("axes under a stress and given lengths", powder, axes("{stress = 0.8}", "{strain = 0.005}", "{as = 1}")),
    Scene("simple shear", powder,
          both(each_axis("simple_shear", "strain = 0.02", "strain_step = 0.01", first=2), THEN_ISOTROPIC)),
    Scene("clusters, oedometric", clusters, stage('control = "oedometric"', "to = 0.8", "steps = 1")),
    Scene("sand shaken, triaxial", sand, stage('control = "triaxial"', "strain = 0.01", "steps = 1")),
    Scene("sand shaken, constant volume", sand, stage('control = "constant_volume"', "strain = 0.001", "steps = 1")),
    Scene("wet, oedometric and pulled", wet,
          stage('control = "oedometric"', "to = 0.8", "steps = 1") + stage('control = "triaxial"', "strain = -0.01", "steps = 1")),
    Scene("wet, of the other form and formation", lambda d: wet(d, "rational", "contact"), THEN_ISOTROPIC),
    Scene("beads, isotropic and triaxial", beads,
          stage("to = 1.0", "steps = 1") + stage('control = "triaxial"', "strain = 0.003", "steps = 1"), (3,)),
    Scene("beads, axes", beads, axes("{stress = 0.6}", "{strain = 0.001}", "{as = 2}"), (3,)),
    Scene("from a state, oedometric", saved, stage('control = "oedometric"', "to = 0.8", "steps = 1")),
    Scene("box, isotropic", box, stage("to = 0.8", "steps = 1")),
    Scene("box, isotropic at a speed", box, stage("to = 0.8", "steps = 1", "speed = 0.1")),
    Scene("box, triaxial by stress", box, stage('control = "triaxial"', "to = 0.8", "steps = 1")),
    Scene("box, axes under stresses", box, axes("{stress = 0.6}", "{stress = 0.8}", "{as = 1}", lines=("steps = 1",))),
    Scene("box, one axis periodic", lambda d: box(d, 'boundary = {x = "periodic"}'), stage("to = 0.8", "steps = 1")),
    Scene("box, one axis fixed", lambda d: box(d, 'boundary = {x = "fixed"}'), stage("to = 0.8", "steps = 1")),
    Scene("box of a powder", lambda d: box(d, adhesion=TAIL), stage("to = 0.8", "steps = 1")),
    Scene("box, wet", lambda d: box(d, adhesion=LIQUID % ("exponential", "gap")), stage("to = 0.8", "steps = 1")),
]

REFUSED = [
    Scene("triaxial without an end", powder, stage('control = "triaxial"', "steps = 1"), refused="to is missing"),
    Scene("triaxial without steps", powder, stage('control = "triaxial"', "strain = 0.1"), refused="steps is missing"),
    Scene("oedometric by both", powder, stage('control = "oedometric"', "strain = 0.1", "to = 1.0", "steps = 1"),
          refused="expected only one of them"),
    Scene("constant volume by stress", powder, stage('control = "constant_volume"', "to = 1.0", "steps = 1"),
          refused="expected the key strain"),
    Scene("axis 0", powder, stage('control = "triaxial"', "axis = 0", "strain = 0.1", "steps = 1"), refused="axis"),
    Scene("axis 3 of a plane", powder, stage('control = "triaxial"', "axis = 3", "strain = 0.1", "steps = 1"), (2,),
          refused="1 or 2"),
    Scene("axis 4", powder, stage('control = "oedometric"', "axis = 4", "to = 1.0", "steps = 1"), refused="axis"),
    Scene("shear along its own axis", powder, stage('control = "simple_shear"', "axis = 1", "strain = 0.1", "steps = 1"),
          refused="axis"),
    Scene("shear across axis 3 of a plane", powder,
          stage('control = "simple_shear"', "axis = 3", "strain = 0.1", "steps = 1"), (2,), refused="axis"),
    Scene("shear to a stress", powder, stage('control = "simple_shear"', "to = 1.0", "steps = 1"), refused="expected the key strain"),
    Scene("two axes in space", powder, stage('control = "axes"', "axes = [{stress = 1.0}, {strain = 0.1}]", "steps = 1"),
          (3,), refused="expected 3"),
    Scene("three axes in the plane", powder,
          stage('control = "axes"', "axes = [{stress = 1.0}, {strain = 0.1}, {as = 1}]", "steps = 1"), (2,),
          refused="expected 2"),
    Scene("no axes", powder, stage('control = "axes"', "axes = []", "steps = 1"), refused="expected"),
    Scene("axes without axes", powder, stage('control = "axes"', "steps = 1"), refused="axes"),
    Scene("like a later axis", powder, axes("{as = 2}", "{stress = 1.0}", "{stress = 1.0}"), refused="expected the number of an earlier axis"),
    Scene("like itself", powder, axes("{stress = 1.0}", "{as = 2}", "{as = 3}"), refused="expected the number of an earlier axis"),
    Scene("isotropic with an axis", powder, stage("to = 1.0", "axis = 1", "steps = 1"), refused="isotropic"),
    Scene("isotropic by strain", powder, stage("strain = 0.1", "steps = 1"), refused="isotropic"),
    Scene("a cell that closes", powder, axes("{strain = 1.5}", "{strain = 1.5}", "{strain = 1.5}"), refused="vanish"),
    Scene("a control of no name", powder, stage('control = "uniaxial"', "to = 1.0", "steps = 1"), refused="control"),
    Scene("zero without adhesion", sand, stage('control = "triaxial"', "to = 0.0", "steps = 1"), refused="adhesion"),
    Scene("decades from a strain", powder,
          both(each_axis("triaxial", "strain = 0.01", "steps = 1"),
               stage('control = "oedometric"', "to = 1.0", "steps_per_decade = 2")), refused="not known before the run"),
    Scene("a law that is not there", sand, stage("to = 1.0", "steps = 1", "set = {adhesion.force = 1.0}"), refused="adhesion.force"),
    Scene("elastic disks", beads, THEN_ISOTROPIC, (2,), refused="hertz"),
    Scene("box, oedometric", box, stage('control = "oedometric"', "to = 1.0", "steps = 1"), refused="walls"),
    Scene("box, triaxial by strain", box, stage('control = "triaxial"', "strain = 0.1", "steps = 1"), refused="walls"),
    Scene("box, constant volume", box, stage('control = "constant_volume"', "strain = 0.1", "steps = 1"), refused="walls"),
    Scene("box, simple shear", box, stage('control = "simple_shear"', "strain = 0.1", "steps = 1"), refused="walls"),
    Scene("box, a stress on a periodic axis", lambda d: box(d, 'boundary = {x = "periodic"}'),
          axes("{stress = 0.6}", "{stress = 0.8}", "{stress = 0.7}"), refused="no wall"),
    Scene("box, at a rate", box, stage("to = 1.0", "steps = 1", "strain_rate_cap = 0.1"), refused="walls and no periodic cell"),
    Scene("cell, at a speed", powder, stage("to = 1.0", "steps = 1", "speed = 1.0"), refused="no table [box]"),
    Scene("from a state of the other dimension", lambda d: saved(5 - d).replace(f"dimension = {5 - d}", f"dimension = {d}")
          .replace(f"copies = {[1] * (5 - d)}", f"copies = {[1] * d}"), THEN_ISOTROPIC, refused="dimension"),
]


def controls():
    """Returns the names of the controls and reasons in the scenes, to print what is covered."""
    words = set()
    for scene in SCENES:
        for dimension in scene.dimensions:
            words.update(line.split('"')[1] for line in scene.text(dimension).splitlines() if line.startswith("control"))
    return sorted(words | {"isotropic"})
