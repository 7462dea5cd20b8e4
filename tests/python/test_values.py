"""Tests every number and path argument of all functions with invalid values. The result must be an InputError that
names the argument, or a valid result; signals, hangs and other exceptions are faults. The arguments are found in the
stubs, so that new ones are tested automatically. Also tests Ctrl-C in calls that take long."""
import ast
import faulthandler
import math
import os
import pathlib
import signal
import tempfile
import threading
import time
import unittest
import warnings

import floc
import numpy as np
import samples

LIMIT = 20  # seconds that a call may take on a machine that is busy with other things
NEVER = [math.nan, math.inf, -math.inf, "text"]
NEVER_WHOLE = [2**64, 10**30, -(2**64), 1.5, 1e300]
SOMETIMES = [-3, -1, 0, 1e300, True]
PRESSURES = [10.0 ** (0.2 * k - 2) for k in range(20)]
PHI = [0.4 + 0.015 * k for k in range(20)]
LAW = {"normal.stiffness": 1e3, "friction": {"coefficient": 0.5, "stiffness": 1e3}}


def grid():
    return [(a * 0.999, b * 0.999) for a in range(3) for b in range(3)]


def packing(**changes):
    arguments = {"position": grid(), "radius": [0.5] * 9, "cell": [2.997, 2.997], "law": LAW, **changes}
    return floc.Packing.from_arrays(**arguments)


