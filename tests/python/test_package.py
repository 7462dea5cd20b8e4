"""Tests the names, messages and pictures of the package."""
import ast
import pathlib
import subprocess
import sys
import unittest

import floc
import samples


class Names(unittest.TestCase):
    @staticmethod
    def stub(name):
        return ast.parse((pathlib.Path(floc.__file__).parent / f"{name}.pyi").read_text())

    def named(self, tree):
        names = set()
        for node in tree.body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                names.add(node.name)
            elif isinstance(node, ast.AnnAssign):
                names.add(node.target.id)
            elif isinstance(node, ast.ImportFrom):
                names |= {alias.asname for alias in node.names if alias.asname}
        return {name for name in names if not name.startswith("_")}

    def test_are_all_in_the_stubs(self):
        public = {name for name in dir(floc) if not name.startswith("_")}
        self.assertEqual(public, set(floc.__all__))
        self.assertEqual(self.named(self.stub("__init__")), public)
        for module in (floc.fit, floc.plot):
            stub = self.named(self.stub(module.__name__.split(".")[1]))
            self.assertEqual(stub, set(module.__all__))

    def members(self, cls):
        for node in self.stub("__init__").body:
            if isinstance(node, ast.ClassDef) and node.name == cls:
                return {member.target.id if isinstance(member, ast.AnnAssign) else member.name
                        for member in node.body if isinstance(member, (ast.AnnAssign, ast.FunctionDef))}
        raise AssertionError(cls)

    def test_of_states_are_in_the_stub(self):
        public = {name for name in dir(floc.State) if not name.startswith("_")}
        self.assertEqual({name for name in self.members("State") if not name.startswith("_")}, public)
        self.assertEqual(self.members("Packing"), {"from_arrays"})
        self.assertEqual(self.members("Run") - {"__init__", "__len__", "__getitem__"},
                         {"directory", "states", "path"})

    def test_of_columns_are_in_the_stub(self):
        for name in ("powder", "beads"):
            file = samples.last_state(name)
            before = str(samples.run(name).states[-2])
            import warnings
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", floc.FlocWarning)
                records = [floc.moduli(file, "full", prestress=True, rolling_stiffness=[1.0])[0] if name == "powder"
                           else floc.moduli(file, "full"),
                           floc.network(file, groups=("bonds", "phases")), floc.structure(file),
                           floc.compare(before, file)]
            for record in records:
                missing = set(record) - self.members(type(record).__name__)
                self.assertEqual(missing, set(), type(record).__name__)

    def test_have_docstrings(self):
        for name in floc.__all__:
            if name != "commit":
                self.assertTrue(getattr(floc, name).__doc__, name)
        self.assertIn("error_B (stress): ", floc.Moduli.__doc__)
        for name in dir(floc.State):
            if not name.startswith("_"):
                self.assertTrue(getattr(floc.State, name).__doc__, name)


class Columns(unittest.TestCase):
    def test_are_those_of_the_program(self):
        rows = samples.rows_of("help", "columns", "moduli")
        mine = [("moduli", *column) for column in floc.columns("moduli")]
        self.assertEqual(mine, [(r["table"], r["column"], r["unit"] or "", r["meaning"]) for r in rows
                                if r["table"] == "moduli"])
        with self.assertRaisesRegex(floc.InputError, 'the nearest is "moduli"'):
            floc.columns("modulus")

    def test_are_attributes(self):
        moduli = floc.moduli(samples.last_state("powder"))
        self.assertEqual(moduli.B, moduli["B"])
        self.assertEqual(moduli.B, moduli.to_dict()["B"])
        self.assertIn("B", dir(moduli))
        self.assertIn("B_voigt", repr(moduli))
        with self.assertRaisesRegex(AttributeError, "'B_voight'; the nearest is 'B_voigt'"):
            moduli.B_voight


class Import(unittest.TestCase):
    def test_without_numpy_says_what_is_missing(self):
        script = "import sys; sys.modules['numpy'] = None; import floc"
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
        self.assertIn("ImportError: floc needs numpy: Debian's package is python3-numpy", done.stderr)

    def test_loads_neither_matplotlib_nor_pandas(self):
        script = "import floc, sys; sys.exit(bool({'matplotlib', 'pandas'} & set(sys.modules)))"
        self.assertEqual(subprocess.run([sys.executable, "-c", script]).returncode, 0)

    def test_without_matplotlib_says_so_when_it_draws(self):
        script = ("import sys; sys.modules['matplotlib'] = None; sys.modules['matplotlib.pyplot'] = None\n"
                  f"import floc; floc.plot.forces({samples.last_state('powder')!r})")
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
        self.assertIn("ImportError: floc.plot needs matplotlib", done.stderr)

    def test_version(self):
        self.assertIn(floc.__version__, samples.floc_program("--version"))
        self.assertIn(floc.commit, samples.floc_program("--version"))


class Pictures(unittest.TestCase):
    def test_draw_each_contact_in_the_axes_given(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("no matplotlib")
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
        for name in samples.SCENES:
            state = floc.read(samples.last_state(name))
            figure, ax = plt.subplots()
            lines = floc.plot.forces(state, ax)
            contacts = state.contacts
            across = contacts["image"].any(axis=1) & (contacts["id2"] < state.n_grains)
            self.assertEqual(len(lines.get_segments()), state.n_contacts + across.sum())
            widths = lines.get_linewidths()[:state.n_contacts]
            self.assertEqual(abs(contacts["normal_force"]).argmax(), max(range(len(widths)), key=widths.__getitem__))
            self.assertIs(lines.axes, ax)
            figure.savefig(samples.directory() / f"{name}.png")
            plt.close(figure)
        with self.assertRaisesRegex(floc.InputError, "plane"):
            floc.plot.forces(samples.last_state("powder"), plane=(0, 2))


if __name__ == "__main__":
    unittest.main()
