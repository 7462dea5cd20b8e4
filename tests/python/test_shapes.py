"""Tests the arrays of grains with corners."""
import pathlib
import tempfile
import unittest

import numpy as np

import floc

SCENE = """[scene]
name = "corners"
dimension = {dimension}
units = "reduced"
[grains]
count = {count}
diameter = {{distribution = "uniform", min = 0.7, max = 1.0}}
shape = {shape}
[contact]
normal = {{law = "rigid"}}
friction = {{coefficient = 0.5}}
[cell]
solid_fraction = 0.1
[assembly]
protocol = "direct"
pressure = 1.0
[[load]]
control = "simple_shear"
strain = 0.01
steps = 1
"""
PENTAGONS = SCENE.format(dimension=2, count=14, shape='{kind = "polygon", sides = 5}')
BOXES = SCENE.format(dimension=3, count=8, shape='{kind = "box", sides = [1, 1.2, 1.5]}')


def states_of(scene, directory):
    path = pathlib.Path(directory) / "scene.toml"
    path.write_text(scene)
    floc.run(path, pathlib.Path(directory) / "run")
    return [floc.read(p) for p in sorted((pathlib.Path(directory) / "run").glob("state-*.h5"))]


class Shapes(unittest.TestCase):
    def check(self, scene, n_vertices):
        with tempfile.TemporaryDirectory() as directory:
            rest, moving = states_of(scene, directory)
        self.assertIsNone(rest.motion)
        self.assertEqual(moving.path["ending"], "moving")
        self.assertGreater(moving.motion["time_step"], 0)
        for state in (rest, moving):
            d = state.dimension
            solid = 0.0
            for i in range(state.n_grains):
                shape, corners = state.shapes[state.shape[i]], state.vertices(i)
                self.assertEqual(corners.shape, (n_vertices, d))
                outer = np.linalg.norm(corners - state.position[i], axis=1)
                np.testing.assert_allclose(outer.max(), state.radius[i], rtol=1e-12)
                solid += shape["volume"] * state.scale[i]**d
                # Corners of faces are counter-clockwise as seen from outside. The volume is a sum over triangles of
                # all faces.
                volume = 0.0
                for face in shape["faces"]:
                    v = corners[face] - state.position[i]
                    volume += (np.linalg.det(v) / 2 if d == 2 else
                               sum(np.linalg.det([v[0], v[k], v[k + 1]]) for k in range(1, len(v) - 1)) / 6)
                np.testing.assert_allclose(volume, shape["volume"] * state.scale[i]**d, rtol=1e-9)
            np.testing.assert_allclose(solid / abs(np.linalg.det(state.cell)), state.solid_fraction, rtol=1e-12)
            if d == 2:
                self.check_points(state)

    def check_points(self, state):
        """Checks that a contact point lies midway between the surfaces of both grains."""
        for c in state.contacts:
            point = state.position[c["id1"]] + c["point"]
            for grain, place in ((c["id1"], point), (c["id2"], point - c["image"] @ state.cell)):
                corners = state.vertices(grain)
                depths = []
                for a, b in state.shapes[state.shape[grain]]["faces"]:
                    side, to = corners[b] - corners[a], place - corners[a]
                    depths.append((side[0] * to[1] - side[1] * to[0]) / np.linalg.norm(side))
                self.assertAlmostEqual(min(depths), -c["gap"] / 2, delta=2e-3)

    def test_pentagons(self):
        self.check(PENTAGONS, 5)

    def test_boxes(self):
        self.check(BOXES, 8)

    def test_disks_have_none(self):
        packing = floc.Packing.from_arrays([[0.5, 0.5]], [0.4], [0.799, 0.799], "normal.stiffness=1")
        self.assertIsNone(packing.shapes)
        self.assertIsNone(packing.shape)
        self.assertEqual(packing.vertices(0).shape, (0, 2))
        self.assertNotIn("point", packing.contacts.dtype.names)


if __name__ == "__main__":
    unittest.main()
