"""Tests that no argument is silently ignored, and that wrong arguments are refused by name."""
import copy
import pickle
import unittest
import warnings

import numpy as np

import floc
import samples

P = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0]
PHI = [0.5, 0.51, 0.53, 0.55, 0.57, 0.6, 0.62, 0.64]
LOAD = ["load"] * 8
FITS = (floc.fit.consolidation, floc.fit.compression, floc.fit.preconsolidation, floc.fit.elastic, floc.fit.cycle)
LAW = {"normal": {"stiffness": 1e5}, "friction": {"coefficient": 0.5, "stiffness": 5e4}}
RIGID = {"normal": {"law": "rigid"}, "friction": {"coefficient": 0.5}}
SQUARE = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])


def grid(n=3, spacing=0.999, **changes):
    """Returns the arguments for n x n disks of diameter 1 on a square lattice."""
    position = spacing * np.array([(a, b) for a in range(n) for b in range(n)])
    return {"position": position, "radius": np.full(n * n, 0.5), "cell": [n * spacing] * 2, "law": LAW, **changes}


def made(**changes):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", floc.FlocWarning)
        return floc.Packing.from_arrays(**grid(**changes))


def said(call):
    """Returns the warnings of a call."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        call()
    return [str(one.message) for one in caught if issubclass(one.category, floc.FlocWarning)]


class Refusing(unittest.TestCase):
    def refused(self, words, call, *arguments, **keywords):
        with self.assertRaisesRegex(floc.InputError, words):
            call(*arguments, **keywords)


class Samples(Refusing):
    def test_each_have_their_own_arrays(self):
        for fit in FITS:
            for name, values in (("branch", [LOAD, LOAD]), ("branch", []), ("branch", LOAD), ("branch", "load"),
                                 ("solid_fraction", [PHI, PHI]), ("solid_fraction", 0.5), ("void_ratio", [PHI] * 4)):
                arguments = {"solid_fraction": None if name == "void_ratio" else [PHI] * 3, name: values}
                self.refused(f"^{name}", fit, [P] * 3, **arguments)
            self.refused("branch", fit, [P] * 8, [PHI] * 8, branch=LOAD)  # as many names as samples
            self.refused("branch", fit, P, PHI, branch=[])
            self.refused("branch", fit, P, PHI, branch="overload")  # as many letters as pressures
        self.assertEqual(len(floc.fit.consolidation([P] * 3, [PHI] * 3, branch=[LOAD, None, LOAD], law="log")), 4)

    def test_of_tables_take_no_arrays_and_arrays_no_columns(self):
        table = samples.SOURCE / "data/tables/demo/seed-1/path.csv"
        for fit in FITS:
            self.refused("solid_fraction: this argument is for arrays", fit, table, PHI)
            self.refused("void_ratio: this argument is for arrays", fit, table, void_ratio=[1, 2])
            self.refused("branch: this argument is for arrays", fit, str(table), branch=["zz"] * 3)
            self.refused("columns: this argument is for tables", fit, P, PHI, columns={"phi": "density"})
        self.refused("stress: this argument is for tables", floc.fit.consolidation, P, PHI, stress="mean")

    def test_columns_and_moduli_are_texts(self):
        file = samples.directory() / "moduli_of_texts.csv"
        file.write_text("P,phi,B\n" + "".join(f"{p},{0.6 + 0.01 * k},{3.0 * p**0.4}\n"
                                              for k, p in enumerate((1, 2, 4, 8, 16))))
        self.assertEqual(floc.fit.moduli(file, moduli="B")[0].to_dict(), floc.fit.moduli(file, moduli=["B"])[0].to_dict())
        for moduli in (5, [5], ["B", None]):
            self.refused("moduli = ", floc.fit.moduli, file, moduli=moduli)
        for columns in (5, "phi", {"phi": None}, {1: "phi"}, {"phi": ["a"]}):
            self.refused("columns", floc.fit.read_table, file, columns=columns)
        self.refused("tables = 5", floc.fit.moduli, 5)
        strain = samples.directory() / "strain.csv"
        strain.write_text("P,axial_strain\n1,0\n2,0.05\n4,0.1\n")
        self.assertAlmostEqual(floc.fit.read_table(strain, columns={"initial_void_ratio": 0.8}).solid_fraction[0], 1 / 1.8)


class Arrays(Refusing):
    def from_arrays(self, words, **changes):
        self.refused(words, floc.Packing.from_arrays, **grid(**changes))

    def test_of_integers_are_in_their_range(self):
        state = made()
        contacts = {name: state.contacts[name].astype(np.int64) for name in ("id1", "id2", "image")}
        far = contacts["image"].copy()
        far[4, 1] += 2**32
        self.from_arrays(r"image\[4\]: found 4294967296", contacts={**contacts, "image": far})
        huge = np.arange(2**63, 2**63 + 9, dtype=np.uint64)
        self.from_arrays("ids: found 9223372036854775816, expected integers up to", ids=huge)
        for name in contacts:
            wrong = contacts[name].astype(np.uint64)
            wrong.flat[0] = 2**64 - 1
            self.from_arrays(f"contacts: {name}: found 18446744073709551615", contacts={**contacts, name: wrong})
        shaped = {"position": [[1.0, 1.0]], "radius": None, "cell": [4.0, 4.0], "law": RIGID, "shapes": [SQUARE]}
        self.refused("shape: found 18446744073709551615", floc.Packing.from_arrays, **shaped,
                     shape=np.array([2**64 - 1], dtype=np.uint64))

    def test_are_real(self):
        base = grid()
        for name, values in (("position", base["position"]), ("radius", base["radius"]), ("cell", np.array(base["cell"]))):
            self.from_arrays(f"{name}: this array has complex numbers", **{name: values + 0j})
        self.from_arrays("stress = ", stress=np.array([1j, 1j]))
        self.from_arrays("tolerance = ", tolerance=np.complex64(1))
        self.from_arrays("law: normal.stiffness = ", law={"normal.stiffness": np.complex128(1)})
        self.refused("pressure: this array has complex", floc.fit.elastic, np.array(P) + 0j, PHI)
        self.refused("forces: this array has complex", floc.fit.force_distribution, np.ones(20) + 0j)

    def test_texts_and_flags_are_these(self):
        self.from_arrays(r"walls = \['x'\]: expected a text", walls=["x"])
        self.from_arrays("drop_tensile = 'no': expected True or False", drop_tensile="no")
        self.from_arrays("shapes = 5", radius=None, shapes=5)
        self.from_arrays("wall", contacts={"id1": [0], "id2": [1], "wall": 5})
        state = made()
        self.refused("tables = 5", floc.moduli, state, tables=5)
        self.refused(r"groups = 3", floc.network, state, groups=[3])
        self.refused("prestress = 'yes'", floc.moduli, state, prestress="yes")
        self.refused("changes = 5", floc.run, "s.toml", "r", changes=5)
        self.refused("on_progress = 5", floc.run, "s.toml", "r", on_progress=5)
        self.refused("table = 5", floc.columns, 5)
        with self.assertRaisesRegex(TypeError, "expected a State"):
            floc.moduli(5)


class Options(Refusing):
    def test_of_runs_exclude_each_other(self):
        scene, directory = samples.scene_file("powder"), samples.directory() / "both"
        self.refused("track_energy: .* cannot be combined with the argument track_contacts", floc.run, scene, directory,
                     track_contacts=1.0, track_energy=True)
        self.refused("resume: .* cannot be combined", floc.run, scene, directory, resume=True, overwrite=True)
        self.assertFalse(directory.exists())

    def test_of_ranges_need_the_table_of_contacts(self):
        state = made()
        self.refused("ranges: .*tables=", floc.forces, state, ranges=True)
        self.refused("range_of: .*tables=", floc.forces, state, range_of=[100000])
        table = floc.forces(state, range_of=[1], tables="contacts").tables["contacts"]
        self.assertEqual(np.isfinite(table["smallest_normal_force"]).sum(), 1)

    def test_stress_of_forces_is_a_pressure_or_components(self):
        state = made()
        one, two = floc.forces(state, stress=1e-3), floc.forces(state, stress=[1e-3, 1e-3])
        self.assertAlmostEqual(one.mean_normal_force, two.mean_normal_force, delta=1e-12)
        self.assertAlmostEqual(one.mean_normal_force, 0.999e-3, delta=1e-9)


class AsConvert(Refusing):
    """A packing of arrays is that of `floc convert` from a table with the same columns."""

    def tables(self, contacts, **changes):
        arguments = grid(**changes)
        np.savetxt(samples.directory() / "as_grains.csv", np.column_stack([arguments["position"], arguments["radius"]]),
                   "%.17g", ",", header="x,y,radius", comments="")
        columns = {}
        for name, array in contacts.items():
            for k in range(2 if np.ndim(array) == 2 else 0):
                columns[f"{name}{k + 1}"] = np.asarray(array)[:, k]
            if np.ndim(array) == 1:
                columns[name] = np.asarray(array)
        (samples.directory() / "as_contacts.csv").write_text("\n".join(
            [",".join(columns), *(",".join(repr(value.item()) for value in row) for row in zip(*columns.values()))]) + "\n")
        return ("as_grains.csv", "as.h5", "--contacts", "as_contacts.csv", "--law",
                "normal.stiffness=1e5,friction.coefficient=0.5,friction.stiffness=5e4", "--overwrite")

    def test_shear_force_is_added_to_the_normal_part(self):
        state = made()
        normal, shear = state.contacts["normal_force"], np.stack([-state.contacts["normal"][:, 1],
                                                                  state.contacts["normal"][:, 0]], axis=1)
        contacts = {"id1": state.contacts["id1"], "id2": state.contacts["id2"], "image": state.contacts["image"],
                    "force": -normal[:, None] * state.contacts["normal"], "shear_force": 7.0 * shear}
        side = f"{2.997!r},0;0,{2.997!r}"
        samples.floc_program("convert", *self.tables(contacts), "--cell", side)
        theirs = floc.read(samples.directory() / "as.h5")
        mine = made(contacts=contacts)
        np.testing.assert_array_equal(mine.contacts["shear_force"], theirs.contacts["shear_force"])
        np.testing.assert_array_equal(mine.contacts["normal_force"], theirs.contacts["normal_force"])
        np.testing.assert_allclose(np.linalg.norm(mine.contacts["shear_force"], axis=1), 7.0)
        twice = {**contacts, "force": contacts["force"] + contacts["shear_force"]}
        samples.floc_program("convert", *self.tables(twice), "--cell", side, code=4)
        self.refused("that shear_force lists again", floc.Packing.from_arrays, **grid(contacts=twice))

    def test_contacts_with_walls_are_found_if_none_is_listed(self):
        contacts = {"id1": [0], "id2": [3], "normal_force": [100.0]}
        changes = {"position": grid()["position"] + [0.0, 0.4995], "walls": "y=0:"}
        samples.floc_program("convert", *self.tables(contacts, position=changes["position"]), "--cell",
                             f"{2.997!r},0;0,{3.0!r}", "--walls", "y=0:")
        theirs = floc.read(samples.directory() / "as.h5")
        mine = made(contacts=contacts, cell=[2.997, 3.0], **changes)
        self.assertEqual(mine.n_contacts, 4)
        np.testing.assert_array_equal(mine.contacts, theirs.contacts)
        words = said(lambda: floc.Packing.from_arrays(**grid(contacts=contacts, cell=[2.997, 3.0], **changes)))
        self.assertTrue(any("lists no contacts with walls" in one for one in words), words)

    def test_walls_may_have_ids(self):
        contacts = {"id1": [0, 70], "id2": [3, 0], "normal_force": [100.0, 50.0]}
        changes = {"position": grid()["position"] + [0.0, 0.4995], "walls": "y=0:", "cell": [2.997, 3.0]}
        mine = made(contacts=contacts, wall_ids={70: "y-"}, **changes)
        self.assertEqual(sorted(mine.contacts["normal_force"]), [50.0, 100.0])
        self.assertEqual(mine.contacts["id2"].max(), mine.n_grains)
        wrong = grid(contacts=contacts, **changes)
        self.refused("no grain has this id.* give wall_ids", floc.Packing.from_arrays, **wrong)
        self.refused("wall_ids: .* but none are given", floc.Packing.from_arrays, **grid(wall_ids={70: "y-"}))
        for ids in (5, {70: "up"}, {70: 5}, {"a": "y-"}, {2.5: "y-"}):
            self.refused("wall_ids", floc.Packing.from_arrays, **wrong, wall_ids=ids)

    def test_touch_gap_makes_hard_grains_touch(self):
        apart = {"spacing": 1.0 + 1e-6}
        words = said(lambda: floc.Packing.from_arrays(**grid(**apart)))
        self.assertTrue(any("give touch_gap with" in one for one in words), words)
        self.assertFalse(any("--" in one for one in words), words)
        self.assertEqual(made(touch_gap=1e-5, **apart).n_contacts, 18)
        self.refused("touch_gap = -1", floc.Packing.from_arrays, **grid(touch_gap=-1.0))
        self.refused("touch_gap: this argument is for contacts that are found", floc.Packing.from_arrays,
                     **grid(touch_gap=0.1, contacts={"id1": [0], "id2": [1]}))
        self.refused("leave out tensile contacts with drop_tensile", floc.Packing.from_arrays,
                     **grid(contacts={"id1": [0], "id2": [1], "normal_force": [-1.0]}))

    def test_contacts_of_rigid_disks_are_those_of_their_state(self):
        state = made(law=RIGID, touch_gap=1e-6, spacing=1.0 + 1e-9)
        self.assertEqual(state.n_contacts, 18)
        self.assertFalse(state.contacts["kn"].any())
        contacts = state.contacts.copy()
        contacts["normal_force"] = 3.0
        again = made(law=RIGID, spacing=1.0 + 1e-9, contacts=contacts)
        np.testing.assert_array_equal(again.contacts["normal_force"], contacts["normal_force"])
        self.assertFalse(again.contacts["kn"].any())
        contacts["kn"][4] = -1.0
        self.refused("contact 4: kn = -1", floc.Packing.from_arrays, **grid(law=RIGID, spacing=1.0 + 1e-9, contacts=contacts))

    def test_points_inside_the_hull_are_remarked(self):
        dart = np.array([[0.0, 0.0], [1.0, 0.0], [0.2, 0.2], [0.0, 1.0]])
        words = said(lambda: floc.Packing.from_arrays([[2.0, 2.0]], None, [4.0, 4.0], RIGID, shapes=[dart]))
        self.assertTrue(any("1 of 4 points are not vertices of the convex hull" in one for one in words), words)


class Results(unittest.TestCase):
    def test_cannot_be_changed(self):
        moduli = floc.moduli(made())
        fit = floc.fit.consolidation(P, PHI, law="log")
        for result, name in ((moduli, "B"), (moduli, "new"), (moduli, "tables"), (fit, "refusal"), (fit, "parameters"),
                             (fit["lambda"], "value")):
            with self.assertRaisesRegex(AttributeError, "cannot be changed"):
                setattr(result, name, 5.0)
        self.assertEqual(moduli.B, moduli["B"])
        fit.to_dict()["parameters"]["lambda"]["value"] = 99.0
        fit.to_dict()["refusal"] = "none"
        self.assertTrue(fit.found)
        self.assertNotEqual(fit.to_dict()["parameters"]["lambda"]["value"], 99.0)
        for result in (moduli, fit):
            for again in (copy.deepcopy(result), pickle.loads(pickle.dumps(result))):
                self.assertEqual(again.to_dict(), result.to_dict())

    def test_have_every_column_of_the_reference(self):
        """Documented columns that a row lacks are None: those of 3D in 2D, and those of options not given."""
        row = floc.moduli(made())
        self.assertEqual((row.C13, row.C66, row.rolling_stiffness), (None, None, None))
        self.assertNotIn("C13", row)
        self.assertIsNone(floc.network(made()).fabric13)
        for name in ("C21", "C77", "bulk"):
            with self.assertRaises(AttributeError):
                getattr(row, name)


class Pictures(unittest.TestCase):
    def drawn(self, state, **options):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("no matplotlib")
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
        _, ax = plt.subplots()
        lines = floc.plot.forces(state, ax, **options)
        plt.close("all")
        return ax, lines

    def test_lines_of_corners_pass_through_the_contact_points(self):
        """Two squares side by side, the second one across the boundary, touch in the middle of their sides."""
        law = {"normal": {"law": "rigid"}, "friction": {"coefficient": 0.5}}
        contacts = {"id1": [0, 0], "id2": [1, 1], "image": [[0, 0], [-1, 0]], "normal_force": [1.0, 1.0],
                    "point": [[0.5, 0.25], [-0.5, 0.25]]}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", floc.FlocWarning)
            state = floc.Packing.from_arrays([[0.5, 1.5], [1.5, 1.5]], None, [2.0, 3.0], law, contacts, shapes=[SQUARE])
        ax, lines = self.drawn(state)
        expected = [[[0.5, 1.5], [1.0, 1.75], [1.5, 1.5]], [[0.5, 1.5], [0.0, 1.75], [-0.5, 1.5]],
                    [[2.5, 1.5], [2.0, 1.75], [1.5, 1.5]]]
        found = [segment.tolist() for segment in lines.get_segments()]
        np.testing.assert_allclose(sorted(found), sorted(expected), atol=1e-12)
        outline = ax.collections[0].get_paths()[0].vertices
        self.assertEqual(sorted(set(map(tuple, outline.round(9)))), sorted(map(tuple, (SQUARE + [0.5, 1.5]).tolist())))

    def test_outlines_are_rounded(self):
        """The outline of a capsule is as far from the segment between its ends as its rounding."""
        ends = np.array([[1.0, 1.0], [1.0, 1.5]])
        state = floc.Packing.from_arrays([[0.0, 0.0], [2.0, 2.0]], None, [4.0] * 2, RIGID, shape=[0, 1],
                                         shapes=[{"vertices": ends, "rounding": 0.25},
                                                 {"vertices": np.zeros((0, 2)), "rounding": 0.5}])
        paths = [path.vertices for path in self.drawn(state)[0].collections[0].get_paths()]
        nearest = np.clip(paths[0], ends[0], ends[1])
        np.testing.assert_allclose(np.linalg.norm(paths[0] - nearest, axis=1), 0.25, rtol=1e-12)
        np.testing.assert_allclose(np.linalg.norm(paths[1] - 2.0, axis=1), 0.5, rtol=1e-12)
        self.assertAlmostEqual(paths[0][:, 1].min(), 0.75, delta=0.01)

    def test_contacts_across_the_boundary_count_once(self):
        """The width of a line is relative to the root mean square force of all contacts."""
        state = made(contacts={"id1": [0, 0], "id2": [1, 6], "image": [[0, 0], [-1, 0]], "normal_force": [100.0, 50.0]})
        _, lines = self.drawn(state, width=3.0)
        self.assertEqual(len(lines.get_segments()), 3)
        typical = np.sqrt((100.0**2 + 50.0**2) / 2)
        np.testing.assert_allclose(sorted(lines.get_linewidths()), 0.1 + 3.0 * np.array([50.0, 50.0, 100.0]) / typical)


class ArgumentsOfModuli(unittest.TestCase):
    def test_an_accuracy_chooses_method_and_tolerance_itself(self):
        packing = made()
        for other in ({"rolling_stiffness": [1.0, 2.0]}, {"method": "iterative"}, {"tolerance": 1e-6}):
            with self.subTest(other), self.assertRaisesRegex(floc.InputError, "accuracy"):
                floc.moduli(packing, accuracy=0.3, force=True, **other)


if __name__ == "__main__":
    unittest.main()
