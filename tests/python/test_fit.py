"""Tests that fits of arrays and tables equal the fits of the command."""
import json
import unittest

import numpy as np

import floc
import samples


def command(*arguments):
    return json.loads(samples.floc_program("fit", *arguments, "--format", "json"))


class Consolidation(unittest.TestCase):
    table = samples.SOURCE / "data/tables/demo"

    def path(self, seed=1):
        with open(self.table / f"seed-{seed}/path.csv", encoding="utf-8") as file:
            header, *lines = file.read().split()
        names = header.split(",")
        rows = [line.split(",") for line in lines]
        column = {name: [row[k] for row in rows] for k, name in enumerate(names)}
        return np.array(column["P_star"], float), np.array(column["phi"], float), column["branch"]

    def same(self, mine, theirs):
        mine, theirs = dict(mine), dict(theirs)
        mine.pop("sample"), theirs.pop("sample")
        self.assertEqual(mine, theirs)

    def test_of_arrays_is_that_of_the_table(self):
        P, phi, branch = self.path()
        theirs = command("consolidation", self.table / "seed-1/path.csv")[0]
        fit = floc.fit.consolidation(P, phi, branch=branch)
        self.same(fit.to_dict(), theirs)
        self.same(floc.fit.consolidation(P, void_ratio=1 / phi - 1, branch=branch, law="log", window=(0.05, 1)).to_dict(),
                  self.by_void_ratio(P, phi, branch))
        self.assertEqual(fit["lambda"].interval, (theirs["parameters"]["lambda"]["low95"],
                                                  theirs["parameters"]["lambda"]["high95"]))
        self.assertTrue(fit.found)

    def by_void_ratio(self, P, phi, branch):
        file = samples.directory() / "e.csv"
        lines = [f"{p!r},{e!r},{b}" for p, e, b in zip(P.tolist(), (1 / phi - 1).tolist(), branch)]
        file.write_text("P_star,void_ratio,branch\n" + "\n".join(lines) + "\n")
        return command("consolidation", file, "--law", "log", "--window", "0.05,1")[0]

    def test_of_several_samples(self):
        seeds = [self.path(seed) for seed in (1, 2, 3)]
        fits = floc.fit.consolidation([s[0] for s in seeds], [s[1] for s in seeds], branch=[s[2] for s in seeds])
        theirs = command("consolidation", *(self.table / f"seed-{seed}/path.csv" for seed in (1, 2, 3)))
        for mine, one in zip(fits, theirs, strict=True):
            self.same(mine.to_dict(), one)
        self.assertEqual(fits[-1].sample, "pooled")
        for mine, one in zip(floc.fit.consolidation(self.table), command("consolidation", self.table), strict=True):
            self.assertEqual(mine.to_dict(), one)

    def test_of_a_data_frame(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("no pandas")
        frame = pandas.read_csv(self.table / "seed-1/path.csv", float_precision="round_trip")
        fit = floc.fit.consolidation(frame["P_star"], frame["phi"], branch=frame["branch"])
        self.same(fit.to_dict(), command("consolidation", self.table / "seed-1/path.csv")[0])

    def test_with_options(self):
        P, phi, branch = self.path()
        fit = floc.fit.consolidation(P, phi, branch=branch, P0=0.0316, loss="cauchy", weights="uniform", bootstrap=10,
                                     seed=7)
        self.same(fit.to_dict(), command("consolidation", self.table / "seed-1/path.csv", "--P0", "0.0316", "--loss",
                                         "cauchy", "--weights", "uniform", "--bootstrap", "10", "--seed", "7")[0])

    def test_compression_is_that_of_the_command(self):
        P, phi, branch = self.path()
        theirs = command("compression", self.table / "seed-1/path.csv", "--D0", "0.5")
        for mine, one in zip(floc.fit.compression(P, phi, branch=branch, D0=0.5), theirs, strict=True):
            self.same(mine.to_dict(), one)

    def test_that_the_data_do_not_allow(self):
        fit = floc.fit.consolidation([1.0, 2.0], [0.5, 0.51])
        self.assertFalse(fit.found)
        self.assertIn("pressures", fit.refusal)

    def test_refusals_name_the_array(self):
        cases = [((([1, 2, 3], [0.5, 0.51])), {}, r"solid_fraction: this array has shape \(2,\), expected "
                                                      r"the shape of pressure, \(3,\)"),
                 (([1, 2, 3], [0.5, 0.6, 50.0]), {}, r"arrays\[2\]: phi = 50"),
                 (([1, 2, np.nan], [0.5, 0.6, 0.7]), {}, r"pressure\[2\]: this number is nan"),
                 (([[[1, 2]]], [[[1, 2]]]), {}, r"pressure: this array has shape"),
                 ((["a"], [0.5]), {}, "pressure: expected an array of numbers"),
                 (([1, 2, 3],), {}, "solid_fraction or void_ratio"),
                 (([1, 2, 3], [0.5, 0.6, 0.7]), {"law": "cubic"}, 'law = "cubic": expected one of auto, full, log, power'),
                 (([1, 2, 3], [0.5, 0.6, 0.7]), {"window": (2, 1)}, "window"),
                 (([1, 2, 3], [0.5, 0.6, 0.7]), {"branch": ["load"]},
                  "branch: this argument has 1 names, expected one per pressure, 3")]
        for arguments, keywords, words in cases:
            with self.assertRaisesRegex(floc.InputError, words):
                floc.fit.consolidation(*arguments, **keywords)

    def test_refusals_name_the_array_with_a_mask(self):
        right, masked = [1.0, 2.0, 3.0], np.ma.array([1.0, 2.0, 3.0], mask=[0, 0, 1])
        phi, hidden = [0.5, 0.6, 0.7], np.ma.array([0.5, 0.6, 0.7], mask=[0, 1, 0])
        calls = []
        for fit in (floc.fit.consolidation, floc.fit.preconsolidation, floc.fit.elastic, floc.fit.cycle):
            calls += [("pressure", lambda fit=fit: fit(masked, phi)), ("solid_fraction", lambda fit=fit: fit(right, hidden)),
                      ("void_ratio", lambda fit=fit: fit(right, void_ratio=hidden)),
                      ("pressure", lambda fit=fit: fit([right, masked], [phi, phi]))]
        for k, name in enumerate(("e", "p", "sc", "se")):
            calls.append((name, lambda k=k: floc.fit.dynamic_compaction(*[masked if k == j else right for j in range(4)])))
        calls.append(("forces", lambda: floc.fit.force_distribution(masked)))
        for name, call in calls:
            with self.assertRaisesRegex(floc.InputError, rf"{name}\[\d\]: this entry is masked, expected a value"):
                call()
        print(f"{len(calls)} masked arrays of fits refused")


class Tables(unittest.TestCase):
    table = samples.SOURCE / "data/tables/your-test/oedometer.csv"

    def test_are_read_as_the_command_reads_them(self):
        path = floc.fit.read_table(self.table)
        self.assertEqual(path.unit, "kPa")
        self.assertIn("read 14 rows: pressure in kPa, void ratio; 2 reversals", path.reading)
        self.assertEqual(len(path), 14)
        self.assertEqual(path.pressure[0], 12.5)
        self.assertAlmostEqual(path.solid_fraction[0], 1 / 1.7770, 12)
        mine = floc.fit.consolidation(path.pressure, path.solid_fraction)
        theirs = floc.fit.consolidation(self.table)
        self.assertEqual(mine["lambda"].to_dict(), theirs["lambda"].to_dict())

    def test_in_a_die_are_read_without_bound(self):
        file = samples.directory() / "die.csv"
        file.write_text("P,phi\n1,0.8\n2,0.95\n3,1.01\n")
        with self.assertRaisesRegex(floc.InputError, "measured in a die under load"):
            floc.fit.read_table(file)
        self.assertEqual(floc.fit.read_table(file, phi_limit=None).solid_fraction[-1], 1.01)
        with self.assertRaisesRegex(floc.InputError, r"arrays\[2\]: phi = 1.01"):
            floc.fit.cycle([1, 2, 3], [0.8, 0.95, 1.01])
        floc.fit.cycle([1, 2, 3], [0.8, 0.95, 1.01], phi_limit=None)


class Tests(unittest.TestCase):
    def same(self, mine, theirs):
        self.assertEqual([fit.to_dict() for fit in mine], theirs)

    def test_of_failures_and_planes(self):
        folder = samples.directory()
        (folder / "failures.csv").write_text("sigma1 [kPa],sigma3 [kPa]\n208,50\n350,100\n640,200\n1235,400\n")
        (folder / "planes.csv").write_text("sigma_n,tau\n50,40\n100,71\n200,130\n")
        for name in ("failures.csv", "planes.csv"):
            fits = floc.fit.strength(folder / name)
            self.same(fits, command("strength", folder / name))
            self.assertIn("friction_angle_peak", fits[-1].parameters)
        with self.assertRaisesRegex(floc.InputError, "kind"):
            floc.fit.strength(folder / "planes.csv", kind="torsion")

    def test_of_moduli(self):
        file = samples.directory() / "moduli.csv"
        file.write_text("P,phi,B\n" + "".join(f"{p},{0.6 + 0.01 * k},{3.0 * p ** 0.4}\n"
                                              for k, p in enumerate((1, 2, 4, 8, 16, 32, 64))))
        fits = floc.fit.moduli(file)
        self.same(fits, command("moduli", file))
        self.assertAlmostEqual(fits[0]["exponent"].value, 0.4, 9)
        self.assertEqual([fit.against for fit in fits], ["P", "phi"])


class OtherFits(unittest.TestCase):
    def test_of_a_run(self):
        run = samples.directory() / "powder"
        samples.run("powder")
        for mine, name in ((floc.fit.elastic(run), "elastic"), (floc.fit.preconsolidation(run), "preconsolidation")):
            theirs = json.loads(samples.floc_program("fit", name, run, "--format", "json",
                                                     code=3 if name == "preconsolidation" else 0) or "[]")
            self.assertEqual([fit.to_dict() for fit in mine], theirs, name)
        elastic = floc.fit.elastic(run)[0]
        path = floc.Run(run).path
        arrays = floc.fit.elastic(path["P"], path["phi"], branch=path["branch"])[0]
        self.assertEqual(arrays["B"].to_dict(), elastic["B"].to_dict())
        self.assertIsNone(arrays.state)

    def test_preconsolidation(self):
        file = next((samples.SOURCE / "data/tables/reload").rglob("*.csv"))
        theirs = command("preconsolidation", file)
        self.assertGreater(len(theirs), 0)
        self.assertEqual([fit.to_dict() for fit in floc.fit.preconsolidation(file)], theirs)

    def test_cycle(self):
        file = next((samples.SOURCE / "data/tables/reload").rglob("*.csv"))
        theirs = json.loads(samples.floc_program("fit", "cycle", file, "--format", "json"))
        mine = floc.fit.cycle(file)
        self.assertGreater(len(theirs), 0)
        for name in ("P", "phi_up", "phi_down", "dphi_irr"):
            self.assertEqual(list(mine[name]), [row[name] for row in theirs])

    def test_force_distribution(self):
        file = samples.last_state("powder")
        theirs = json.loads(samples.floc_program("fit", "force-distribution", file, "--format", "json"))
        self.assertEqual([fit.to_dict() for fit in floc.fit.force_distribution(file)], theirs)
        forces = floc.read(file).contacts["normal_force"]
        self.assertEqual([fit.to_dict()["parameters"] for fit in floc.fit.force_distribution(forces)],
                         [fit["parameters"] for fit in theirs])

    def test_dynamic_compaction(self):
        file = next((samples.SOURCE / "data/tables/compaction").rglob("*.csv"))
        table = np.genfromtxt(file, delimiter=",", names=True, comments="#")
        if not {"e", "p", "sc", "se"} <= set(table.dtype.names):
            self.skipTest(f"{file} has {table.dtype.names}")
        theirs = json.loads(samples.floc_program("fit", "dynamic-compaction", file, "--format", "json"))[0]
        mine = floc.fit.dynamic_compaction(*(table[name] for name in ("e", "p", "sc", "se")))
        self.assertEqual({**mine.to_dict(), "sample": None}, {**theirs, "sample": None})
        with self.assertRaisesRegex(floc.InputError, "sample 0: p = -1"):
            floc.fit.dynamic_compaction([0.5], [-1.0], [1.0], [1.0])


if __name__ == "__main__":
    unittest.main()
