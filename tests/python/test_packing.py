"""Tests that packings from arrays equal packings that floc convert makes from files."""
import unittest
import warnings

import numpy as np

import floc
import samples

LAW = {"normal": {"stiffness": 1e5}, "friction": {"coefficient": 0.5, "stiffness": 5e4}}


def square(n=3, overlap=1e-3):
    """Returns n x n disks of diameter 1 on a square lattice, each in contact with four others."""
    spacing = 1.0 - overlap
    position = spacing * np.array([(a, b) for a in range(n) for b in range(n)], dtype=float)
    return position, np.full(n * n, 0.5), np.array([n * spacing, n * spacing])


class FromArrays(unittest.TestCase):
    def test_moduli_of_a_crystal(self):
        """Disks on a square lattice with contacts of stiffness K_N have C11 = K_N."""
        position, radius, cell = square()
        packing = floc.Packing.from_arrays(position, radius, cell, LAW)
        self.assertEqual(packing.n_contacts, 18)
        moduli = floc.moduli(packing)
        self.assertAlmostEqual(moduli.C11, 1e5, delta=1e-5)
        self.assertAlmostEqual(moduli.C12, 0.0, delta=1e-5)
        self.assertIsInstance(packing, floc.State)

    def test_equals_convert(self):
        position, radius, cell = square()
        np.savetxt(samples.directory() / "grains.csv", np.column_stack([position, radius]), "%.17g", ",",
                   header="x,y,radius", comments="")
        law = "normal.stiffness=1e5,friction.coefficient=0.5,friction.stiffness=5e4"
        samples.floc_program("convert", "grains.csv", "grains.h5", "--law", law, "--cell",
                             f"{cell[0]!r},0;0,{cell[1]!r}", "--overwrite")
        theirs = floc.read(samples.directory() / "grains.h5")
        mine = floc.Packing.from_arrays(position, radius, np.diag(cell), law)
        np.testing.assert_array_equal(mine.position, theirs.position)
        np.testing.assert_array_equal(mine.contacts, theirs.contacts)
        np.testing.assert_array_equal(mine.target_stress, theirs.target_stress)
        a, b = floc.moduli(mine).to_dict(), floc.moduli(theirs).to_dict()
        for values in (a, b):
            values.pop("file"), values.pop("seconds"), values.pop("seconds_row", None)
        self.assertEqual(a, b)

    def test_of_the_arrays_of_a_state(self):
        """A packing made from the arrays of a state has its network and its moduli, in 2D and 3D."""
        for name in ("powder", "beads"):
            state = floc.read(samples.last_state(name))
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", floc.FlocWarning)
                again = floc.Packing.from_arrays(state.position, state.radius, state.cell, state.law,
                                                 contacts=state.contacts, mass=state.mass, units=state.units,
                                                 stress=state.target_stress)
            self.assertEqual(again.n_contacts, state.n_contacts)
            np.testing.assert_allclose(again.contacts["normal_force"], state.contacts["normal_force"], rtol=1e-12)
            self.assertAlmostEqual(floc.moduli(again).B / floc.moduli(state).B, 1.0, delta=1e-6)

    def test_contacts_as_dict_and_data_frame(self):
        position, radius, cell = square()
        contacts = floc.Packing.from_arrays(position, radius, cell, LAW).contacts
        columns = {name: contacts[name] for name in ("id1", "id2", "image", "normal_force")}
        packing = floc.Packing.from_arrays(position, radius, cell, LAW, contacts=columns)
        np.testing.assert_array_equal(packing.contacts["normal_force"], contacts["normal_force"])
        try:
            import pandas
        except ImportError:
            return
        frame = pandas.DataFrame({"id1": [0], "id2": [1], "normal_force": [7.0]})
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", floc.FlocWarning)
            self.assertEqual(floc.Packing.from_arrays(position, radius, cell, LAW, contacts=frame).contacts["normal_force"],
                             [7.0])

    def test_does_not_keep_the_arrays(self):
        position, radius, cell = square()
        packing = floc.Packing.from_arrays(position, radius, cell, LAW)
        expected = packing.position.copy()
        position[:] = np.nan
        np.testing.assert_array_equal(packing.position, expected)

    def test_is_written_and_read(self):
        position, radius, cell = square()
        packing = floc.Packing.from_arrays(position, radius, cell, LAW)
        packing.write(samples.directory() / "square.h5")
        self.assertEqual(samples.rows_of("moduli", "square.h5")[0]["B"], floc.moduli(packing).B)

    def test_warns_where_forces_and_equilibrium_disagree(self):
        position, radius, cell = square()
        contacts = {"id1": [0], "id2": [1], "normal_force": [7.0]}
        with self.assertWarnsRegex(floc.FlocWarning, "not in equilibrium"):
            floc.Packing.from_arrays(position, radius, cell, LAW, contacts=contacts)