@unittest.skipUnless(hasattr(os, "fork"), "needs fork")
class Values(unittest.TestCase):
    """Returns a call of each function that takes milliseconds, with all optional tables."""

    def calls(self):
        disks = packing()
        everything = ["pdf", "particle_stress", "exponents", "pressure_pdf", "like_neighbours", "clusters"]
        shapes = ["intensity", "pair_correlation", "gaps", "pores", "map", "prediction", "porosity", "profile"]
        compacted = {"e": [2.0 - 0.1 * k for k in range(12)], "p": [0.01 * 2**k for k in range(12)],
                     "sc": [0.002 * (1 + k % 3) for k in range(12)], "se": [50.0] * 12}
        curve = {"pressure": PRESSURES, "solid_fraction": PHI}
        unloaded = {"pressure": PRESSURES + [50.0, 20.0, 10.0, 5.0], "solid_fraction": PHI + [0.67, 0.665, 0.66, 0.658]}
        tables = self.tables()
        return {
            "moduli": (floc.moduli, {"state": disks, "force": True}),
            "network": (floc.network, {"state": disks, "groups": ["bonds", "phases"], "tables": everything}),
            "structure": (floc.structure, {"state": disks, "tables": shapes}),
            "forces": (floc.forces, {"state": disks, "tables": ["contacts"]}),
            "compare": (floc.compare, {"before": disks, "after": disks}),
            "chain": (floc.chain, {"n": 3, "R": 0.5, "kn": 1.0, "kt": 1.0, "kr": 1.0}),
            "plan": (floc.plan, {"scene": samples.SOURCE / "data/scenes/demo.toml", "budget": "2h"}),
            "check_plan": (floc.check_plan, {"directory": samples.run("powder").directory}),
            "run": (self.run_scene, {"scene": samples.scene_file("powder")}),
            "read": (floc.read, {"path": samples.last_state("powder")}),
            "columns": (floc.columns, {"table": "moduli"}),
            "State.vertices": (disks.vertices, {"grain": 0}),
            "State.write": (disks.write, {"path": samples.directory() / "written.h5"}),
            "Run.__init__": (floc.Run, {"directory": samples.run("powder").directory}),
            "Packing.from_arrays": (packing, {}),
            "fit.consolidation": (floc.fit.consolidation, {**curve, "law": "log"}),
            "fit.compression": (floc.fit.compression, {**curve, "law": "heckel"}),
            "fit.preconsolidation": (floc.fit.preconsolidation, curve),
            "fit.elastic": (floc.fit.elastic, unloaded),
            "fit.cycle": (floc.fit.cycle, unloaded),
            "fit.read_table": (floc.fit.read_table, {"table": tables["path"]}),
            "fit.moduli": (floc.fit.moduli, {"tables": tables["moduli"]}),
            "fit.strength": (floc.fit.strength, {"tables": tables["test"]}),
            "fit.dynamic_compaction": (floc.fit.dynamic_compaction, compacted),
            "fit.force_distribution": (floc.fit.force_distribution,
                                       {"forces": [0.1 * k + 0.05 for k in range(30)], "form": "tails", "draws": 2}),
            "plot.forces": (self.plot_forces, {"state": disks}),
        }

    @staticmethod
    def tables():
        """Writes a load path, moduli and a test of strength, and returns the files."""
        texts = {"path": "P_star,phi\n" + "".join(f"{p},{phi}\n" for p, phi in zip(PRESSURES, PHI)),
                 "moduli": "P,phi,B\n" + "".join(f"{10.0**k},{0.7 + 0.03 * k},{10.0**(3 + 0.5 * k) + k % 2}\n" for k in range(6)),
                 "test": "sigma1,sigma3,strain,volumetric_strain\n" + "".join(
                     f"{100 + min(20 * k, 160)},100,{0.001 * k},{-2e-4 * k}\n" for k in range(30))}
        files = {name: samples.directory() / f"{name}.csv" for name in texts}
        for name, text in texts.items():
            files[name].write_text(text)
        return files

    @staticmethod
    def run_scene(**arguments):
        with tempfile.TemporaryDirectory(dir=samples.directory()) as directory:
            return floc.run(**{"directory": directory + "/run", "until": 0, "timing": False, **arguments})

    @staticmethod
    def plot_forces(**arguments):
        try:
            import matplotlib
        except ImportError:
            raise floc.InputError(f"{', '.join(arguments)}: matplotlib is not installed") from None
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
        try:
            return floc.plot.forces(**arguments)
        finally:
            plt.close("all")

    def functions(self):
        """Returns {function: [(parameter, annotation)]} from the stubs."""
        here = pathlib.Path(floc.__file__).parent
        for stub, prefix in (("__init__.pyi", ""), ("fit.pyi", "fit."), ("plot.pyi", "plot.")):
            yield from self.declared(ast.parse((here / stub).read_text()).body, prefix)

    def declared(self, body, prefix):
        for node in body:
            if isinstance(node, ast.ClassDef):
                yield from self.declared(node.body, prefix + node.name + ".")
            elif isinstance(node, ast.FunctionDef):
                arguments = node.args.args + node.args.kwonlyargs
                yield prefix + node.name, [(a.arg, ast.unparse(a.annotation)) for a in arguments
                                           if a.arg not in ("self", "cls") and a.annotation]

    @staticmethod
    def values_of(name, annotation):
        """Returns (value, whether an error must name the argument) for one argument."""
        words = annotation.replace("_", " ").replace("[", " ").replace("]", " ").replace(",", " ").split()
        array = "ArrayLike" in annotation or "Curve" in annotation
        numbers, whole = "float" in words or array, "int" in words
        tried = []
        if numbers or whole:
            never = NEVER + (NEVER_WHOLE if whole and not numbers else [])
            several = {"map_size": 2, "plane": 2, "fit_range": 2, "window": 2, "stress": 2}.get(name, 0)
            for value, refused in [(v, True) for v in never] + [(v, False) for v in SOMETIMES]:
                if array:
                    tried.append(([value] * 9, refused))
                elif several:
                    tried.append(((1, value), refused))
                tried.append((value, refused and not array and not several))
        if name == "directory":  # which a run makes
            tried += [("taken/file", True), ("taken/file/below", True)]
        elif "PathLike" in annotation or "OneState" in annotation:
            tried += [(path, True) for path in ("taken", "nowhere/file", "taken/file/below", "/proc/self/mem")]
        return tried

    def in_child(self, work):
        """Returns the result of `work` as text, or how the child process ended."""
        reader, writer = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(reader)
            signal.signal(signal.SIGALRM, signal.SIG_DFL)
            faulthandler.disable()
            os.chdir(samples.directory())
            for line in work():
                os.write(writer, (line + "\n").encode())
            os._exit(0)
        os.close(writer)
        with os.fdopen(reader, encoding="utf-8", errors="replace") as lines:
            text = lines.read()
        _, status = os.waitpid(child, 0)
        return text.splitlines(), os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0

    def test_are_refused_by_name_or_taken(self):
        taken = samples.directory() / "taken"
        (taken / "inside").mkdir(parents=True, exist_ok=True)
        (taken / "file").write_text("a file\n")
        calls, done, n_functions, n_arguments, n_calls = self.calls(), set(), 0, 0, 0
        for name, parameters in self.functions():
            jobs = [(p, value, refused) for p, a in parameters for value, refused in self.values_of(p, a)]
            if not jobs or name in done:
                continue
            done.add(name)
            if name not in calls and name.endswith("__"):
                continue  # of what the package itself makes, records, fits and progress, and of sequences
            self.assertIn(name, calls, "a call of this function")
            call, base = calls[name]
            n_functions += 1
            n_arguments += len({parameter for parameter, _, _ in jobs})
            n_calls += len(jobs)
            lines, by_signal = self.in_child(lambda: self.tried(call, base, jobs))
            self.assertEqual(by_signal, 0, f"{name} is ended by a signal after {lines[-1:]}")
            for line in lines:
                with self.subTest(function=name):
                    self.assertFalse(line.startswith("FAULT"), f"{name}: {line}")
        print(f"\n{n_functions} functions, {n_arguments} arguments, {n_calls} calls")
        self.assertGreater(n_functions, 12)

    @staticmethod
    def tried(call, base, jobs):
        warnings.simplefilter("ignore")
        for parameter, value, refused in jobs:
            text = f"{parameter} = {value!r}"
            yield text
            signal.alarm(LIMIT)
            try:
                call(**{**base, parameter: value})
            except floc.Error as error:
                words = str(error)
                names = [parameter] if value == "text" or not isinstance(value, str) else [parameter, value]
                if refused and not any(name in words.replace("-", "_") for name in names):
                    yield f"FAULT: {text}: does not name it: {words}"
            except (OSError, TypeError) as error:
                # Error messages of Python itself for values that are not paths.
                if isinstance(value, str) and value != "text" and value in str(error):
                    continue
                yield f"FAULT: {text}: {type(error).__name__}: {error}"
            except Exception as error:  # whatever it is, it should have been an Error
                yield f"FAULT: {text}: {type(error).__name__}: {error}"
            else:
                if refused:
                    yield f"FAULT: {text}: is taken"
            signal.alarm(0)


