"""Tests that every number equals the number that the command prints, to the last bit."""
import contextlib
import csv
import io
import threading
import unittest
import warnings

import numpy as np

import floc
import samples

# Columns that differ between two calls, such as times.
TIMING = {"seconds", "seconds_row"}


class Same(unittest.TestCase):
    def assert_row(self, record, row):
        mine = {name: value for name, value in record.to_dict().items() if name not in TIMING}
        theirs = {name: value for name, value in row.items() if name not in TIMING}
        self.assertEqual(list(record), list(row))
        self.assertEqual(mine, theirs)

    def assert_table(self, table, text):
        """Compares a table of arrays with a csv file."""
        names, *rows = csv.reader(io.StringIO(text))
        self.assertEqual(list(table), names)
        self.assertGreater(len(rows), 0)
        for k, name in enumerate(names):
            cells = [row[k] for row in rows]
            if table[name].dtype.kind in "if":
                np.testing.assert_array_equal(table[name], [float(cell) if cell else np.nan for cell in cells], name)
            elif table[name].dtype.kind == "U":
                self.assertEqual(list(table[name]), cells, name)


class Moduli(Same):
    def test_of_every_kind_of_state(self):
        for name in samples.SCENES:
            file = samples.last_state(name)
            force = ("--force",) if floc.read(file).equilibrium_faults else ()
            row = samples.rows_of("moduli", file, *force)[0]
            self.assert_row(floc.moduli(file, force=bool(force)), row)

    def test_with_options(self):
        file = samples.last_state("powder")
        state = floc.read(file)
        for options, keywords in ((("--strains", "full"), {"strains": "full"}),
                                  (("--prestress",), {"prestress": True}),
                                  (("--method", "single-factor"), {"method": "single-factor"}),
                                  (("--accuracy", "B=0.5"), {"accuracy": {"B": 0.5}}),
                                  (("--force-tolerance", "1e-4"), {"force_tolerance": 1e-4})):
            self.assert_row(floc.moduli(state, **keywords), samples.rows_of("moduli", file, *options)[0])
        rows = samples.rows_of("moduli", file, "--rolling-stiffness", "0.5,2")
        for record, row in zip(floc.moduli(state, rolling_stiffness=[0.5, 2.0]), rows, strict=True):
            self.assert_row(record, row)

    def test_by_bounds_where_they_hold(self):
        n_refused = 0
        for name in samples.SCENES:
            file = samples.last_state(name)
            exact = floc.moduli(file, force=True)
            if exact.bounds_hold:
                force = ("--force",) if floc.read(file).equilibrium_faults else ()
                row = samples.rows_of("moduli", file, "--method", "bounds", *force)[0]
                self.assert_row(floc.moduli(file, method="bounds", force=bool(force)), row)
            else:
                n_refused += 1
                with self.assertRaisesRegex(floc.InputError, ": method bounds cannot be applied to this state: "):
                    floc.moduli(file, method="bounds", force=True)
        self.assertGreater(n_refused, 0)
        self.assertLess(n_refused, len(samples.SCENES))

    def test_of_several_states(self):
        files = [str(path) for path in samples.run("powder").states[-2:]]
        records = floc.moduli(files)
        for record, row in zip(records, samples.rows_of("moduli", *files), strict=True):
            self.assert_row(record, row)
        self.assertEqual(records.to_dict()["B"], [record.B for record in records])

    def test_increments(self):
        file = samples.last_state("powder")
        samples.floc_program("moduli", file, "--increments", "increments.csv")
        record = floc.moduli(file, tables=["increments"])
        self.assert_table(record.tables["increments"], (samples.directory() / "increments.csv").read_text())

    def test_of_no_equilibrium(self):
        state = floc.read(samples.last_state("powder"))
        with self.assertWarnsRegex(floc.FlocWarning, "not in equilibrium"):
            off = floc.Packing.from_arrays(state.position, state.radius, state.cell, state.law, tolerance=1e-12,
                                           stress=2 * state.target_stress)
        with self.assertRaisesRegex(floc.EquilibriumError, "not in equilibrium: .*force=True computes"):
            floc.moduli(off)
        with self.assertWarnsRegex(floc.FlocWarning, "not in equilibrium"):
            floc.moduli(off, force=True)

    def test_bad_words(self):
        file = samples.last_state("powder")
        with self.assertRaisesRegex(floc.InputError, 'strains = "ful": expected one of diagonal, full'):
            floc.moduli(file, "ful")
        with self.assertRaisesRegex(floc.InputError, "tolerance"):
            floc.moduli(file, tolerance=-1.0)
        with self.assertRaisesRegex(floc.InputError, "walls"):
            floc.moduli(samples.last_state("box"), "full", force=True)

    def test_leaves_other_threads_alone(self):
        """Another thread counts while moduli are computed, so the interpreter is not blocked."""
        state = floc.read(samples.last_state("powder"))
        large = tiled(state, 15)
        ticks = []
        done = threading.Event()

        def count():
            while not done.wait(0.001):
                ticks.append(None)

        thread = threading.Thread(target=count)
        thread.start()
        before = len(ticks)
        floc.moduli(large)
        during = len(ticks) - before
        done.set()
        thread.join()
        self.assertGreater(during, 10)

    def test_leaves_numpy_its_threads(self):
        """OpenBLAS uses one thread while floc uses it, and afterwards as many as before."""
        import ctypes
        try:
            blas = ctypes.CDLL("libopenblas.so.0")
        except OSError:
            self.skipTest("another BLAS")
        before = blas.openblas_get_num_threads()
        try:
            blas.openblas_set_num_threads(2)
            floc.moduli(samples.last_state("powder"))
            self.assertEqual(blas.openblas_get_num_threads(), 2)
        finally:
            blas.openblas_set_num_threads(before)