class WallsAndBonds(unittest.TestCase):
    def test_column_on_a_floor_bears_its_weight(self):
        """In a column of three disks on a floor, the k-th contact from above bears k m g. The overlap determines this
        force."""
        g, kn = 2.0, 1e5
        overlap = g * np.array([3.0, 2.0, 1.0]) / kn
        y = np.cumsum([0.5 - overlap[0], 1.0 - overlap[1], 1.0 - overlap[2]])
        packing = floc.Packing.from_arrays(np.column_stack([np.full(3, 2.0), y]), np.full(3, 0.5), [4.0, 4.0], LAW,
                                           walls="y=0:", gravity=[0, -g])
        self.assertEqual([wall["open"] for wall in packing.walls], [False, True])
        np.testing.assert_allclose(np.sort(packing.contacts["normal_force"]), [g, 2 * g, 3 * g], rtol=1e-9)
        self.assertLess(packing.residuals["force"], 1e-8)

    def test_listed_contacts_with_walls_keep_their_forces(self):
        position, radius, cell = square()
        contacts = {"id1": [0, 0], "id2": [1, 0], "wall": ["", "x-"], "normal_force": [7.0, 9.0]}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", floc.FlocWarning)
            packing = floc.Packing.from_arrays(position + 0.5, radius, cell, LAW, contacts=contacts, walls="x",
                                               wall_law={"normal": {"stiffness": 2e5}})
        self.assertEqual(sorted(packing.contacts["normal_force"]), [7.0, 9.0])
        self.assertEqual(packing.contacts["kn"][list(packing.contacts["normal_force"]).index(9.0)], 2e5)

    def test_bonds_act_across_gaps(self):
        position, radius, cell = square(overlap=-0.1)
        bonds = {"id1": [0], "id2": [1], "kn": [5.0], "kt": [3.0]}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", floc.FlocWarning)
            packing = floc.Packing.from_arrays(position, radius, cell, LAW, bonds=bonds)
        self.assertEqual(packing.n_contacts, 1)
        self.assertEqual([packing.contacts[name][0] for name in ("kn", "kt", "normal_force")], [5.0, 3.0, 0.0])

    def test_wrong_ones_are_named(self):
        position, radius, cell = square()
        for words, more in ((r'wall\[0\]: "up" is not the name of a wall',
                             {"contacts": {"id1": [0], "id2": [1], "wall": ["up"]}}),
                            ("periodic along every axis", {"gravity": [0, -1]}),
                            ("gravity has 3 components, expected 2", {"gravity": [0, 0, -1], "walls": "y"}),
                            ("bonds: the required array id1 is missing", {"bonds": {"id2": [1]}}),
                            ("kn = 0", {"bonds": {"id1": [0], "id2": [1]}})):
            with self.assertRaisesRegex(floc.InputError, words):
                floc.Packing.from_arrays(position + 0.5, radius, cell, LAW, **more)


