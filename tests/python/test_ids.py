"""Tests that grains keep the ids of another program, in every table and message."""
import csv
import io
import re
import subprocess
import unittest
import warnings

import numpy as np

import floc
import samples

LAW = "normal.stiffness=1000,friction.coefficient=0.5,friction.stiffness=800"
# Columns with ids of grains, and the commands that write tables with these columns.
ID_COLUMNS = ("id", "id1", "id2", "grain", "grains")
TABLES = {
    "moduli --increments": ("moduli", "{0}", "--increments", "t.csv"),
    "modes": ("modes", "{0}", "--count", "8"),
    "network --particle-stress": ("network", "{0}", "--particle-stress", "t.csv"),
    "structure --map": ("structure", "{0}", "--map", "t.csv"),
    "compare --displacements": ("compare", "{1}", "{0}", "--displacements", "t.csv"),
    "compare --contacts": ("compare", "{1}", "{0}", "--contacts", "t.csv"),
    "forces --contacts": ("forces", "{0}", "--contacts", "t.csv"),
    "export --grains": ("export", "{0}", "--grains", "t.csv"),
    "export --contacts": ("export", "{0}", "--contacts", "t.csv"),
}
IN_SPACE = ("structure --map", "forces --contacts")


def program(*arguments):
    return subprocess.run([samples.PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=samples.directory(),
                          check=False)


def ids_of(n):
    """Returns ids that differ from the indices and from their order."""
    return 101 + 3 * np.arange(n)[::-1]


def given_ids(state, name):
    """Returns the state as two files: without ids and with ids of its grains."""
    ids = ids_of(state.n_grains)
    contacts = {key: state.contacts[key] for key in
                ("id1", "id2", "image", "normal_force", "shear_force", "kn", "kt", "kr", "rolling_moment")}
    if not contacts["rolling_moment"].any():
        contacts.pop("rolling_moment"), contacts.pop("kr")
    files = []
    for k, names in enumerate((None, ids)):
        one = dict(contacts)
        if names is not None:
            one["id1"], one["id2"] = names[one["id1"]], names[one["id2"]]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", floc.FlocWarning)
            packing = floc.Packing.from_arrays(state.position, state.radius, state.cell, state.law, one, mass=state.mass,
                                               stress=state.target_stress, units=state.units, ids=names)
        files.append(f"{name}_{k}.h5")
        packing.write(samples.directory() / files[-1])
    return files, ids


class Ids(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.files = {}
        for kind in ("powder", "beads"):
            states = [floc.read(path) for path in samples.run(kind).states[-2:]]
            cls.files[kind] = [given_ids(state, f"{kind}{k}") for k, state in enumerate(states)]

    def test_are_in_every_table_that_names_grains(self):
        described = {table for table, columns in floc._core.column_reference().items()
                     if any(name in ID_COLUMNS for name, _, _ in columns)}
        self.assertEqual(described, set(TABLES), "a table names grains that this test does not look at")
        n = 0
        for table, command in TABLES.items():
            kind = "beads" if table in IN_SPACE else "powder"
            (before, ids), (last, _) = self.files[kind]
            written = []
            for k in range(2):
                (samples.directory() / "t.csv").unlink(missing_ok=True)
                done = program(*[part.format(last[k], before[k]) for part in command])
                self.assertEqual(done.returncode, 0, done.stderr)
                path = samples.directory() / "t.csv"
                text = path.read_text(encoding="utf-8") if "t.csv" in command else done.stdout
                written.append(list(csv.DictReader(io.StringIO(text))))
            plain, named = written
            self.assertEqual(len(plain), len(named))
            self.assertGreater(len(plain), 0)
            for a, b in zip(plain, named):
                for column, value in a.items():
                    if column in ID_COLUMNS and value:
                        value = " ".join(str(ids[int(i)]) for i in value.split())
                    elif column in ("file", "before", "after"):
                        continue
                    self.assertEqual(b[column], value, (table, column))
                    n += column in ID_COLUMNS
        print(f"\n{len(TABLES)} tables with ids of grains, {n} values")

    def test_are_in_the_tables_of_a_cemented_sample(self):
        nodes = []
        for file in self.files["powder"][1][0]:
            done = program("lattice", file, "--matrix", "0.1", "--per-diameter", "4", "--stress", "nodes.csv")
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(samples.directory() / "nodes.csv", encoding="utf-8") as table:
                nodes.append([row["grain"] for row in csv.DictReader(table)])
        ids = self.files["powder"][1][1]
        self.assertEqual([str(ids[int(i)]) for i in nodes[0]], nodes[1])

    def test_are_in_every_message(self):
        """Tests messages about a packing that is not in equilibrium, lacks pairs, and has forces that contradict the
        law."""
        grains = "id,x,y,radius\n301,0.5,0.5,0.5\n204,1.49,0.5,0.5\n103,2.45,0.7,0.5\n102,3.44,0.5,0.4\n"
        (samples.directory() / "g.csv").write_text(grains, encoding="utf-8")
        (samples.directory() / "c.csv").write_text("id1,id2,normal_force\n301,204,17\n", encoding="utf-8")
        cell = ("--law", "normal.stiffness=1000", "--cell", "4.2,0;0,4", "--overwrite")
        said = program("convert", "g.csv", "m.h5", "--contacts", "c.csv", *cell)
        self.assertEqual(said.returncode, 0, said.stderr)
        for words in ("(grains 301-204)", "touch but are not listed (grains 204-103 at a gap", "net force of grain 301 in units of the force scale F1"):
            self.assertIn(words, said.stderr)
        self.assertIn("net force of grain 301 in units of the force scale F1", program("moduli", "m.h5").stderr)
        said = program("verify", "m.h5")
        for words in ("grain 301 with", "grain 204 with", "grains 204-103 are missing in the contact list", "grains 301-204 by"):
            self.assertIn(words, said.stdout + said.stderr)
        with_indices = re.compile(r"grains? [0-3]\b")
        for command in ("verify", "moduli", "modes", "network"):
            said = program(command, "m.h5")
            self.assertIsNone(with_indices.search(said.stdout + said.stderr), command)
        (samples.directory() / "same.csv").write_text(grains.replace("3.44,0.5", "2.45,0.7"), encoding="utf-8")
        self.assertIn("grains 103 and 102: the grains have the same centre", program("convert", "same.csv", "s.h5", *cell).stderr)
        (samples.directory() / "k.csv").write_text("id1,id2,normal_force,kn,kt\n301,204,10,2000,0\n", encoding="utf-8")
        self.assertIn("301-204", program("convert", "g.csv", "k.h5", "--contacts", "k.csv", *cell).stderr)
        (samples.directory() / "apart.csv").write_text(grains.replace(",0.5\n", ",0.3\n"), encoding="utf-8")
        said = program("convert", "apart.csv", "a.h5", *cell).stderr
        self.assertIn("no grains touch", said)
        self.assertIsNone(re.search(r"grains? [0-3]-", said), said)
        state = floc.read(samples.directory() / "m.h5")
        self.assertIn("net force of grain 301", state.equilibrium_faults)
        other = program("convert", "g.csv", "o.h5", "--law", "normal.stiffness=1000", "--cell", "4.2,0;0,4", "--columns",
                        "radius=x", "--overwrite")
        self.assertEqual(other.returncode, 4)

    def test_are_read_from_every_format_and_written_to_every_one(self):
        files, ids = self.files["powder"][1]
        state = floc.read(samples.directory() / files[1])
        np.testing.assert_array_equal(state.ids, ids)
        np.testing.assert_array_equal(floc.read(samples.directory() / files[0]).ids, np.arange(len(ids)))
        x = np.column_stack([ids, state.position, np.zeros(len(ids)), state.radius])
        lines = [" ".join(map(repr, [int(row[0]), *row[1:].tolist()])) for row in x]
        cell = state.cell
        by_hand = {
            "i.csv": "id,x,y,z,radius\n" + "".join(line.replace(" ", ",") + "\n" for line in lines),
            "i.txt": "# id x y z r\n" + "\n".join(lines) + "\n",
            "i.dump": (f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{len(ids)}\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
                       "ITEM: ATOMS id x y z radius\n" + "\n".join(lines) + "\n")}
        for name, text in by_hand.items():
            (samples.directory() / name).write_text(text, encoding="utf-8")
        for name in ("i.vtu", "i.xyz", "i.data"):
            self.assertEqual(program("convert", files[1], name, "--overwrite").returncode, 0)
        vectors = ";".join(",".join(map(repr, vector.tolist())) for vector in cell)
        for name in [*by_hand, "i.vtu", "i.xyz", "i.data"]:
            with self.subTest(file=name):
                done = program("convert", name, "i.h5", "--law", state.law, "--cell", vectors, "--tolerance", 1e9, "--overwrite")
                self.assertEqual(done.returncode, 0, done.stderr)
                np.testing.assert_array_equal(floc.read(samples.directory() / "i.h5").ids, ids)

    def test_stay_through_a_run(self):
        file = self.files["powder"][1][0][1]
        contact = samples.POWDER[:samples.POWDER.index("[cell]")].split("[contact]")[1]
        for copies, kept in (("", True), ("copies = [1, 2]\n", False)):
            scene = (f'[scene]\nname = "on"\ndimension = 2\nunits = "reduced"\n[contact]{contact}[cell]\nmass = 1.0\n'
                     f'[assembly]\nprotocol = "state"\nstate = "{file}"\npressure = 0.1\n{copies}'
                     '[[load]]\nname = "on"\nto = 0.2\nsteps_per_decade = 3\n')
            (samples.directory() / "on.toml").write_text(scene, encoding="utf-8")
            done = program("run", "on.toml", "-o", "on", "--overwrite", "--until", 0)
            self.assertEqual(done.returncode, 0, done.stderr)
            ids = floc.read(samples.directory() / "on/state-0000.h5").ids
            np.testing.assert_array_equal(ids, self.files["powder"][1][1] if kept else np.arange(len(ids)))

    def test_of_arrays_are_what_contacts_refer_to(self):
        position, radius, cell = np.array([[0.5, 0.5], [1.49, 0.5], [2.48, 0.5]]), np.full(3, 0.5), [2.97, 3.0]
        ids = np.array([30, 10, 20])
        pairs = {"id1": np.array([30, 10, 20]), "id2": np.array([10, 20, 30]), "normal_force": np.full(3, 10.0)}
        packing = floc.Packing.from_arrays(position, radius, cell, LAW, pairs, ids=ids)
        np.testing.assert_array_equal(packing.ids, ids)
        np.testing.assert_array_equal(np.column_stack([packing.contacts["id1"], packing.contacts["id2"]]),
                                      [[0, 1], [0, 2], [1, 2]])
        self.assertEqual(floc.read(self.written(packing)).ids.tolist(), [30, 10, 20])
        self.assertFalse(packing.ids.flags.writeable)
        for wrong, words in (([1, 2], r"ids: this array has shape \(2,\), expected \(3,\)"), ([1, 2, 1], "id = 1 is given twice"),
                             ([1.0, 2.0, 3.5], "ids has values of type float64, expected integers")):
            with self.assertRaisesRegex(floc.InputError, words):
                floc.Packing.from_arrays(position, radius, cell, LAW, ids=wrong)

    def test_that_count_from_one_are_said_to(self):
        position, radius, cell = np.array([[0.5, 0.5], [1.49, 0.5], [2.48, 1.9]]), np.full(3, 0.5), [4.0, 3.0]
        hint = "the list of contacts seems to number the grains from 1, but they are numbered from 0"
        for pair in ([1, 3], [1, 2]):
            with self.assertRaisesRegex(floc.InputError, hint):
                floc.Packing.from_arrays(position, radius, cell, LAW,
                                         {"id1": pair[:1], "id2": pair[1:], "normal_force": [10.0]})
        with self.assertRaises(floc.InputError) as refused:
            floc.Packing.from_arrays(position, radius, cell, LAW, {"id1": [0], "id2": [3], "normal_force": [1.0]})
        self.assertNotIn(hint, str(refused.exception))

    @staticmethod
    def written(packing):
        path = samples.directory() / "written.h5"
        packing.write(path)
        return path


if __name__ == "__main__":
    unittest.main()