def tiled(state, copies):
    """Returns a packing repeated along both axes."""
    shifts = np.array([(a, b) for a in range(copies) for b in range(copies)])
    position = (state.position[None] + (shifts @ state.cell)[:, None]).reshape(-1, 2)
    return floc.Packing.from_arrays(position, np.tile(state.radius, len(shifts)), copies * state.cell, state.law,
                                    tolerance=1e3)


class Forces(Same):
    def test_are_those_of_the_command(self):
        file = samples.last_state("beads")
        for options, keywords in (((), {}), (("--selection", "canonical"), {"selection": "canonical"}),
                                  (("--kn", "1", "--kt", "2"), {"kn": 1.0, "kt": 2.0}),
                                  (("--friction", "1"), {"friction": 1.0}), (("--gap", "1e-3"), {"gap": 1e-3})):
            self.assert_row(floc.forces(file, **keywords), samples.rows_of("forces", file, *options)[0])

    def test_of_contacts_with_their_ranges(self):
        file = samples.last_state("beads")
        contacts = floc.forces(file, tables="contacts", range_of=[0, 2]).tables["contacts"]
        self.assertEqual(len(contacts["contact"]), floc.read(file).n_contacts)
        self.assertLessEqual(contacts["smallest_normal_force"][0], contacts["normal_force"][0])


class Network(Same):
    def test_of_states(self):
        for name in ("powder", "beads"):
            file = samples.last_state(name)
            self.assert_row(floc.network(file), samples.rows_of("network", file)[0])
        file = samples.last_state("powder")
        self.assert_row(floc.network(file, groups=("bonds", "phases"), zero_force=1e-4),
                        samples.rows_of("network", file, "--with", "bonds,phases", "--zero-force", "1e-4")[0])
        self.assert_row(floc.network(file, without="mechanics"),
                        samples.rows_of("network", file, "--without", "mechanics")[0])

    def test_tables(self):
        file = samples.last_state("powder")
        tables = floc.network(file, tables=["pdf", "particle_stress"]).tables
        samples.floc_program("network", file, "--pdf", "pdf.csv", "--particle-stress", "stress.csv")
        self.assert_table(tables["pdf"], (samples.directory() / "pdf.csv").read_text())
        self.assert_table(tables["particle_stress"], (samples.directory() / "stress.csv").read_text())

    def test_of_walls(self):
        file = samples.last_state("box")
        network = floc.network(file)
        self.assert_row(network, samples.rows_of("network", file)[0])
        self.assertIsNone(network.hyperstaticity)


class Structure(Same):
    def test_of_states(self):
        for name in ("powder", "beads"):
            file = samples.last_state(name)
            with self.catch():
                self.assert_row(floc.structure(file), samples.rows_of("structure", file)[0])
        files = [str(path) for path in samples.run("powder").states[-2:]]
        with self.catch():
            records = floc.structure(files, average=True, tables=["pair_correlation"])
        for record, row in zip(records, samples.rows_of("structure", *files, "--average", "--pair-correlation", "g.csv"),
                               strict=True):
            self.assert_row(record, row)
        self.assert_table(records.tables["pair_correlation"], (samples.directory() / "g.csv").read_text())

    @staticmethod
    @contextlib.contextmanager
    def catch():
        """Small states have no fit of I(k). The package issues a warning about this."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", floc.FlocWarning)
            yield

    def test_of_walls(self):
        file = samples.last_state("box")
        self.assert_row(floc.structure(file, tables=["porosity"]), samples.rows_of("structure", file)[0])
        with self.assertRaisesRegex(floc.InputError, "walls"):
            floc.structure(file, tables=["map"])


class Compare(Same):
    def test_two_states(self):
        for name in ("powder", "beads"):
            before, after = (str(path) for path in samples.run(name).states[-2:])
            record = floc.compare(before, after, tables=["displacements", "contacts"])
            row = samples.rows_of("compare", before, after, "--displacements", "u.csv", "--contacts", "c.csv")[0]
            self.assert_row(record, row)
            self.assert_table(record.tables["displacements"], (samples.directory() / "u.csv").read_text())
            self.assert_table(record.tables["contacts"], (samples.directory() / "c.csv").read_text())

    def test_other_grains(self):
        with self.assertRaisesRegex(floc.InputError, "3D"):
            floc.compare(samples.last_state("powder"), samples.last_state("beads"))


class Chain(unittest.TestCase):
    def test_formulas_and_solved(self):
        for bend in (0.0, 2.0):
            mine = floc.chain(20, 0.5, 1.0, 1.0, 1e-4, bend=bend)
            rows = samples.rows_of("chain", "--n", 20, "--R", 0.5, "--kn", 1, "--kt", 1, "--kr", "1e-4", "--bend", bend)
            for row in rows:
                compliance = mine[row["compliance"]]
                for column in ("formula", "solved", "error_bound"):
                    self.assertEqual(compliance[column], row[column])
        self.assertEqual(floc.chain(20, 0.5, 1.0, 1.0, 1e-4).axial.formula, 19.0)

    def test_refused(self):
        with self.assertRaisesRegex(floc.InputError, "n"):
            floc.chain(1, 0.5, 1.0, 1.0, 1.0)


if __name__ == "__main__":
    unittest.main()
