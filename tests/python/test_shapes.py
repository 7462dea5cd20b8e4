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
        self.check_round_trip(rest)

    def check_round_trip(self, state):
        """A state taken apart and put together has the same corners, contacts and balance."""
        again = floc.Packing.from_arrays(
            state.position, None, state.cell, state.law, contacts=state.contacts, mass=state.mass,
            stress=state.target_stress, shapes=state.shapes, shape=state.shape, scale=state.scale,
            orientation=state.orientation)
        np.testing.assert_allclose(again.position, state.position, atol=1e-13)
        np.testing.assert_allclose(again.radius, state.radius, rtol=1e-13)
        self.assertAlmostEqual(again.solid_fraction, state.solid_fraction, delta=1e-13)
        for i in range(state.n_grains):
            a, b = (np.array(sorted(map(tuple, np.round(s.vertices(i), 9)))) for s in (again, state))
            np.testing.assert_allclose(a, b, atol=1e-8)
        self.assertEqual(again.n_contacts, state.n_contacts)
        order = [np.lexsort((*s.contacts["point"].T.round(9), s.contacts["id2"], s.contacts["id1"])) for s in (again, state)]
        for name in ("id1", "id2", "image", "normal", "normal_force", "shear_force", "point", "gap"):
            np.testing.assert_allclose(again.contacts[name][order[0]], state.contacts[name][order[1]], atol=1e-9,
                                       err_msg=name)
        self.assertEqual(again.equilibrium_faults, "")

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

    def test_moduli_with_named_stiffnesses(self):
        """Moduli of rigid states are proportional to the stiffnesses, which belong to points or to pairs."""
        with tempfile.TemporaryDirectory() as directory:
            rest = states_of(PENTAGONS, directory)[0]
        with self.assertRaisesRegex(floc.InputError, "rigid"):
            floc.moduli(rest)
        one, two = floc.moduli(rest, kn=1.0, kt=0.5), floc.moduli(rest, kn=2.0, kt=1.0)
        self.assertEqual((one.kn_named, one.kt_named, one.stiffness_per), (1.0, 0.5, "point"))
        self.assertAlmostEqual(two.B / one.B, 2.0, delta=1e-9)
        pairs = floc.moduli(rest, kn=1.0, kt=0.5, stiffness_per="contact")
        self.assertEqual(pairs.stiffness_per, "contact")
        self.assertLess(pairs.B_voigt, one.B_voigt)  # side contacts have two points, which share the stiffness here

    def test_pentagons(self):
        self.check(PENTAGONS, 5)

    def test_boxes(self):
        self.check(BOXES, 8)

    def test_closed_forms_of_vertices(self):
        """A triangle away from the origin, twice as large and turned by a right angle: area 6 scale^2, and its corners."""
        law = {"normal": {"law": "rigid"}, "friction": {"coefficient": 0.5}}
        triangle = np.array([[1.0, 1.0], [4.0, 1.0], [1.0, 5.0]])
        packing = floc.Packing.from_arrays([[10.0, 10.0]], None, [40.0, 40.0], law, shapes=[triangle], scale=[2.0],
                                           orientation=[np.pi / 2])
        self.assertAlmostEqual(packing.solid_fraction, 24 / 1600, delta=1e-15)
        corners = np.array(sorted(map(tuple, packing.vertices(0))))
        np.testing.assert_allclose(corners, [[0.0, 12.0], [8.0, 12.0], [8.0, 18.0]], atol=1e-12)
        cube = {"vertices": [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], "rounding": 0.0}
        packing = floc.Packing.from_arrays([[1.0, 1.0, 1.0]], None, [4.0] * 3, law, shapes=[cube],
                                           orientation=[[0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5)]])
        np.testing.assert_allclose(packing.position, [[0.5, 1.5, 1.5]], atol=1e-12)
        self.assertAlmostEqual(packing.mass[0], 1.0 / (np.pi / 6), delta=1e-12)

    def test_capsules(self):
        """Two vertices with rounding are a capsule, whichever way it points; the shapes of a state are accepted again."""
        law = {"normal": {"law": "rigid"}, "friction": {"coefficient": 0.5}}
        ends = np.array([[1.0, 1.0, 1.0], [1.0, 1.4, 1.3]])
        one = floc.Packing.from_arrays([[0.0, 0.0, 0.0]], None, [4.0] * 3, law, shapes=[{"vertices": ends, "rounding": 0.25}])
        self.assertAlmostEqual(one.solid_fraction * 64, np.pi * 0.25**2 * 0.5 + 4 / 3 * np.pi * 0.25**3, delta=1e-12)
        np.testing.assert_allclose(sorted(map(tuple, one.vertices(0))), sorted(map(tuple, ends)), atol=1e-12)
        again = floc.Packing.from_arrays(one.position, None, [4.0] * 3, law, shapes=one.shapes, orientation=one.orientation)
        np.testing.assert_allclose(again.vertices(0), one.vertices(0), atol=1e-12)
        flat = floc.Packing.from_arrays([[0.0, 0.0]], None, [4.0] * 2, law,
                                        shapes=[{"vertices": [[1.0, 1.0], [1.0, 1.5]], "rounding": 0.25}])
        np.testing.assert_allclose(sorted(map(tuple, flat.vertices(0))), [[1.0, 1.0], [1.0, 1.5]], atol=1e-12)
        with self.assertRaisesRegex(floc.InputError, "times as long as it is thick"):
            floc.Packing.from_arrays([[0.0, 0.0]], None, [40.0] * 2, law,
                                     shapes=[{"vertices": [[0.0, 0.0], [0.0, 9.0]], "rounding": 0.1}])

    def test_kinds_of_contacts(self):
        """Kinds are those given, or follow from the shapes; others are refused."""
        law = {"normal": {"law": "rigid"}, "friction": {"coefficient": 0.5}}
        cube = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]) - 0.5
        # Two cubes, each on an edge, that cross.
        half = np.sin(np.pi / 8)
        turned = [[half, 0.0, 0.0, np.cos(np.pi / 8)], [0.0, half, 0.0, np.cos(np.pi / 8)]]
        contacts = {"id1": [0], "id2": [1], "normal_force": [1.0], "shear_force": [[0.0, 0.0, 0.0]],
                    "point": [[0.0, 0.0, np.sqrt(0.5)]]}
        def kind(**more):
            packing = floc.Packing.from_arrays([[2.0, 2.0, 2.0], [2.0, 2.0, 2.0 + np.sqrt(2.0)]], None, [8.0] * 3, law,
                                               {**contacts, **more}, shapes=[cube], orientation=turned)
            return packing.contacts["type"][0]
        self.assertEqual(kind(), 1)
        for number in range(4):
            self.assertEqual(kind(type=[number]), number)
        with self.assertRaisesRegex(floc.InputError, "expected 0 .vertex-face., 1 "):
            kind(type=[7])

    def test_mistakes_are_named(self):
        square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
        right = {"position": [[1.0, 1.0]], "radius": None, "cell": [4.0, 4.0], "law": "normal.law=rigid", "shapes": [square]}
        self.assertEqual(floc.Packing.from_arrays(**right).n_grains, 1)
        for wrong, words in (({"radius": [0.5]}, "radius: expected the radii of disks or spheres, or None"),
                             ({"shapes": []}, "there is no shape"),
                             ({"shapes": [square[:2]]}, "it has 2 vertices and no rounding"),
                             ({"shapes": [[[0.0, 0.0, 0.0]] * 4]}, "vertices has shape (4, 3), expected (k, 2)"),
                             ({"shapes": [square, square]}, "there are 2 shapes"),
                             ({"shape": [1]}, "shape[0]: this number is 1"),
                             ({"shapes": [{"vertices": square, "roundng": 0.1}]}, "unknown key 'roundng'"),
                             ({"scale": [-1.0]}, "scale[0]: this number is -1"),
                             ({"orientation": [0.0, 1.0]}, "orientation: this array has shape (2,)"),
                             ({"shapes": None, "radius": [0.5], "scale": [1.0]}, "scale: expected shapes beside it")):
            with self.assertRaises(floc.InputError) as caught:
                floc.Packing.from_arrays(**{**right, **wrong})
            self.assertIn(words, str(caught.exception))

    def test_disks_have_none(self):
        packing = floc.Packing.from_arrays([[0.5, 0.5]], [0.4], [0.799, 0.799], "normal.stiffness=1")
        self.assertIsNone(packing.shapes)
        self.assertIsNone(packing.shape)
        self.assertEqual(packing.vertices(0).shape, (0, 2))
        self.assertNotIn("point", packing.contacts.dtype.names)


if __name__ == "__main__":
    unittest.main()