class Words(unittest.TestCase):
    def refused(self, call, *words):
        with self.assertRaises(floc.InputError) as caught:
            call()
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_name_argument_value_and_range(self):
        state = packing()
        self.refused(lambda: floc.network(state, zero_force=-1), "zero_force = -1", "zero or a positive number")
        self.refused(lambda: floc.network(state, least_contacts=-5), "least_contacts = -5", "from 1 to 100")
        self.refused(lambda: floc.structure(state, slices=0), "slices = 0", "from 1 to 100000")
        self.refused(lambda: floc.structure(state, map_size=[0, 0]), "map_size = 0", "from 1 to 10000")
        self.refused(lambda: floc.structure(state, map_size=[10000, 10000], tables=["map"]), "map_size", "10000000")
        self.refused(lambda: floc.structure(state, cells_per_wave=0), "cells_per_wave = 0", "from 4 to 1000")
        self.refused(lambda: floc.structure(state, reach=math.inf), "reach = inf", "1000")
        self.refused(lambda: floc.chain(-5, 0.5, 1, 1, 1), "n = -5", "from 2 to 1000000")
        self.refused(lambda: floc.chain(10**9, 0.5, 1, 1, 1), "n = 1000000000", "from 2 to 1000000")
        self.refused(lambda: floc.run("s.toml", "r", seed=-3), "seed = -3", "from 0 to 18446744073709551615")
        self.refused(lambda: floc.run("s.toml", "r", until=1e30), "until = 1e+30", "whole number")
        self.refused(lambda: floc.run("s.toml", "r", threads=0), "threads = 0", "from 1 to 1024")
        self.refused(lambda: floc.compare(state, state, rigid_tolerance=math.nan), "rigid_tolerance = nan", "positive")
        self.refused(lambda: floc.fit.force_distribution([1.0] * 20, draws=0), "draws = 0", "from 1 to 100000")
        self.refused(lambda: packing(law=None), "law = None", "expected a dict or a string")
        self.refused(lambda: packing(law={"normal.stiffness": None}), "law: normal.stiffness = None", "number")

    def test_numbers_of_numpy_are_numbers(self):
        state = packing()
        one = floc.structure(state, slices=np.int32(7), reach=np.float32(2.0), tables=["profile"])
        self.assertEqual(len(one.tables["profile"]["phi"]), 7)
        self.assertEqual(floc.chain(np.int64(3), 0.5, np.float64(1), 1, 1).axial.formula, 2.0)


class Interrupted(unittest.TestCase):
    """Tests Ctrl-C while the library computes."""

    def interrupts(self, call):
        main = threading.main_thread().ident
        timer = threading.Timer(0.4, lambda: signal.pthread_kill(main, signal.SIGINT))
        began = time.monotonic()
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                call()
                timer.join()  # the call was done before
                time.sleep(5)
                raise AssertionError("the call was too short to be interrupted")
        finally:
            timer.join()
        self.assertLess(time.monotonic() - began, 10.0)

    def test_calls_raise_keyboard_interrupt(self):
        state = packing()
        forces = [0.1 * k + 0.05 for k in range(3000)]
        self.interrupts(lambda: [floc.network(state, groups=["phases"], shuffles=100000) for _ in range(50)])
        self.interrupts(lambda: floc.fit.force_distribution(forces, form="power-exponential", draws=100000))
        self.interrupts(lambda: floc.fit.consolidation(PRESSURES, PHI, law="log", bootstrap=1000000))
        self.interrupts(lambda: floc.moduli([state] * 100000, force=True))


if __name__ == "__main__":
    unittest.main()