class Refusals(unittest.TestCase):
    def refused(self, words, **changes):
        position, radius, cell = square()
        arguments = {"position": position, "radius": radius, "cell": cell, "law": LAW, **changes}
        with self.assertRaisesRegex(floc.InputError, words):
            floc.Packing.from_arrays(**arguments)

    def test_name_array_index_and_value(self):
        position, radius, cell = square()
        self.refused(r"position: this array has shape \(9, 3\), expected \(n, 2\)", position=np.zeros((9, 3)))
        self.refused(r"radius: this array has shape \(8,\), expected \(9,\)", radius=radius[:8])
        self.refused(r"cell: this array has shape \(4, 4\), expected \(2, 2\) or \(3, 3\)", cell=np.ones(4))
        self.refused(r"cell: the cell is degenerate", cell=[[1, 1], [1, 1]])
        self.refused(r"radius\[2\]: this number is -1, expected a positive", radius=np.where(np.arange(9) == 2, -1.0, radius))
        self.refused(r"position\[0\]: this number is nan", position=np.where(np.arange(18).reshape(9, 2) == 0, np.nan, position))
        self.refused(r"mass: this array has shape \(1,\)", mass=[1.0])
        self.refused(r"position: expected an array of numbers", position="here")
        self.refused(r"stress: the stress has 3 numbers, expected 2", stress=[1.0, 1.0, 1.0])
        self.refused("solid fraction", radius=2 * radius)

    def test_name_the_law(self):
        self.refused("normal.stifness", law="normal.stifness=1e5")
        self.refused("stiffness", law={"normal": {"stiffness": -1.0}})

    def test_name_the_contact(self):
        self.refused("contacts: the required array id2 is missing", contacts={"id1": [0]})
        self.refused("contacts: 'force1' is not one of", contacts={"id1": [0], "id2": [1], "force1": [1.0]})
        self.refused(r"contacts: normal_force: this array has shape \(2,\), expected \(1,\)",
                     contacts={"id1": [0], "id2": [1], "normal_force": [1.0, 2.0]})
        self.refused("contact 0: id2 = 70: no grain has this id", contacts={"id1": [0], "id2": [70]})
        self.refused("contacts: id1 has values of type float64", contacts={"id1": [0.5], "id2": [1]})
        self.refused("contact 0: .*carries a tensile force of 1",
                     contacts={"id1": [0], "id2": [1], "normal_force": [-1.0]})

    def test_take_integers_written_as_real_numbers(self):
        """numpy.loadtxt reads all numbers as real numbers, also ids."""
        position, radius, cell = square()
        packing = floc.Packing.from_arrays(position, radius, cell, LAW)
        kept = {name: packing.contacts[name] for name in ("id1", "id2", "image")}
        real = {name: array.astype(float) for name, array in kept.items()}
        again = floc.Packing.from_arrays(position, radius, cell, LAW, contacts=real)
        np.testing.assert_array_equal(again.contacts, packing.contacts)
        for name in kept:
            spoiled = {**real, name: real[name] + 0.5}
            self.refused(f"contacts: {name} has values of type float64", contacts=spoiled)

    def test_name_the_array_with_a_mask(self):
        """Every array of numbers, given as an array or a list, is refused if it has a masked entry."""
        position, radius, cell = square()
        packing = floc.Packing.from_arrays(position, radius, cell, LAW)
        numbers = {"id1", "id2", "image", "normal_force", "shear_force", "kn", "kt", "kr"}
        contacts = {name: packing.contacts[name] for name in numbers}
        arrays = {"position": position, "radius": radius, "mass": radius, "cell": np.diag(cell), "stress": [1.0, 1.0]}

        def masked(values, hidden):
            mask = np.zeros(np.shape(values), dtype=bool)
            mask.flat[-1] = hidden
            return np.ma.array(values, mask=mask)

        n_refused = 0
        for name, values in arrays.items():
            self.refused(rf"{name}\[.*\]: this entry is masked, expected a value", **{name: masked(values, True)})
            self.refused(rf"{name}\[.*\]: this entry is masked", **{name: list(masked(values, True))})
            n_refused += 2
        for name, values in contacts.items():
            self.refused(rf"contacts: {name}\[.*\]: this entry is masked", contacts={**contacts, name: masked(values, True)})
            n_refused += 1
        table = np.ma.array(packing.contacts)
        table["kn"][3] = np.ma.masked
        self.refused(r"contacts: kn\[3\]: this entry is masked", contacts=table)
        whole = floc.Packing.from_arrays(masked(position, False), masked(radius, False), cell, LAW,
                                         contacts={name: masked(values, False) for name, values in contacts.items()})
        np.testing.assert_array_equal(whole.contacts["normal_force"], packing.contacts["normal_force"])
        print(f"{n_refused + 1} masked arrays refused")

    def test_name_stiffnesses_that_are_none_and_those_of_another_law(self):
        position, radius, cell = square()
        packing = floc.Packing.from_arrays(position, radius, cell, LAW)
        contacts = {name: packing.contacts[name] for name in ("id1", "id2", "image", "normal_force", "kn", "kt", "kr")}
        for name, value in (("kn", -1e5), ("kn", 0.0), ("kt", -1.0), ("kr", -1.0), ("ktw", -1.0)):
            spoiled = {**contacts, name: np.where(np.arange(18) == 4, value, contacts.get(name, np.zeros(18)))}
            self.refused(f"contact 4: {name} = {value:g}, expected", contacts=spoiled)
        with self.assertWarnsRegex(floc.FlocWarning, "kt of 18 contacts is 10 times the value of the contact law"):
            other = floc.Packing.from_arrays(position, radius, cell, LAW,
                                             contacts={**contacts, "kt": 10 * contacts["kt"]})
        with self.assertWarnsRegex(floc.FlocWarning, "kt of 18 contacts is 10 times the value of the contact law"):
            floc.moduli(other)
        force = -contacts["normal_force"][:, None] * packing.contacts["normal"]
        floc.Packing.from_arrays(position, radius, cell, LAW, contacts={**contacts, "force": force})
        self.refused("normal_force = .*, but the total force listed for the same contact has the normal component",
                     contacts={**contacts, "force": 2 * force})


if __name__ == "__main__":
    unittest.main()
