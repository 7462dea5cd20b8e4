"""Tests every text format that floc reads with faults of other programs and editors: other encodings, line ends of
old Macs, decimal commas. Tables with these faults are read; files of other formats are refused with a message that
names all faults. A byte order mark of UTF-8 is accepted."""
import re
import subprocess
import unittest

import samples
import test_formats

CELL = "1.996,0;0,1.996"
LAW = test_formats.LAW
STICKY = "adhesion.law=constant,adhesion.force=10,friction.coefficient=1,friction.stiffness=500"
COMMA = "with a decimal point, not a comma"
CAMPAIGN = """[campaign]
scene = "s.toml"
seeds = "1..2"
[[collect]]
table = "path"
columns = ["phi"]
"""


def grains(separator):
    _, rows = test_formats.layer(1.5)
    return "".join(separator.join(map(str, row)) + "\n" for row in [("x", "y", "z", "radius")] + rows)


def curve(separator):
    """Returns a path with a bend, an unloading and a reloading."""
    lines = [separator.join(["P_star", "phi"])]
    pressures = [0.1 * 1.5**k for k in range(12)]
    for k, P in enumerate(pressures + pressures[-2:4:-1] + pressures[6:]):
        lines.append(f"{P:.6f}{separator}{0.5 + 0.011 * min(k, 11) - 0.0005 * max(k - 11, 0):.6f}")
    return "\n".join(lines) + "\n"


def files():
    """Returns for each kind of file, by its name: file name, text, and the command that reads it."""
    cell, rows = test_formats.layer(1.5)
    convert = f"convert {{}} o.h5 --overwrite --tolerance 1e9 --law {LAW}"
    with_cell = convert + f" --cell '{CELL}'"
    of_contacts = f"convert good.csv o.h5 --overwrite --tolerance 1e9 --law {LAW},{STICKY} --cell '{CELL}' --contacts {{}}"
    pairs = [(0, 1, 0.5, -2.5), (2, 3, 0.5, -2.5)]
    yade_pairs = "# id1 id2 fnx fny fnz fsx fsy fsz\n" + "".join(f"{a} {b} 0.5 {-f:.1f} 0.0 0.0 0.0 0.0\n" for a, b, _, f in pairs)
    entries = ("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n2\nITEM: BOX BOUNDS pp pp pp\n0 2.5\n0 2.5\n0 2.5\nITEM: ENTRIES id1 id2 "
               "force1 force2\n" + "".join(f"{a} {b} {f:.1f} {g:.1f}\n" for a, b, f, g in pairs))
    found = {
        "yade cell": (*test_formats.yade(cell, rows), convert), "dump": (*test_formats.dump(cell, rows), convert),
        "data": (*test_formats.data(cell, rows), convert), "vtu": (*test_formats.vtu(cell, rows), convert),
        "extended XYZ": (*test_formats.xyz(cell, rows, 'pbc="T T T"'), convert),
        "yade": ("bare.txt", "# " + grains(" ").replace("radius", "r"), with_cell),
        "csv without extension": ("grains.dat", grains(","), with_cell + " --from csv"),
        "jamBashbulk": ("jam.txt", "N = 4 ,L1= { 1.996 , 0.0 } ,L2= { 0.0 , 1.996 } ,P = 0.001 ,P0= 0.001 ,\n{\n" +
                        "".join(f"{x:.3f} ,\t{y:.3f} ,\t{r:.3f} ,\n" for x, y, _, r in rows) + "}\n",
                        "convert {} o.h5 --overwrite --tolerance 1e9"),
        "contacts of YADE": ("c.txt", yade_pairs, of_contacts), "contacts of LAMMPS": ("c.dump", entries, of_contacts),
        "diameters": ("diameters.txt", "0.5 0.75\n" * 20, "scene check list.toml"),
        "scene": ("s.toml", samples.POWDER, "scene check {}"), "campaign": ("c.toml", CAMPAIGN, "campaign check {}"),
        "forces": ("forces.csv", "normal_force\n" + "".join(f"{0.25 + 0.1 * k:.2f}\n" for k in range(60)), "fit force-distribution {}"),
        "compaction": ("shots.csv", "e,p,sc,se\n" + "".join(f"0.{9 - k}5,{k + 1}.5,0.5,20.5\n" for k in range(9)),
                       "fit dynamic-compaction {}"),
    }
    for kind, separator in (("commas", ","), ("semicolons", ";"), ("tabs", "\t")):
        found[f"csv, {kind}"] = (f"grains_{kind}.csv", grains(separator), with_cell)
        found[f"contacts, {kind}"] = (f"contacts_{kind}.csv", "".join(
            separator.join(map(str, row)) + "\n" for row in [("id1", "id2", "force1", "force2")] + pairs), of_contacts)
        for command in ("fit consolidation {}", "fit elastic {}", "fit cycle {}", "fit preconsolidation {}",
                        "plot {} --show consolidation -o o.svg"):
            found[f"{command}, {kind}"] = (f"table_{kind}.csv", curve(separator), command)
        found[f"stdin, {kind}"] = ("-", curve(separator), "fit cycle -")
    return found


