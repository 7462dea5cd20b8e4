"""Tests states: arrays are views of one memory, and files that are not states are refused with a message."""
import concurrent.futures
import copy
import gc
import multiprocessing
import os
import pathlib
import pickle
import unittest

import numpy as np

import floc
import samples


class Views(unittest.TestCase):
    def setUp(self):
        self.state = floc.read(samples.last_state("powder"))

    def arrays(self, state):
        return {"position": state.position, "velocity": state.velocity, "radius": state.radius, "mass": state.mass,
                "orientation": state.orientation, "angular_velocity": state.angular_velocity, "cell": state.cell,
                "contacts": state.contacts, "stress": state.stress, "target_stress": state.target_stress}

    def test_share_the_memory_of_the_state(self):
        for name, array in self.arrays(self.state).items():
            again = self.arrays(self.state)[name]
            self.assertEqual(array.__array_interface__["data"][0], again.__array_interface__["data"][0], name)
            self.assertFalse(array.flags.owndata, name)
        column = self.state.contacts["normal_force"]
        self.assertTrue(np.shares_memory(column, self.state.contacts))

    def test_cannot_be_written_to(self):
        for name, array in self.arrays(self.state).items():
            self.assertFalse(array.flags.writeable, name)
            with self.assertRaises(ValueError, msg=name):
                array[...] = array
            with self.assertRaises(ValueError, msg=name):
                array.flags.writeable = True
        with self.assertRaises(AttributeError):
            self.state.position = np.zeros((1, 2))

    def test_outlive_the_state(self):
        position = self.state.position
        normal = self.state.contacts["normal"]
        expected = position.copy(), normal.copy()
        del self.state
        gc.collect()
        filler = [np.full_like(expected[0], np.nan) for _ in range(100)]
        np.testing.assert_array_equal(position, expected[0])
        np.testing.assert_array_equal(normal, expected[1])
        del filler

    def test_have_the_shapes_of_the_dimension(self):
        for name, dimension, turns in (("powder", 2, ()), ("beads", 3, (3,)), ("box", 2, ())):
            state = floc.read(samples.last_state(name))
            n = state.n_grains
            self.assertEqual(state.dimension, dimension)
            self.assertEqual(state.position.shape, (n, dimension))
            self.assertEqual(state.radius.shape, (n,))
            self.assertEqual(state.orientation.shape, (n,) if dimension == 2 else (n, 4))
            self.assertEqual(state.angular_velocity.shape, (n, *turns))
            self.assertEqual(state.cell.shape, (dimension, dimension))
            self.assertEqual(state.contacts.shape, (state.n_contacts,))
            self.assertEqual(state.contacts["shear_force"].shape, (state.n_contacts, dimension))
            self.assertEqual(state.contacts["rolling_moment"].shape, (state.n_contacts, *turns))


class Values(unittest.TestCase):
    def test_are_those_of_the_file(self):
        import h5py
        for name in samples.SCENES:
            state = floc.read(samples.last_state(name))
            with h5py.File(samples.last_state(name)) as file:
                for array in ("position", "velocity", "radius", "mass", "angular_velocity"):
                    np.testing.assert_array_equal(getattr(state, array), file["grains"][array][:], array)
                np.testing.assert_array_equal(state.cell, file["cell/matrix"][:])
                np.testing.assert_array_equal(state.stress, file["equilibrium/stress"][:])
                for column, data in file["contacts"].items():
                    if column in state.contacts.dtype.names:
                        np.testing.assert_array_equal(state.contacts[column], data[:], column)
                    elif column != "memory":  # springs that the law has not
                        self.assertFalse(data[:].any(), column)
                for column, data in file["contacts/memory"].items():
                    np.testing.assert_array_equal(state.contacts[column], data[:], column)

    def test_say_where_contacts_are(self):
        for name in ("powder", "beads"):
            s = floc.read(samples.last_state(name))
            c = s.contacts
            branch = s.position[c["id2"]] + c["image"] @ s.cell - s.position[c["id1"]]
            length = s.radius[c["id1"]] + s.radius[c["id2"]] + c["gap"]
            np.testing.assert_allclose(branch, length[:, None] * c["normal"], rtol=0, atol=1e-12 * s.radius.max())

    def test_are_those_of_info(self):
        for name in samples.SCENES:
            file = samples.last_state(name)
            state, info = floc.read(file), samples.rows_of("info", file)[0]
            self.assertEqual(state.pressure, info["P"])
            self.assertEqual(state.reduced_pressure, info["P_star"])
            self.assertEqual(state.solid_fraction, info["phi"])
            self.assertEqual(state.law, info["law"])
            self.assertEqual(state.units, info["units"])
            self.assertEqual(state.path["step"], info["step"])
            self.assertEqual(state.provenance["commit"], info["commit"])
        self.assertEqual(len(floc.read(samples.last_state("box")).walls), 4)

    def test_are_written_as_they_were_read(self):
        file = samples.last_state("beads")
        copy = samples.directory() / "copy.h5"
        floc.read(file).write(copy)
        self.assertEqual(copy.read_bytes(), pathlib.Path(file).read_bytes())


