"""Tests that states survive a round trip through every format that can be written, that files of other programs give
periodic axes and dimension, and that every table and message uses the ids of grains."""
import csv
import io
import itertools
import json
import re
import shlex
import subprocess
import unittest
import warnings

import numpy as np

import floc
import samples

FORMATS = ("vtu", "xyz", "data")
LAW = "normal.stiffness=1000"
WET = ("normal.stiffness=1000,adhesion.law=capillary,adhesion.surface_tension=1,adhesion.contact_angle=0,"
       "adhesion.water_content=0.01,adhesion.density_ratio=2.5,adhesion.form=exponential,adhesion.formation=gap")


def convert(*arguments, code=0):
    """Returns the messages of floc convert."""
    done = subprocess.run([samples.PROGRAM, "convert", *map(str, arguments), "--overwrite"], capture_output=True, text=True,
                          cwd=samples.directory(), check=False)
    if done.returncode != code:
        raise AssertionError(f"convert {arguments}: code {done.returncode}, not {code}\n{done.stderr}")
    return done.stderr


def lattice_state(name, cell, repeats, law=LAW, radius=0.5):
    """Returns a crystal with one grain at each corner of `cell`, repeated."""
    cell = np.array(cell, dtype=float)
    position = np.array([np.array(k) @ cell for k in itertools.product(*map(range, repeats))]) + 0.05
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", floc.FlocWarning)
        state = floc.Packing.from_arrays(position, np.full(len(position), radius), np.diag(repeats) @ cell, law)
    path = samples.directory() / f"{name}.h5"
    state.write(path)
    return path


def states():
    """Returns a state of every kind, by the name of the kind."""
    s = 0.998
    cube, square = s * np.eye(3), s * np.eye(2)
    triangle = s * np.array([[1, 0], [0.5, np.sqrt(0.75)]])
    fcc = s / np.sqrt(2) * np.array([[0, 1, 1], [1, 0, 1], [1, 1, 0]])
    high = np.diag([s, s, 1.7])
    hertz = "normal.modulus=1e4,normal.poisson=0.3"
    return {
        "powder": samples.last_state("powder"), "beads": samples.last_state("beads"),
        "disks": lattice_state("disks", square, (3, 3)), "spheres": lattice_state("spheres", cube, (3, 3, 3)),
        "slanted disks": lattice_state("slanted_disks", triangle, (3, 2)),
        "slanted spheres": lattice_state("slanted_spheres", fcc, (2, 3, 2)),
        "left-handed": lattice_state("left_handed", fcc[::-1], (2, 2, 2)),
        "hertz": lattice_state("hertz", cube, (2, 2, 2), hertz),
        "layer": lattice_state("layer", cube, (2, 2, 1)), "high layer": lattice_state("high_layer", high, (2, 2, 1)),
        "row": lattice_state("row", cube, (3, 1, 1)), "one sphere": lattice_state("one_sphere", cube, (1, 1, 1)),
        "one slanted sphere": lattice_state("one_slanted_sphere", fcc, (1, 1, 1)),
        "one disk": lattice_state("one_disk", square, (1, 1)),
        "one slanted disk": lattice_state("one_slanted_disk", triangle, (1, 1)),
        "small disks": lattice_state("small_disks", 1e-3 * square, (2, 2), radius=5e-4),
        "large disks": lattice_state("large_disks", 7 * square, (2, 2), radius=3.5),
        "wet disks": lattice_state("wet_disks", 1.003 * square, (3, 3), WET),
        "wet spheres": lattice_state("wet_spheres", 1.003 * cube, (2, 2, 2), WET),
    }