FAULTS = {
    "UTF-16": (lambda text: text.encode("utf-16"), "the file is in the encoding UTF-16: save it as UTF-8"),
    "UTF-16 without mark": (lambda text: text.encode("utf-16-be"), "the file is in the encoding UTF-16: save it as UTF-8"),
    "carriage returns": (lambda text: text.replace("\n", "\r").encode(), "lines of this file end in carriage returns alone"),
    "decimal commas": (lambda text: re.sub(r"(\d)\.(\d)", r"\1,\2", text).encode(), COMMA),
}
# Faults that are accepted: XML has no lines. In scenes a comma ends a value, which causes an error message of TOML.
READ = {("vtu", "carriage returns")}
NO_NUMBERS = {"scene", "campaign"}


def is_table(kind):
    """Returns whether files of a kind are tables, which are read in all these dialects."""
    return kind.startswith(("csv", "contacts, ", "fit ", "plot ", "stdin, ")) or kind in ("forces", "compaction")


def is_ambiguous(kind, fault):
    """Returns whether decimal commas cannot be distinguished from commas between cells."""
    return fault == "decimal commas" and (kind.endswith("commas") or kind in ("csv without extension", "compaction"))


class TextFiles(unittest.TestCase):
    def floc(self, command, name, content):
        where = samples.directory()
        (where / "good.csv").write_text(grains(","), encoding="utf-8")
        (where / "s.toml").write_text(samples.POWDER, encoding="utf-8")
        (where / "list.toml").write_text(samples.POWDER.replace(
            '{distribution = "uniform", min = 0.5, max = 1.0}', '{distribution = "list", file = "diameters.txt"}'), encoding="utf-8")
        if name != "-":
            (where / name).write_bytes(content)
        return subprocess.run(f"{samples.PROGRAM} {command.format(name)}", shell=True, capture_output=True, cwd=where, check=False,
                              input=content if name == "-" else b"")

    def test_are_read_with_a_byte_order_mark_and_with_line_ends_of_windows(self):
        n = 0
        for kind, (name, text, command) in files().items():
            plain = self.floc(command, name, text.encode())
            self.assertIn(plain.returncode, (0, 3), f"{kind}: {plain.stderr}")
            for change in (lambda t: b"\xef\xbb\xbf" + t.encode(), lambda t: t.replace("\n", "\r\n").encode()):
                with self.subTest(kind=kind, text=change(text)[:40]):
                    n += 1
                    done = self.floc(command, name, change(text))
                    self.assertEqual((done.returncode, done.stdout, done.stderr), (plain.returncode, plain.stdout, plain.stderr))
        print(f"\n{n} files of {len(files())} kinds with a byte order mark or line ends of Windows read")

    def test_with_a_fault_of_their_encoding_are_refused_by_its_name(self):
        n = 0
        for kind, (name, text, command) in files().items():
            for fault, (change, words) in FAULTS.items():
                if (kind, fault) in READ or (kind in NO_NUMBERS and fault == "decimal commas"):
                    continue
                if is_table(kind) and not is_ambiguous(kind, fault):
                    continue
                with self.subTest(kind=kind, fault=fault):
                    n += 1
                    done = self.floc(command, name, change(text))
                    said = done.stderr.decode()
                    self.assertEqual(done.returncode, 4, said)
                    self.assertIn(words, said)
                    file = "stdin" if name == "-" else name
                    place = rf"{re.escape(file)}(:\d+|, array [^:]*)" if fault == "decimal commas" else re.escape(file)
                    self.assertRegex(said, place + ": .*" + re.escape(words))
        print(f"\n{n} files of {len(files())} kinds with {len(FAULTS)} faults refused by name")

    def test_are_read_as_tables_in_every_encoding_and_with_decimal_commas(self):
        n = 0
        for kind, (name, text, command) in files().items():
            if not is_table(kind):
                continue
            plain = self.floc(command, name, text.encode())
            for fault, (change, _) in FAULTS.items():
                if is_ambiguous(kind, fault):
                    continue
                with self.subTest(kind=kind, fault=fault):
                    n += 1
                    done = self.floc(command, name, change(text))
                    self.assertEqual((done.returncode, done.stdout), (plain.returncode, plain.stdout), done.stderr)
        print(f"\n{n} tables with {len(FAULTS)} faults read")

    def test_whose_columns_are_separated_by_blanks_are_read(self):
        for separator in (" ", "   "):
            for name, text, plain, command in (
                    ("blanks.csv", grains(separator), grains(","), f"convert {{}} o.h5 --overwrite --law {LAW} --cell '{CELL}'"),
                    ("blanks.txt", grains(separator), grains(","), f"convert {{}} o.h5 --overwrite --from csv --law {LAW} --cell '{CELL}'"),
                    ("blanks.txt", grains(separator), grains(","), f"convert {{}} o.h5 --overwrite --law {LAW} --cell '{CELL}'"),
                    ("blanks.csv", curve(separator), curve(","), "fit consolidation {}"),
                    ("blanks.csv", curve(separator), curve(","), "fit elastic {}")):
                done, expected = self.floc(command, name, text.encode()), self.floc(command, name, plain.encode())
                self.assertEqual((done.returncode, done.stdout), (expected.returncode, expected.stdout), done.stderr)


if __name__ == "__main__":
    unittest.main()