class Matrices(unittest.TestCase):
    def test_have_rows_first(self):
        """The stress is sigma_ab = sum f_a r_b/V, and lattice vectors are rows. The packing is not in balance, so
        that its stress is not symmetric; its cell is skewed."""
        cell = np.array([[4.0, 0.0], [1.0, 3.0]])
        branch, normal, shear = np.array([0.588, 0.784]), np.array([0.6, 0.8]), np.array([-2.4, 1.8])
        with self.assertWarns(floc.FlocWarning):
            made = floc.Packing.from_arrays(
                [[1.0, 1.0], [1.588, 1.784]], [0.5, 0.5], cell,
                "normal.stiffness=1e3, friction.coefficient=0.5, friction.stiffness=1e3",
                contacts={"id1": [0], "id2": [1], "normal_force": [20.0], "shear_force": [shear]}, tolerance=10.0)
        expected = np.outer(20.0 * normal - shear, branch) / 12.0
        self.assertGreater(abs(expected[0, 1] - expected[1, 0]), 0.1)
        file = samples.directory() / "unbalanced.h5"
        made.write(file)
        read = floc.read(file)
        for state in (made, read):
            np.testing.assert_allclose(state.stress, expected, rtol=1e-12)
            np.testing.assert_array_equal(state.cell, cell)
        with self.assertWarns(floc.FlocWarning):
            grains = floc.network(read, tables=["particle_stress"]).tables["particle_stress"]
        volume = np.pi / 4 * 2 / read.solid_fraction / 2
        for a in (0, 1):
            for b in (0, 1):
                self.assertAlmostEqual(grains[f"stress{a + 1}{b + 1}"].sum() * volume / 12.0, expected[a, b], 12)
        info = samples.rows_of("info", file, "--columns", "cell,P")[0]
        self.assertEqual(info["cell"], "4,0;1,3")
        self.assertAlmostEqual(info["P"], np.trace(expected) / 2, 12)


class Copies(unittest.TestCase):
    def test_are_the_same_state(self):
        """pickle, copy and deepcopy restore every array, number and text, for states from files and for packings from
        arrays."""
        states = [floc.read(samples.last_state(name)) for name in samples.SCENES]
        made = floc.Packing.from_arrays([[0.1, 0.2], [1.099, 0.2]], [0.5, 0.5], [1.998, 3.0], "normal.stiffness=1e3")
        names = [name for name in dir(floc.State) if isinstance(getattr(floc.State, name), property)]
        for state in (*states, made):
            copies = [copy.copy(state), copy.deepcopy(state), copy.deepcopy({"of": [state]})["of"][0]]
            for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
                copies.append(pickle.loads(pickle.dumps(state, protocol)))
            for copied in copies:
                self.assertIs(type(copied), type(state))
                for name in names:
                    np.testing.assert_equal(getattr(copied, name), getattr(state, name), name)
                self.assertEqual(floc.moduli(copied, force=True).B, floc.moduli(state, force=True).B)
        print(f"{len(names)} properties of {len(copies)} copies of each of {len(states) + 1} states")

    def test_go_to_other_processes(self):
        states = samples.run("powder")
        with concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
            self.assertEqual(list(pool.map(_solid_fraction, states[:2])), [state.solid_fraction for state in states[:2]])


    def test_of_results(self):
        before, state = samples.run("powder")[-2:]
        path = samples.run("powder").path
        results = [floc.moduli(state, tables=["increments"]), floc.moduli([before, state]), floc.network(state),
                   floc.structure(state), floc.compare(before, state), floc.chain(5, 0.5, 1.0, 1.0, 1.0),
                   floc.fit.cycle(path["P_star"], path["phi"], branch=path["branch"]), samples.run("powder")]
        for result in results:
            for copied in (pickle.loads(pickle.dumps(result)), copy.copy(result), copy.deepcopy(result)):
                self.assertIs(type(copied), type(result))
                self.assertEqual(repr(copied), repr(result))
        with self.assertRaises(AttributeError):
            copy.copy(results[0]).no_column


def _solid_fraction(state):
    return state.solid_fraction


class Refusals(unittest.TestCase):
    def test_missing_file(self):
        with self.assertRaisesRegex(floc.InputError, "nowhere.h5"):
            floc.read("nowhere.h5")
        with self.assertRaises(ValueError):  # as Python's own readers
            floc.read("nowhere.h5")

    def test_damaged_file(self):
        damaged = samples.directory() / "damaged.h5"
        data = bytearray(pathlib.Path(samples.last_state("powder")).read_bytes())
        data[len(data) // 2] ^= 1
        damaged.write_bytes(data)
        with self.assertRaisesRegex(floc.InputError, "damaged.h5"):
            floc.read(damaged)

    def test_no_state(self):
        with self.assertRaises(TypeError):
            floc.moduli(3)
        with self.assertRaisesRegex(floc.InputError, "toml"):
            floc.read(samples.scene_file("powder"))

    @unittest.skipUnless(os.path.isdir("/proc/self"), "needs a directory that nobody can write into")
    def test_file_that_cannot_be_written(self):
        with self.assertRaisesRegex(floc.FileError, "state.h5"):
            floc.read(samples.last_state("powder")).write("/proc/self/state.h5")


if __name__ == "__main__":
    unittest.main()