class EveryFormat(unittest.TestCase):
    def test_gives_back_what_it_was_given(self):
        kinds = states()
        for (name, path), extension in itertools.product(kinds.items(), FORMATS):
            with self.subTest(state=name, format=extension):
                state = floc.read(path)
                convert(path, f"there.{extension}")
                words = convert(f"there.{extension}", "back.h5", "--law", state.law, "--units", state.units, "--tolerance", 1e9)
                self.assertNotIn("taken as", words)
                back = floc.read(samples.directory() / "back.h5")
                self.assertEqual(back.dimension, state.dimension)
                self.assertEqual(back.n_grains, state.n_grains)
                self.assertEqual(back.n_contacts, state.n_contacts)
                np.testing.assert_array_equal(back.ids, state.ids + (extension == "data"))
                self.assertAlmostEqual(back.pressure / state.pressure, 1.0, delta=1e-8)
                self.assertAlmostEqual(back.solid_fraction / state.solid_fraction, 1.0, delta=1e-13)
        print(f"\n{len(kinds)} kinds of states through {len(FORMATS)} formats and back")

    def test_gives_back_walls(self):
        path = samples.last_state("box")
        state = floc.read(path)
        for extension in FORMATS:
            with self.subTest(format=extension):
                convert(path, f"box.{extension}")
                words = convert(f"box.{extension}", "back.h5", "--law", LAW)
                self.assertNotIn("free space", words)
                back = floc.read(samples.directory() / "back.h5")
                lowest = [wall["position"] for wall in state.walls if wall["side"] < 0]
                self.assertEqual([(w["axis"], w["side"], w["open"]) for w in back.walls],
                                 [(w["axis"], w["side"], w["open"]) for w in state.walls])
                np.testing.assert_allclose([w["position"] for w in back.walls],
                                           [w["position"] - lowest[k // 2] for k, w in enumerate(state.walls)], atol=1e-12)
                self.assertEqual(len(back.contacts), (~state.contacts["distant"]).sum())
                sides = np.diag(state.cell) + 2.0
                words = convert(f"box.{extension}", "apart.h5", "--law", LAW, "--cell", f"{sides[0]},0;0,{sides[1]}")
                self.assertEqual(floc.read(samples.directory() / "apart.h5").n_contacts,
                                 (state.contacts["id2"] < state.n_grains).sum() - (state.contacts["distant"]).sum())


def xyz(cell, rows, keys):
    lattice = " ".join(str(x) for x in np.ravel(cell))
    lines = "".join(f"X {x} {y} {z} {r}\n" for x, y, z, r in rows)
    return "s.xyz", f"{len(rows)}\nLattice=\"{lattice}\" Properties=species:S:1:pos:R:3:radius:R:1 {keys}\n{lines}"


def dump(cell, rows, flags="pp pp pp", low=0.0, tilts=""):
    bounds = "".join(f"{low if a == 2 else 0} {cell[a][a] + (low if a == 2 else 0)}{tilts}\n" for a in range(3))
    lines = "".join(f"{x} {y} {z} {r}\n" for x, y, z, r in rows)
    return "s.dump", (f"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{len(rows)}\nITEM: BOX BOUNDS{flags and ' ' + flags}\n{bounds}"
                      f"ITEM: ATOMS x y z radius\n{lines}")


def data(cell, rows, title="packing", low=0.0, style="sphere"):
    bounds = "".join(f"{low if a == 2 else 0} {cell[a][a] + (low if a == 2 else 0)} {c}lo {c}hi\n" for a, c in enumerate("xyz"))
    lines = "".join(f"{k + 1} 1 {2 * r} 1 {x} {y} {z}\n" for k, (x, y, z, r) in enumerate(rows))
    return "s.data", f"{title}\n\n{len(rows)} atoms\n1 atom types\n\n{bounds}\nAtoms # {style}\n\n{lines}"


def yade(cell, rows):
    return "s.txt", ("# cell " + " ".join(str(x) for x in np.ravel(cell)) + "\n# x y z r\n" +
                     "".join(f"{x} {y} {z} {r}\n" for x, y, z, r in rows))


def vtu(cell, rows, fields=""):
    def array(kind, name, numbers, components=1):
        return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">' +
                " ".join(map(str, np.ravel(numbers))) + "</DataArray>")

    rows = np.array(rows)
    return "s.vtu", ('<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"><UnstructuredGrid><FieldData>' +
                     array("Float64", "cell", cell, 3) + fields + f'</FieldData><Piece NumberOfPoints="{len(rows)}"><Points>' +
                     array("Float64", "Points", rows[:, :3], 3) + "</Points><PointData>" +
                     array("Float64", "radius", rows[:, 3]) + "</PointData></Piece></UnstructuredGrid></VTKFile>")


def layer(height, z=0.4, radius=0.5):
    """Returns cell and rows of four grains on a square lattice, each of which touches its neighbours."""
    s = 0.998
    rows = [(0.25 + s * a, 0.25 + s * b, z, radius) for a in range(2) for b in range(2)]
    return np.diag([2 * s, 2 * s, height]), rows


class FilesOfOtherPrograms(unittest.TestCase):
    def read(self, written, *options, code=0):
        name, text = written
        (samples.directory() / name).write_text(text, encoding="utf-8")
        words = convert(name, "foreign.h5", "--law", LAW, *options, code=code)
        return words, floc.read(samples.directory() / "foreign.h5") if code == 0 else None

    def test_of_one_layer_are_of_the_dimension_that_follows(self):
        """A layer of grains in three cells: so low that spheres touch their images, as high as a slab of disks, and
        too low."""
        low, high, flat = layer(0.998), layer(1.5), layer(0.1)
        middle = layer(0.998, z=0.0)
        mixed = (low[0], [(*row[:3], 0.5 - 0.02 * (k == 3)) for k, row in enumerate(low[1])])
        leaning = (low[0] + np.array([[0, 0, 0], [0, 0, 0], [0.2, 0, 1]]), low[1])
        as_disks, as_spheres, doubt = "taken as disks", "taken as spheres", "warning: every z is the same, so the grains are taken as disks"
        silent = "taken as"
        every = [(writer, cell_and_rows, options, words, dimension)
                 for writer in (lambda c, r: xyz(c, r, 'pbc="T T T"'), dump, data, yade, vtu)
                 for cell_and_rows, options, words, dimension in (
                     (low, (), as_spheres, 3), (high, (), as_disks, 2), (flat, (), doubt, 2), (mixed, (), doubt, 2),
                     (low, ("--dimension", 2), None, 2), (low, ("--dimension", 3), None, 3), (high, ("--dimension", 3), None, 3),
                     (low, ("--cell", "1.996,0;0,1.996"), None, 2), (low, ("--cell", "1.996,0,0;0,1.996,0;0,0,2"), None, 3))]
        every += [(lambda c, r: xyz(c, r, 'pbc="T T F"'), low, (), as_disks, 2),
                  (lambda c, r: dump(c, r, "pp pp ff"), low, (), as_disks, 2),
                  (lambda c, r: dump(c, r, low=-0.499), middle, (), doubt, 2),
                  (lambda c, r: data(c, r, low=-0.499), middle, (), doubt, 2),
                  (lambda c, r: xyz(c, r, 'pbc="T T T"'), leaning, (), "tilted along z, so the grains are taken as spheres", 3),
                  (yade, leaning, (), "tilted along z, so the grains are taken as spheres", 3),
                  (vtu, leaning, (), "tilted along z, so the grains are taken as spheres", 3),
                  (lambda c, r: xyz(c, r, 'pbc="T T T" dimension=3'), high, (), None, 3),
                  (lambda c, r: xyz(c, r, 'pbc="T T T" dimension=2'), low, (), None, 2),
                  (lambda c, r: data(c, r, "floc: dimension 3, boundary p p p"), high, (), None, 3),
                  (lambda c, r: data(c, r, "floc: dimension 2, boundary p p p"), low, (), None, 2)]
        for k, (writer, (cell, rows), options, words, dimension) in enumerate(every):
            with self.subTest(case=k, options=options):
                said, state = self.read(writer(cell, rows), *options, "--tolerance", 1e9)
                self.assertEqual(state.dimension, dimension, said)
                if words:
                    self.assertIn(words, said)
                else:
                    self.assertNotIn("every z is the same", said)
                per_grain = 2 if dimension == 2 else 2 + (cell[2][2] < 1 and "0,0,2" not in str(options))
                if not np.any(cell - np.diag(np.diag(cell))) and rows[3][3] == 0.5:
                    self.assertEqual(state.n_contacts, 4 * per_grain)
        print(f"\n{len(every)} files of a layer: 5 formats, heights, flags, tilts, options")
        self.assertIn("not converted", self.read(xyz(*flat, 'pbc="T T T"'), "--strict", code=5)[0])

    def test_that_are_not_periodic_are_open_or_walled_unless_a_cell_is_given(self):
        cell, rows = layer(3.0)
        spheres = [(*row[:2], 0.4 + 0.1 * k, row[3]) for k, row in enumerate(rows)]
        walls = '<DataArray type="Float64" Name="walls" NumberOfComponents="3" format="ascii">{} -1 0 {} 1 3</DataArray>'
        n = 0
        for grains, dimension in ((rows, 2), (spheres, 3)):
            for axes in range(dimension):
                letters = ["f" if a == axes else "p" for a in range(3)]
                pbc = " ".join("F" if a == axes else "T" for a in range(3))
                files = [xyz(cell, grains, f'pbc="{pbc}"'), xyz(cell, grains, f'pbc="{pbc.replace("F", "0").replace("T", "1")}"'),
                         dump(cell, grains, " ".join(2 * a for a in letters)),
                         data(cell, grains, f"floc: walls at the faces across x: boundary {' '.join(letters)}, fix wall/gran"),
                         vtu(cell, grains, walls.format(axes, axes))]
                for k, written in enumerate(files):
                    with self.subTest(axis=axes, dimension=dimension, text=written[1][:200]):
                        n += 1
                        walled = k == 4 or k == 3 and axes == 0
                        words, state = self.read(written, "--tolerance", 1e9)
                        self.assertEqual("it ends in free space there" in words, not walled)
                        self.assertEqual([(w["axis"], w["open"]) for w in state.walls], 2 * [(axes, not walled)])
                        size = "4,0;0,4" if dimension == 2 else "4,0,0;0,4,0;0,0,4"
                        words, state = self.read(written, "--cell", size, "--tolerance", 1e9)
                        self.assertEqual(state.dimension, dimension)
                        self.assertNotIn("taken as", words)
        print(f"\n{n} files that say walls or not periodic")

    def test_that_do_not_say_are_said_to_be_taken_as_periodic(self):
        for written, said in ((data(*layer(1.5)), True), (xyz(*layer(1.5), ""), True), (xyz(*layer(1.5), 'pbc="T T F"'), False),
                              (dump(*layer(1.5)), False), (data(*layer(1.5), "boundary p p p"), False),
                              (data(*layer(1.5), style="granular"), True)):
            words, state = self.read(written, "--tolerance", 1e9)
            self.assertEqual("taken as periodic in every direction, because the file does not say" in words, said, written)
            self.assertEqual(state.n_contacts, 8)

    def test_of_a_dump_with_few_flags_or_none_take_the_cell_that_is_given(self):
        for flags in ("pp pp", "", "ff pp", "pp", "mm fs ss"):
            words, state = self.read(dump(*layer(1.5), flags), "--cell", "1.996,0;0,1.996", "--tolerance", 1e9)
            self.assertEqual(state.n_contacts, 8)
        self.assertIn("expected BOX BOUNDS", self.read(dump(*layer(1.5), "pp pp"), code=4)[0])

    def test_of_words_that_mean_nothing_are_refused(self):
        cell, rows = layer(1.5)
        for keys in ('pbc="T T"', 'pbc="yes yes no"', "dimension=4", "dimension=two"):
            self.assertRegex(self.read(xyz(cell, rows, keys), code=4)[0], "s.xyz:2: .*expected")

    def test_that_lie_at_several_heights_are_no_disks(self):
        cell, rows = layer(1.5)
        rows[2] = (*rows[2][:2], 0.9, 0.5)
        for written in (xyz(cell, rows, 'pbc="T T T"'), dump(cell, rows), data(cell, rows), yade(cell, rows), vtu(cell, rows)):
            for options in (("--dimension", 2), ("--cell", "1.996,0;0,1.996")):
                self.assertRegex(self.read(written, *options, code=4)[0], "z = 0.9, but z = 0.4 at .*: expected the same z for all disks")

    def test_print_the_stress_by_rows(self):
        (samples.directory() / "grains.csv").write_text("id,x,y,radius\n0,0,0,0.5\n1,0.99,0,0.5\n", encoding="utf-8")
        (samples.directory() / "pairs.csv").write_text("id1,id2,force1,force2\n0,1,-10,3\n", encoding="utf-8")
        words = convert("grains.csv", "s.h5", "--contacts", "pairs.csv", "--law",
                        LAW + ",friction.coefficient=1,friction.stiffness=500", "--cell", "4,0;0,4")
        said = [float(x) for x in re.search(r"stress ([-0-9. ]+)", words).group(1).split()]
        stress = floc.read(samples.directory() / "s.h5").stress
        np.testing.assert_allclose(said, np.ravel(stress), rtol=1e-5)
        self.assertNotEqual(stress[0][1], stress[1][0])


if __name__ == "__main__":
    unittest.main()
