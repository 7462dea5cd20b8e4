"""The columns of floc info."""
import hashlib
import pathlib

import numpy as np

from checks import Close, Exempt, Holds, Same
from stiffness import ZERO, Network

TABLES = {"info": "floc info"}


def residuals(s):
    """Returns the deviations of net force, net moment, stress and kinetic energy from their targets, in units of F1
    and a."""
    P = s.target.mean()
    F1, a = s.own_scales(P)
    force, moment = s.net()
    if s.walls:
        pressures = {}
        for w, axis in enumerate(s.walls["axis"]):
            area = s.volume / s.cell[axis, axis]
            pressures[w] = s.N[s.j == s.n + w].sum() / area
        moving = [abs(p - s.target[s.walls["axis"][w]]) for w, p in pressures.items() if s.walls["mass"][w] > 0]
        stress = max(moving, default=0.0) / P
    else:
        stress = np.abs(np.diag(s.stress) - s.target).max() * s.a**(s.dim - 1) / s.F1(P)
    return ((np.linalg.norm(force, axis=1) / F1).max(), (np.linalg.norm(moment, axis=1) / (F1 * a)).max(), stress,
            (s.kinetic() / (F1 * a)).mean())


def residual_columns(s):
    names = ("residual_force", "residual_moment", "residual_stress", "kinetic_energy")
    # The residuals of balanced forces have the rounding errors of these forces.
    return {name: Close(value, 1e-6) for name, value in zip(names, residuals(s))}


def n_negative(s):
    if s.rigid:
        return Same(None)
    if s.law["adhesion"] == "capillary":
        return Exempt("by the tangent of the whole law, geometric terms included, where liquid pulls")
    return Same(int((Network(s).spectrum() < -ZERO).sum()))


def says_law(s, text):
    """Returns whether a text contains each setting of the law once, under its key in a scene."""
    said = dict(part.split("=") for part in text.split(", "))
    if said.pop("normal.law", None) != ("rigid" if s.rigid else None):
        return False
    for key, value in said.items():
        if not np.isclose(s.law[key.replace(".", "_")], float(value), rtol=1e-15):
            return False
    numbers = {key: value for key, value in s.law.items() if not isinstance(value, str) and value != 0}
    return set(numbers) <= {key.replace(".", "_") for key in said}


def same_numbers(expected):
    def condition(text):
        rows = [[float(x) for x in row.split(",")] for row in text.split(";")]
        return np.array_equal(np.array(rows), np.atleast_2d(expected))
    return Holds(f"the numbers {np.asarray(expected).tolist()}, row by row", condition)


def shape_columns(s):
    if not s.shapes:
        return {name: Same(None) for name in ("n_shapes", "least_faces", "most_faces", "rounding")}
    faces = np.diff(s.shapes["first_face"])
    diameter = 2 * s.shapes["outer_radius"]
    return {"n_shapes": Same(len(faces)), "least_faces": Same(int(faces.min())), "most_faces": Same(int(faces.max())),
            "rounding": Close((s.shapes["rounding"] / diameter).max())}


def columns(s, before):
    content = pathlib.Path(s.path).read_bytes()
    p, path = s.provenance, s.path_attributes
    return {"file": Same(s.path), "dimension": Same(s.dim), "units": Same(s.units), "n_grains": Same(s.n),
            "n_contacts": Same(int(s.counted.sum())), "n_distant": Same(int((s.distant & ~s.on_wall).sum())),
            "phi": Close(s.phi), "z": Close(2 * s.counted.sum() / s.n), "P": Close(s.P, s.stress_scale),
            "P_star": Close(s.reduced(s.P), s.reduced(s.stress_scale)), **s.driven_columns(), "target": same_numbers(s.target),
            "cell": same_numbers(s.cell), "law": Holds("the law of the file", lambda text: says_law(s, text)),
            **residual_columns(s), "n_negative": n_negative(s), "step": Same(int(path["step"])),
            "branch": Same(path["branch"]), "time": Close(path["time"]), "n_steps": Same(int(path["n_steps"])),
            "ending": Same(path["ending"]), "program": Same(p["program"]), "commit": Same(p["commit"]),
            "compiler": Same(p["compiler"]), "seed": Same(str(p["seed"])), "source": Same(p["source"] or None),
            "parent_sha256": Same(hashlib.sha256(before).hexdigest() if before else None),
            "scene_sha256": Same(hashlib.sha256(s.scene.encode()).hexdigest()),
            "sha256": Same(hashlib.sha256(content).hexdigest()), "p_wall": Close(s.p_wall),
            **shape_columns(s)}


def check(program, states, tally):
    for samples in states.values():
        before = None
        for s in samples:
            tally.row("info", s.path, program.rows("info", s.path)[0], columns(s, before))
            before = pathlib.Path(s.path).read_bytes()
