#!/usr/bin/env python3
"""Runs every command in README and the pages of docs/, and compares every printed number with the output.

    numbers_test.py --floc PROGRAM --source DIRECTORY [--long]

Without --long, only tests of a few seconds run: commands on the demo and on shipped tables. With --long, tests of
minutes to an hour run. A block of commands runs in a shell, in a directory with the data/ of the repository. A
command that occurs on several pages runs once. A block of "text" directly after the commands is their output, line by
line; lines may be left out. Every other block of output and every table must have a check below, or an entry with a
reason why it cannot be checked (UNCHECKED_TABLES, NOT_RUN); otherwise the test fails. A number agrees if it rounds to
the printed digits.

The path of the demo is chaotic: its bits depend on the kernels that OpenBLAS chooses for the processor, or that
OPENBLAS_CORETYPE names. If these are not the kernels of the pages (DEMO_KERNELS), the commands still run, but the
numbers of the demo differ. The test then prints how many numbers did not agree.
"""
import argparse
import contextlib
import csv
import ctypes
import io
import math
import os
import re
import runpy
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

import numpy

import pages
import shapes

# Blocks of commands that are not run, found by a part of their text, with the reason.
NOT_RUN = {
    ".ci/demo    # installs": "installs packages and builds; .ci/demo is a script of its own",
    "floc_mutate csv 1000000": "a million mutations take hours; the fuzz tests run 5000 of each",
    "(cd build/release && cpack)": "builds packages; install.packages does that",
    "apt install ./": "installs packages; install.packages does that",
    "ln -s /usr/share/floc data": "likewise",
    "cmake --install build/release --prefix": "builds and installs; install.find_package does that",
    "cmake -S . -B build -DCMAKE_PREFIX_PATH": "a project of the user; install.find_package builds one",
    "export PATH=": "where the program is",
    "export PYTHONPATH=": "where the package is",
    "docs/write-help --floc": "writes into the reader's home; help_test.py tries it",
    ".ci/deps     # installs": "installs packages and builds",
    "ninja -C build/apart floc unit_network_tests": "builds; the tests are those that run here",
    "quasistatic/study.py": "two hours",
    "snakemake --jobs 50": "a cluster; tests/slurm/run has one of its own",
    "mpirun -n 4 floc moduli": "needs MPI; tests/cli/petsc_test.cc runs it",
    "floc fit dynamic-compaction TABLE": None,  # line by line, see LINES_NOT_RUN
}
LINES_NOT_RUN = {
    "floc fit dynamic-compaction TABLE": "TABLE is the reader's",
    "floc structure seeds/seed-*": "seeds/ is the reader's ensemble; as --average in the tests of structure",
    "floc plot biaxial": "biaxial/ is the reader's run of a test; as in the tests of directed runs",
    "| rsvg-convert": "another program's; the picture in a pipe is tested by draw_test",
}
LONG = {
    "floc run data/scenes/demo.toml -o ensemble": "four samples of the demo",
    "floc fit consolidation ensemble": "with them",
    "floc tradeoff data/scenes/demo.toml": "ten minutes",
    "floc tradeoff data/scenes/cemented3d.toml": "five minutes",
    "--track-contacts 0.1": "a run of its own",
    "--bootstrap 1000": "a minute",
    "-o frames/ --as png": "forty pictures",
    "floc run data/scenes/cemented2d.toml": "some minutes; floc lattice on its state as many again",
    "floc lattice grains/": "likewise",
    "floc run data/tables/lattice/sample1000.toml": "for the next line",
    "floc lattice cemented/": "six seconds each",
    "floc run data/scenes/polyhedra_demo.toml": "twenty seconds",
    "floc draw stones/": "with them",
    "cd friction && snakemake": "six runs of the demo's size",
    "cd plan && snakemake": "two minutes",
    "floc plan --check plan": "with them",
}
# Tables, found by a part of their header, whose numbers no command prints, or whose numbers differ between runs.
UNCHECKED_TABLES = {
    "| group | meaning |": "words",
    "| law | | parameters |": "words",
    "| samples | 0.05 |": "80 000 fits; the long tests hold the range",
    "| parameter | construction |": "words",
    "| | loose | dense |": "processor time",
    "| command | 4000 beads | 32 000 beads |": "processor time and memory",
    "| packing | instructions | double | single | gain |": "processor time",
    "| column | meaning |": "words",
    "| quantity | floc's name |": "words",
    "| column of a contact | meaning |": "words",
    "| read | from |": "words",
    "| file | shows |": "words; tests/python runs them",
    "| program | its law |": "words; validation tests convert packings by these laws",
    "| code | meaning |": "words",
    "| key | meaning |": "words",
    "| You want | Use |": "words",
    "| `control` | driven axis |": "words",
    "| test | parameter |": "words",
    "| normal | adhesion |": "words",
    "| setting | Phi | z | beta | time |": "36 runs of a quarter of a minute and more",
    "| place | holds |": "words",
    "| member | says | without it |": "members of a model, which the conformance suite asks for",
    "| criterion | default |": "defaults, which the tests of scenes hold",
    "| grains | physics | portable": "processor time",
    "| grains | portable": "processor time",
    "| physics | program | million": "processor time",
    "| | 500 | 4000 |": "processor time",
    "| what | range tested |": "ctest -L extremes holds them",
    "| module | holds |": "a test holds the layers",
    "| file | holds |": "words",
    "| page | what you find there |": "words",
    "| slot | `law` | its keys |": "words",
    "| option | takes | meaning |": "docs/generate writes it, and pages_test.py holds it",
    "| command | does |": "words",
    "| option of `floc moduli` | meaning |": "words",
    "| packing, z | processes | preconditioner |": "processor time",
    "| column | unit | meaning |": "docs/generate writes it, and pages_test.py holds it",
    "| `grains.diameter.distribution` |": "words",
    "| part of a run |": "defaults, which the tests of scenes hold",
    "| part | what it is |": "words",
    "| cell.mass | samples |": "an hour; study.py makes samples of the kind",
    "| grains | seeds | solid fraction |": "means over flows, whose bits hang on OpenBLAS",
    "| P | B, dP > 0 |": "floc_pressure_response takes an hour",
}

# OpenBLAS kernels with which the numbers of the demo were made.
DEMO_KERNELS = "SkylakeX"
# Commands that make the run of the demo, or read it.
OF_DEMO = re.compile(r"(?<!tables/)\bdemo\b(?!\.toml)")

DEMO = re.compile(r"floc run data/scenes/demo\.toml -o demo( |$)")


def blas_kernels():
    """Returns the name of the OpenBLAS kernels that the program uses; the program does not keep the slow fallback
    kernels."""
    name = ctypes.CDLL("libopenblas.so.0").openblas_get_corename
    name.restype = ctypes.c_char_p
    kernels = name().decode()
    if kernels == "Prescott" and "OPENBLAS_CORETYPE" not in os.environ:
        flags = set(open("/proc/cpuinfo").read().split())
        if {"avx512f", "avx512dq", "avx512bw", "avx512vl"} <= flags:
            return "SkylakeX"
        if {"avx2", "fma"} <= flags:
            return "Haswell"
    return kernels


class Test:
    def __init__(self, floc, source, long):
        self.floc = floc
        self.source = source
        self.long = long
        self.docs = pages.Documentation(source)
        self.ran = set()
        self.faults = []
        self.progress_of_demo = ""
        self.kernels = blas_kernels()
        self.on_demo = False  # what is compared hangs on the path of the demo
        self.n_other = 0
        self.claimed_blocks = set()
        self.claimed_tables = set()
        self.directory = tempfile.mkdtemp(prefix="floc-docs-")
        shutil.copytree(os.path.join(source, "data"), os.path.join(self.directory, "data"))
        self.environment = dict(os.environ, PATH=os.path.dirname(floc) + os.pathsep + os.environ["PATH"])

    # Functions for the checks.

    def fault(self, words):
        print("FAULT:", words, flush=True)
        self.faults.append(words)

    def differs(self, words):
        """Reports a number, or a line with numbers, that differs from the page."""
        if not self.on_demo or self.kernels == DEMO_KERNELS:
            return self.fault(words)
        self.n_other += 1
        print("OTHER PATH:", words.split("\n")[0], flush=True)

    @contextlib.contextmanager
    def hanging_on_demo(self, hangs=True):
        self.on_demo = hangs
        try:
            yield
        finally:
            self.on_demo = False

    def shell(self, command, expected=0):
        began = time.time()
        done = subprocess.run(["bash", "-c", "set -o pipefail; " + command], cwd=self.directory, env=self.environment,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace")
        print(f"{time.time() - began:7.1f} s  {command}", flush=True)
        if done.returncode != expected:
            # Exit code 3 is a result of a fit or a run, which depends on numbers.
            (self.differs if done.returncode == 3 else self.fault)(f"exit code {done.returncode}, expected {expected}: {command}\n{done.stderr[-2000:]}")
        return done

    def rows(self, command):
        return list(csv.DictReader(io.StringIO(self.shell(command + " --format csv").stdout)))

    def number(self, shown, value, what):
        if not pages.rounds_to(shown, float(value)):
            self.differs(f"{what}: the page says {shown}, the program {value}")

    def mean_and_scatter(self, shown, values, what):
        """Compares a text "mean +- standard deviation" with the values of samples."""
        mean, deviation = shown.split(" +- ")
        self.number(mean, statistics.mean(values), what)
        self.number(deviation, statistics.stdev(values), what + ", scatter")

    def number_or_none(self, shown, value, what):
        """Compares a number; the page shows "-" if the program has no value."""
        if shown == "-" or value in ("", "-"):
            if shown != "-" or value not in ("", "-"):
                self.differs(f"{what}: the page says {shown}, the program {value!r}")
        else:
            self.number(shown, value, what)

    def claim_block(self, part):
        text = self.docs.block(part)
        self.claimed_blocks.add(text)
        return text

    def claim_table(self, part):
        self.claimed_tables.add(part)
        return self.docs.table(part)

    # Checks of the blocks of commands.

    def commands(self):
        for page in self.docs.pages:
            for k, (language, text, line) in enumerate(page.blocks):
                if language != "sh" or any(part in text and why for part, why in NOT_RUN.items()):
                    continue
                with self.hanging_on_demo(bool(OF_DEMO.search(text))):
                    said = self.run_block(text)
                    following = page.blocks[k + 1] if k + 1 < len(page.blocks) else ("", "", 0)
                    if said is not None and following[0] == "text":
                        self.claimed_blocks.add(following[1])
                        self.compare_lines(following[1], said, f"{page.name}:{following[2]}")

    def run_block(self, text):
        """Runs the commands of a block. @return their output; None if some command is not run"""
        printed, left_out = [], False
        for command in text.replace("\\\n", " ").split("\n"):
            command = re.sub(r"\s+# .*", "", command).strip()
            if not command:
                continue
            if (any(part in command for part in LINES_NOT_RUN) or command in self.ran or
                    any(part in command for part in LONG) != self.long):
                left_out = True
                continue
            self.ran.add(command)
            self.prepare(command)
            done = self.shell(command)
            printed.append(done.stdout + done.stderr)
            if DEMO.match(command) and "--resume" not in command:
                self.progress_of_demo = done.stderr
        return None if left_out else "".join(printed)

    def compare_lines(self, shown, said, where):
        """Checks that every line of the page was printed. Spaces may differ, and numbers may be rounded."""
        def parts(line):
            line = " ".join(line.split())
            return pages.NUMBER.sub("#", line), pages.NUMBER.findall(line)

        printed = [parts(line) for line in said.split("\n")]
        for line in shown.strip().split("\n"):
            words, numbers = parts(line)
            if not any(words == other and all(map(pages.rounds_to, numbers, map(float, values)))
                       for other, values in printed):
                self.differs(f"{where}: the program does not print {line!r}, but\n{said[-3000:]}")

    def prepare(self, command):
        """Makes the input files that the pages describe in words."""
        if re.search(r" demo([/ ]|$)", command) and not DEMO.match(command) and not self.exists("demo"):
            self.shell("floc run data/scenes/demo.toml -o demo")
        if "floc draw" in command and "spheres.h5" in command and not self.exists("spheres.h5"):
            self.shell("floc run data/scenes/spheres_demo.toml -o spheres --set grains.count=60 --until 1 && "
                       "cp spheres/state-0001.h5 spheres.h5")
        if "grains.csv crystal.h5" in command:
            open(os.path.join(self.directory, "grains.csv"), "w").write(self.docs.block("x,y,r\n"))
        if "cd friction && snakemake" in command:
            self.shell("floc campaign new friction && floc campaign plan friction.toml -o friction")
        if "demo again" in command:
            self.shell("cp -r demo again")

    def exists(self, name):
        return os.path.exists(os.path.join(self.directory, name))

    # Checks of numbers that take seconds.

    def demo_moduli(self):
        rows = self.rows("floc moduli demo/state-*.h5")
        path = self.path("demo/path.csv")
        names = ["B_reuss", "B_S", "B", "B_voigt", "G", "G_voigt"]
        for cells in self.claim_table("| branch | P*"):
            row = rows[self.step_at(path, cells[0], cells[1])]
            for name, shown in zip(["phi", "z"] + names, cells[2:]):
                self.number(shown, row[name], f"demo, {cells[0]} P* = {cells[1]}, {name}")
            for low, high in zip(["B_reuss", "B_S", "B"], ["B_S", "B", "B_voigt"]):
                if float(row[low]) > float(row[high]):
                    self.fault(f"{low} > {high} at P* = {cells[1]}")

    @staticmethod
    def step_at(path, branch, pressure):
        """Returns the step of a branch at the pressure nearest to the printed one. Loading begins with the
        assembly."""
        branches = {"load", "assembly"} if branch == "load" else {branch}
        return min((abs(math.log(float(r["P_star"]) / float(pressure))), k) for k, r in enumerate(path)
                   if r["branch"] in branches and float(r["P_star"]) > 0)[1]

    def path(self, name):
        return list(csv.DictReader(open(os.path.join(self.directory, name))))

    def fit_of_demo_tables(self):
        rows = self.rows("floc fit consolidation data/tables/consolidation")
        pooled = {r["parameter"]: r for r in rows if r["sample"] == "pooled"}
        names = {"P1*": "P1_star", "P0*": "P0_star"}
        for name, value, error, interval in self.claim_table("| parameter | value "):
            row = pooled[names.get(name, name)]
            for shown, column in ((value, "value"), (error, "stderr")):
                self.number_or_none(shown, row[column], f"fit of data/tables/consolidation, {column} of {name}")
            low, high = interval.split(" to ")
            self.number(low, row["low95"], f"fit of data/tables/consolidation, low95 of {name}")
            self.number(high, row["high95"], f"fit of data/tables/consolidation, high95 of {name}")

    def demo_results(self):
        """Checks the last lines of floc demo: the fit of the demo, and the fit of six samples, which README also
        prints."""
        said = self.shell("floc demo demo").stdout
        lines = said.strip().split("\n")
        fitted = {line.split()[0]: line.split() for line in lines[-10:-1]}
        names = {"P1*": "P1_star", "P0*": "P0_star"}
        for name, value, error, _ in self.docs.table("| parameter | value "):
            cells = fitted.get(names.get(name, name))
            if not cells or len(cells) != 4:
                self.fault(f"floc demo: no line of {name} in\n{said[-1000:]}")
                continue
            self.number_or_none(value, cells[1], f"floc demo, {name} of six samples")
            self.number_or_none(error, cells[2], f"floc demo, error of {name}")
        own = {r["parameter"]: r["value"] for r in self.rows("floc fit consolidation demo")}
        with self.hanging_on_demo():
            self.number_or_none(fitted["lambda"][3], own.get("lambda"), "floc demo, lambda of the demo")
        if "not identified" in lines[-1] or "lambda = 0.171 +- 0.004" not in lines[-1]:
            self.fault(f"floc demo: its last line is {lines[-1]!r}")

    def progress(self):
        text = self.claim_block("step 9/40 (branch load, P")
        said = self.progress_of_demo
        for line in text.strip().split("\n"):
            result = r"solid fraction ([\d.]+), (\d+) contacts, force residual ([\d.e-]+) (\(ending: \w+\))"
            found = re.match(r"(step \d+/40 \(branch load, P = [\d.]+\): )" + result, line)
            if not found:
                continue  # what is said while it moves depends on the machine
            start, phi, contacts, residual, ending = found.groups()
            now = re.search(re.escape(start) + result, said)
            if not now or now.groups() != (phi, contacts, residual, ending):
                self.differs(f"progress: the page says {line!r}, the program {now and now.group(0)!r}")

    def scene_check(self):
        shown = self.claim_block("group                value  meaning")
        printed = self.shell("floc scene check powder.toml --format table").stdout
        for line in shown.strip().split("\n"):
            words = line.split()
            if words[0] not in ("...", "cost") and not any(words == other.split() for other in printed.split("\n")):
                self.fault(f"scene check: no line {line!r} in\n{printed}")
        name, cost = [line.split()[:2] for line in printed.split("\n") if line.startswith("cost")][0]
        self.number([line.split()[1] for line in shown.split("\n") if line.startswith("cost")][0], cost, name)

    def scene_faults(self):
        shown = self.claim_block("contact.damping.restitution is missing")
        text = open(os.path.join(self.directory, "powder.toml")).read()
        open(os.path.join(self.directory, "misspelt.toml"), "w").write(text.replace("restitution =", "restituton =", 1))
        said = self.shell("floc scene check misspelt.toml", expected=4).stderr.replace("misspelt", "powder")
        if said.strip() != shown.strip():
            self.fault(f"faults of a scene: the page says\n{shown}the program\n{said}")

    def rolling_stiffness(self):
        found = re.search(r"With `--rolling-stiffness` B = ([\d, ]+) and G = ([\d, ]+): the network of a loose",
                          self.docs.text().replace("\n", " "))
        rows = self.rows("floc moduli demo/state-0001.h5 --rolling-stiffness 10,100,1000")
        if not found:
            return self.fault("no page says any more what --rolling-stiffness gives")
        for name, numbers in zip("BG", found.groups()):
            for shown, row in zip(numbers.split(", "), rows):
                self.number(shown, row[name], f"--rolling-stiffness {row['rolling_stiffness']}, {name}")

    def network(self):
        names = ["z", "z_plus", "z_minus", "x22", "moment_2", "pressed_share", "pressed_percolates", "pulled_largest",
                 "energy_share_95", "correlation_normal", "indeterminacy"]
        rows = self.rows("floc network demo/state-*.h5")
        for cells in self.claim_table("| state           | P*"):
            row = rows[int(cells[0].split(",")[0])]
            self.number(cells[1], row["P_star"], f"floc network, state {cells[0]}, P*")
            for name, shown in zip(names, cells[2:]):
                self.number(shown, row[name], f"floc network, state {cells[0]}, {name}")

    def compare(self):
        text = self.claim_block("before              after               n_kept")
        lines = [line.split() for line in text.strip().split("\n")]
        rows = {r["before"]: r for r in self.rows("floc compare demo/state-*.h5")}
        for cells in lines[1:]:
            for name, shown in zip(lines[0][2:], cells[2:]):
                self.number(shown, rows[cells[0]][name], f"floc compare {cells[0]}, {name}")

    def crystal(self):
        found = re.search(r"gives B = ([\d.]+) and G = ([\d.]+), the closed forms", self.docs.text())
        row = self.rows("floc moduli crystal.h5")[0]
        for name, shown in zip("BG", found.groups()):
            self.number(shown, row[name], f"crystal, {name}")

    def preconsolidation(self):
        found = re.search(r"here ([\d.]+) and ([\d.]+), loaded to 1", self.docs.text())
        rows = [r for r in self.rows("floc fit preconsolidation data/tables/reload") if r["parameter"] == "P_c"]
        for shown, row in zip(found.groups(), rows):
            self.number(shown, row["value"], "P_c of " + row["sample"])

    def conversions(self):
        """Checks the output in the tutorial on packings of other programs."""
        for part, begin in (("lammps.h5: 60 grains in 2D", "floc convert data/packings/lammps/disks.dump"),
                            ("yade.h5: 40 grains in 3D", "floc convert data/packings/yade/spheres.txt"),
                            ("crystal.h5: 4 grains in 2D", "floc convert grains.csv")):
            shown = self.claim_block(part)
            command = re.sub(r"(floc convert \S+ \S+)", r"\1 --overwrite", self.docs.block(begin))
            self.prepare(command)
            done = self.shell(command)
            said = done.stderr + done.stdout
            for line in shown.strip().split("\n"):
                close = [other for other in said.split("\n") if self.same_numbers(line, other, 1e-13)]
                if line not in said and not close:
                    self.fault(f"{begin}: no line {line!r} in\n{said}")

    @staticmethod
    def same_numbers(a, b, tolerance):
        x, y = pages.NUMBER.findall(a), pages.NUMBER.findall(b)
        return (pages.NUMBER.sub("#", a) == pages.NUMBER.sub("#", b) and len(x) == len(y) and
                all(abs(float(p) - float(q)) <= tolerance * abs(float(p)) for p, q in zip(x, y)))

    def python(self):
        code = self.docs.block("import h5py, numpy as np")
        shown = self.claim_block("solid fraction   0.7")
        open(os.path.join(self.directory, "read.py"), "w").write(code)
        said = self.shell(f"'{sys.executable}' read.py").stdout
        for line, other in zip(shown.strip().split("\n"), said.strip().split("\n")):
            # A sum of forces that cancel is only rounding, which depends on numpy.
            tolerance = 1.0 if line.startswith("largest net force") else 1e-9
            if not self.same_numbers(line, other, tolerance):
                self.differs(f"h5py: the page says {line!r}, the script {other!r}")

    def python_package(self):
        """Runs all blocks of a page that import floc as one script, and compares the output with the comments beside
        the commands."""
        package = os.path.join(os.path.dirname(self.floc), "../python")
        if not os.path.exists(os.path.join(package, "floc")):
            print("the Python package is not built: its examples are not run")
            return
        self.environment.update(PYTHONPATH=package, MPLBACKEND="Agg")
        n = 0
        for page in self.docs.pages:
            blocks = [text for language, text, _ in page.blocks if language == "python" and "h5py" not in text]
            if not any("import floc" in text for text in blocks):
                continue
            n += 1
            open(os.path.join(self.directory, "page.py"), "w").write("\n".join(blocks))
            said = self.shell(f"'{sys.executable}' page.py").stdout.strip().split("\n")
            shown = re.findall(r"^print\(.*\)  +# (.*)$", "\n".join(blocks), re.MULTILINE)
            if len(said) != len(shown):
                self.fault(f"{page.name}: the script prints {len(said)} lines, the page shows {len(shown)}")
            for line, other in zip(shown, said):
                same_words = pages.NUMBER.sub("#", line) == pages.NUMBER.sub("#", other)
                numbers = zip(pages.NUMBER.findall(line), map(float, pages.NUMBER.findall(other)))
                if not same_words or not all(pages.rounds_to(number, value) for number, value in numbers):
                    self.differs(f"{page.name}: the page shows {line!r}, the script prints {other!r}")
        if n < 2:
            self.fault(f"{n} pages use the Python package, expected README and docs/python.md")

    def spheres(self):
        states = list(csv.DictReader(open(os.path.join(self.source, "data/tables/spheres/states_4000.csv"))))

        def shown_agrees(shown, state, step, name):
            percent = shown.endswith("%")
            mean, deviation = shown.rstrip(" %").split(" +- ")
            values = [float(r[name]) * (100.0 if percent else 1.0) for r in states
                      if r["state"] == state and int(r["step"]) == step]
            what = f"spheres {state}, step {step}, {name}"
            self.number(mean, statistics.mean(values), what)
            self.number(deviation, statistics.stdev(values), what + ", scatter")

        for cells in self.claim_table("| state | put together | P |"):
            state = cells[0].lower()
            for name, shown in zip(["phi", "z_star_carrying", "x0_carrying", "Z_2"], cells[3::2]):
                shown_agrees(shown, state, self.assembled(states, state), name)
        for cells in self.claim_table("| state | M1 | published | M2 |"):
            state = cells[0].lower()
            first, top = self.assembled(states, state), self.highest(states, state)
            last = max(int(r["step"]) for r in states if r["state"] == state)
            for step, name, shown in ((first, "M1_carrying", cells[1]), (first, "M2_carrying", cells[3]),
                                      (top, "z_star_carrying", cells[5]), (top, "x0_carrying", cells[6]),
                                      (last, "z_star_carrying", cells[7]), (last, "x0_carrying", cells[8]),
                                      (last, "M1_carrying", cells[10])):
                shown_agrees(shown, state, step, name)
            gained = [1e4 * (float(end["phi"]) - float(start["phi"])) for start in states for end in states
                      if start["state"] == end["state"] == state and start["seed"] == end["seed"] and
                      int(start["step"]) == first and int(end["step"]) == last]
            mean, deviation = cells[9].removesuffix(" e-4").split(" +- ")
            self.number(mean, statistics.mean(gained), f"spheres {state}, Phi gained")
            self.number(deviation, statistics.stdev(gained), f"spheres {state}, scatter of Phi gained")

    def spheres_of_lammps(self):
        directory = os.path.join(self.source, "data/tables/spheres/lammps")
        samples = list(csv.DictReader(open(os.path.join(directory, "state_b.csv"))))
        for program, *shown in self.claim_table("| B, 1372 beads |"):
            for name, text in zip(["phi", "z_star_carrying", "x0_carrying", "M1_carrying", "M2_carrying"], shown):
                scale = 100.0 if text.endswith("%") else 1.0
                values = [scale * float(r[name]) for r in samples if r["program"] == program.lower()]
                self.mean_and_scatter(text.removesuffix(" %"), values, f"B of {program}, {name}")
        path = list(csv.DictReader(open(os.path.join(directory, "state_c.csv"))))
        phi = {(r["seed"], int(r["step"])): 1e4 * float(r["phi"]) for r in path}
        last = max(step for _, step in phi)
        gained = re.search(r"LAMMPS has (\S+)e-4", self.docs.text().replace("\n", " ")).group(1)
        self.number(gained, statistics.mean(phi[seed, last] - phi[seed, 0] for seed, step in phi if step == 0),
                    "C of LAMMPS, Phi gained")

    def quasistatic(self):
        points = list(csv.DictReader(open(os.path.join(self.source, "data/tables/quasistatic/points.csv"))))

        def solid_fractions(rolling, mass, pressure):
            return {r["seed"]: float(r["Phi_" + pressure]) for r in points
                    if r["rolling"] == rolling and r["mass"] == mass and r["cap"] == "0.05" and r["Phi_" + pressure]}

        rows = [(cells[:3], cells[3:], "0.05") for cells in self.claim_table("| rolling resistance | P* | samples | mass 0.1 |")]
        rows += [((rolling, "1", samples), shown, mass)
                 for rolling, mass, samples, *shown in self.claim_table("| rolling resistance | mass | samples |")]
        for (rolling, pressure, samples), shown, mass in rows:
            base, other = solid_fractions(rolling, "0.1", pressure), solid_fractions(rolling, mass, pressure)
            both = sorted(set(base) & set(other))
            changes = [other[seed] - base[seed] for seed in both]
            what = f"quasistatic, {rolling} rolling resistance, mass {mass}, P* = {pressure}"
            self.number(samples, len(both), what + ", samples")
            for text, found, scatter in (
                    (shown[0], [base[seed] for seed in both], statistics.stdev(base[seed] for seed in both)),
                    (shown[1], [other[seed] for seed in both], statistics.stdev(other[seed] for seed in both)),
                    (shown[2], changes, statistics.stdev(changes) / len(changes) ** 0.5)):
                mean, deviation = text.split(" +- ")
                self.number(mean, statistics.mean(found), what)
                self.number(deviation, scatter, what + ", scatter")

    def rigid(self):
        points = list(csv.DictReader(open(os.path.join(self.source, "data/tables/rigid/points.csv"))))
        names = {"pentagons": "polygons-5", "octagons": "polygons-8", "polygons of 20 sides": "polygons-20"}
        shears = ("phi", "z_star", "x0", "below_mean", "alpha", "beta", "stress_ratio", "stress_ratio_predicted")
        forces = ("phi", "z_star", "z_pairs_star", "x0", "below_mean", "alpha", "beta", "below_mean_pairs", "alpha_pairs", "beta_pairs")

        def compare(case, samples, cells, columns):
            rows = [r for r in points if r["case"] == case]
            self.number(samples, len(rows), f"{case}, samples")
            for shown, column in zip(cells, columns, strict=True):
                values = [float(r[column]) for r in rows if r[column]]
                if shown == "" or not values:
                    if shown != "" or values:
                        self.fault(f"{case}, {column}: the page says {shown!r}, the table has {len(values)} values")
                elif len(values) == 1:
                    self.number(shown, values[0], f"{case}, {column}")
                else:
                    self.mean_and_scatter(shown, values, f"{case}, {column}")

        for grains, samples, *cells in self.claim_table("| grains | samples | Phi |"):
            compare(names.get(grains) or "rolling-" + re.search("mu_R = (.*) a", grains).group(1), samples, cells, shears)
        for span, samples, *cells in self.claim_table("| span | samples | Phi |"):
            compare("span-" + span.replace(", I = ", "-rate-").replace(", N = ", "-"), samples, cells, shears)
        for case, _, samples, *cells in self.claim_table("| case | packing | samples | Phi |"):
            compare(case, samples, cells, forces)
        anisotropies = ("a_normals", "a_normal_force", "a_tangential_force", "stress_ratio", "stress_ratio_predicted", "sliding_share")
        for case, samples, *cells in self.claim_table("| sheared | samples |"):
            compare(case, samples, cells, anisotropies)
        for case, samples, *cells in self.claim_table("| at rest | samples |"):
            compare(case, samples, cells, ("sliding_share", "force_freedom"))
        kinds = ("vertex_face", "edge_edge", "edge_face", "face_face")
        for case, *cells in self.claim_table("| case | vertex-face |"):
            for kind, shown in zip(kinds, cells, strict=True):
                for text, column in zip(shown.split(" with "), ("pairs_" + kind, "force_" + kind), strict=True):
                    self.number(text, 100.0 * statistics.mean(float(r[column]) for r in points if r["case"] == case), f"{case}, {column}")

    def change_of_means(self, shown, base, other, what, scale):
        """Compares "change +- two standard errors" of a mean with two lists of values, both in units of 1/scale."""
        mean, deviation = shown.split(" +- ")
        self.number(mean, scale * (statistics.mean(other) - statistics.mean(base)), what)
        error = 2 * (statistics.variance(base) / len(base) + statistics.variance(other) / len(other)) ** 0.5
        self.number(deviation, scale * error, what + ", two standard errors")

    def softening(self):
        points = list(csv.DictReader(open(os.path.join(self.source, "data/tables/softening/points.csv"))))

        def values(factors, name):
            return [float(r[name]) for r in points if ("-".join(r[part] for part in parts), r["patience"], r["masses"]) == factors]

        parts = ("assembly", "to_0.1", "to_0.316", "to_1", "beyond")
        strict_ones = ("1-1-1-1-1", "1", "own")

        def change(shown, factors, name, what, scale=1.0):
            self.change_of_means(shown, values(strict_ones, name), values(factors, name), what, scale)

        for softening, patience, masses, pressure, samples, strict, soft, phi, z, B in self.claim_table("| softening | patience | masses | P* |"):
            factors = (softening, patience, masses)
            what = f"softening {softening}, patience {patience}, masses {masses}, P* = {pressure}"
            self.number(samples, len(values(factors, "seed")), what + ", samples")
            self.mean_and_scatter(strict, values(strict_ones, "Phi_" + pressure), what + ", strict")
            self.mean_and_scatter(soft, values(factors, "Phi_" + pressure), what + ", soft")
            change(phi, factors, "Phi_" + pressure, what + ", change of Phi")
            change(z, factors, "z_" + pressure, what + ", change of z")
            if B:
                name = "B_" + pressure
                change(B, factors, name, what + ", change of B", 100.0 / statistics.mean(values(strict_ones, name)))

    def fast_beads(self):
        points = list(csv.DictReader(open(os.path.join(self.source, "data/tables/softening/beads.csv"))))

        def values(settings, count, name):
            return [float(r[name]) for r in points if r["settings"] == settings and r["n_grains"] == count]

        for count, at, samples, plain, fast, *changes in self.claim_table("| beads | at | samples |"):
            what = f"{count} beads at {at}"
            self.number(samples, len(values("fast", count, "seed")), what + ", samples")
            self.mean_and_scatter(plain, values("as_it_is", count, "Phi_" + at), what + ", as they are")
            self.mean_and_scatter(fast, values("fast", count, "Phi_" + at), what + ", fast")
            for name, shown in zip(("Phi", "z", "B"), changes, strict=True):
                base, other = values("as_it_is", count, f"{name}_{at}"), values("fast", count, f"{name}_{at}")
                scale = 100.0 / statistics.mean(base) if name == "B" else 1.0
                self.change_of_means(shown, base, other, f"{what}, change of {name}", scale)

    def compaction(self):
        points = list(csv.DictReader(open(os.path.join(self.source, "data/tables/compaction/points.csv"))))
        for cells in self.claim_table("| eta* | spheres | e | published law |"):
            eta, count = float(cells[0]), cells[1]
            stiffness = 1e3 if eta == 0.001 else 1e4
            values = [float(r["e"]) for r in points if float(r["eta_star"]) == eta and r["N"] == count and
                      float(r["se"]) == stiffness]
            what = f"compaction of {count} spheres at eta* = {eta}"
            self.mean_and_scatter(cells[2], values, what)

    def compaction_variants(self):
        rows = list(csv.DictReader(open(os.path.join(self.source, "data/tables/compaction/variants_1000.csv"))))
        columns = [(gas, eta) for gas in ("equilibrated", "sequential_addition") for eta in (0.05, 1.0)]
        for name, _, stiffness, *shown in self.claim_table("| variant | what is changed | se |"):
            for (gas, eta), cell in zip(columns, shown, strict=True):
                values = [float(r["e"]) for r in rows if r["gas"] == gas and r["variant"] == name.strip("`") and
                          float(r["se"]) == float(stiffness) and abs(float(r["eta_star"]) - eta) < 1e-9]
                what = f"{name} of 1000 spheres, se = {stiffness}, eta* = {eta}, {gas}"
                if not cell:
                    if values:
                        self.fault(f"{what}: the table has no value")
                    continue
                self.mean_and_scatter(cell, values, what)

    def compaction_moduli(self):
        rows = list(csv.DictReader(open(os.path.join(self.source, "data/tables/compaction/moduli_1000.csv"))))
        names = ("phi", "B", "G", "C11", "C33", "B_voigt", "B_reuss")
        for boundary, *shown in self.claim_table("| boundary | Phi | B | G |"):
            for name, cell in zip(names, shown, strict=True):
                values = [float(r[name]) / (1.0 if name == "phi" else 0.1) for r in rows if r["boundary"] == boundary]
                self.mean_and_scatter(cell, values, f"{name} of 1000 spheres, {boundary}")

    def lambda_of_ensembles(self):
        """lambda of the committed ensembles, as the script beside them prints it."""
        script = os.path.join(self.source, "data/tables/lambda.py")
        printed = subprocess.run([sys.executable, script, self.floc], check=True, capture_output=True, text=True).stdout
        rows = [[cell.strip() for cell in line.strip("| ").split("|")] for line in printed.splitlines()[2:]]
        for shown, row in zip(self.claim_table("| ensemble | samples | law |"), rows, strict=True):
            if shown != row:
                self.differs(f"lambda of ensembles: the page says {shown}, the script {row}")

    def compaction_sweep(self):
        """Checks the base curve for the published number of spheres, and the fit of the sweep with 4000 spheres."""
        base = list(csv.DictReader(open(os.path.join(self.source, "data/tables/compaction/base_17657.csv"))))
        e_of = {float(r["eta_star"]): r["e"] for r in base}
        for eta, e, _ in self.claim_table("| eta* | e of 17 657 spheres |"):
            self.number(e, e_of[float(eta)], f"base curve at eta* = {eta}")
        rows = {r["parameter"]: r for r in
                self.rows(self.docs.block("awk -F, 'NR == 1").strip())}
        for name, value, interval, _ in self.claim_table("| parameter | 4000 spheres |"):
            what = f"fit of the sweep, {name}"
            self.number_or_none(value, rows[name]["value"], what)
            if interval.startswith("at most "):
                self.number(interval.removeprefix("at most "), rows[name]["high95"], what + ", bound")
            else:
                low, high = interval.split(" to ")
                self.number(low, rows[name]["low95"], what + ", low end")
                self.number(high, rows[name]["high95"], what + ", high end")
        self.compaction_collapse({name: float(rows[name]["value"]) for name in ("e_min", "De", "C")})

    def compaction_collapse(self, plateau):
        """Checks the dimensionless groups on which the shares of tensile contacts and the void ratios collapse."""
        sweep = list(csv.DictReader(open(os.path.join(self.source, "data/tables/compaction/sweep_4000.csv"))))
        column = {name: numpy.array([float(r[name]) for r in sweep])
                  for name in ("e", "p", "se", "eta", "eta_star", "z", "z_minus", "seconds")}

        def scatter(group, values, chosen):
            x, y = numpy.log(column[group][chosen]), values[chosen]
            return math.sqrt(numpy.mean((numpy.polyval(numpy.polyfit(x, y, 5), x) - y) ** 2))

        reach = plateau["De"] / (1.0 + plateau["C"] * plateau["De"] * numpy.log(column["p"] / 0.01))
        reduced = (column["e"] - plateau["e_min"]) / reach
        share = column["z_minus"] / column["z"]
        every, stiff = column["p"] > 0.0, column["se"] >= 5000.0 * column["p"]
        found = re.search(r"the adhesion, (\d+) samples of 4000 spheres and (\d+) minutes .* it scatters by ([\d.]+) in eta, and by "
                          r"([\d.]+) in eta\\\*\. .* of the (\d+) samples with se >= 5000 p: ([\d.]+) in eta and ([\d.]+) in eta",
                          self.docs.text().replace("\n", " "))
        if not found:
            return self.fault("no page says any more on which group the compaction collapses")
        for shown, value in zip(found.groups(), (len(sweep), column["seconds"].sum() / 60.0, scatter("eta", share, every),
                                                 scatter("eta_star", share, every), stiff.sum(),
                                                 scatter("eta", reduced, stiff), scatter("eta_star", reduced, stiff))):
            self.number(shown, value, "collapse of the compaction")

    def powder2d(self):
        means = list(csv.DictReader(open(os.path.join(self.source, "data/campaigns/powder2d/means.csv"))))
        for case, pressure, shown, published in self.claim_table("| case | P* | Phi | published |"):
            found = [r for r in means if r["case"] == case and r["quantity"] == "phi" and r["branch"] in ("assembly", "load") and
                     abs(float(r["P_star"]) - float(pressure)) < 1e-9]
            if len(found) != 1:
                self.fault(f"powder2d: {len(found)} rows of {case} at P* = {pressure}")
                continue
            mean, deviation = shown.split(" +- ")
            self.number(mean, float(found[0]["mean"]), f"powder2d {case} at P* = {pressure}")
            self.number(deviation, float(found[0]["deviation"]), f"powder2d {case} at P* = {pressure}, scatter")
            if published:
                self.number(published.split(" +- ")[0], float(found[0]["reference"]), f"powder2d {case}, published")

    def wet(self):
        rows = list(csv.DictReader(open(os.path.join(self.source, "data/tables/wet/states.csv"))))
        columns = [("phi", 1.0), ("z_bonds", 1.0), ("minus_share", 100.0), ("force_exponent_plus_from_0", 1.0),
                   ("force_exponent_minus_from_0", 1.0), ("pressure_exponent_plus_from_0", 1.0),
                   ("pressure_exponent_minus_from_0", 1.0), ("like_share", 100.0), ("like_share_shuffled", 100.0),
                   ("negative_directions", 1.0), ("negative_directions_shuffled", 1.0)]
        for cells in self.claim_table("| mu | water | state | samples | Phi"):
            friction, water, state, count = cells[:4]
            found = [r for r in rows if float(r["friction"]) == float(friction) and r["state"] == state and
                     abs(100.0 * float(r["water"]) - float(water.rstrip(" %"))) < 1e-9]
            what = f"wet spheres put together with mu = {friction}, water {water}, {state}"
            if len(found) != int(count):
                self.fault(f"{what}: {len(found)} rows of data/tables/wet/states.csv, the page says {count}")
                continue
            for (name, scale), shown in zip(columns, cells[4:]):
                if not shown:
                    continue
                values = [scale * float(r[name]) for r in found]
                mean, *deviation = shown.rstrip(" %").split(" +- ")
                self.number(mean, statistics.mean(values), f"{what}, {name}")
                for scatter in deviation:
                    self.number(scatter, statistics.stdev(values), f"{what}, scatter of {name}")

    def measured_tables(self):
        """Checks fits of synthetic test tables, and the parameters with which the tables were made."""
        sys.dont_write_bytecode = True
        made, tests = (runpy.run_path(os.path.join(self.source, "data/tables", name, "make.py")) for name in ("oedometer", "your-test"))
        table = "data/tables/oedometer/oedometer.csv"
        virgin = f"floc fit consolidation {table} --loading virgin --law log --window 200,6400"
        rows = [(virgin, "lambda", made["LAMBDA"]), (f"floc fit preconsolidation {table}", "kappa", made["KAPPA"]),
                (f"floc fit preconsolidation {table}", "P_c", max(made["LOADS"]))]
        self.fits_beside_truth("| constant of the clay | made with |", 1, rows)
        table = "data/tables/your-test/"
        german = f"floc fit consolidation {table}oedometer.csv --law log --loading virgin --window 100,1600"
        polish = (f"floc fit consolidation {table}edometr.csv --law log --window 100,1600 --columns "
                  f"initial_void_ratio={tests['POLISH_E_0']},initial_height={tests['POLISH_HEIGHT']}")
        tablet = f"floc fit consolidation {table}tablet.txt --law full"
        rows = [(german, "lambda", tests["GERMAN"]["lambda"]), (polish, "lambda", tests["POLISH"]["lambda"])]
        rows += [(tablet, name, tests["TABLET"][name]) for name in ("lambda", "alpha", "Phi_max")]
        self.fits_beside_truth("| test | constant | made with |", 2, rows)

    def fits_beside_truth(self, header, n_words, rows):
        """Compares fits with true values. @param rows  command, parameter and true value of each row of a table with
        `n_words` columns of words"""
        for cells, (command, name, truth) in zip(self.claim_table(header), rows, strict=True):
            made, value, interval = cells[n_words:]
            self.number(made, truth, f"{name} of {command}, made with")
            row = next(r for r in self.rows(command) if r["parameter"] == name)
            low, high = interval.split(" to ")
            for shown, column in ((value, "value"), (low, "low95"), (high, "high95")):
                self.number(shown, row[column], f"{column} of {name} of {command}")
            if not float(row["low95"]) <= truth <= float(row["high95"]):
                self.fault(f"{command}: the interval of {name} does not hold the truth, {truth}")

    def compression_laws(self):
        """Checks the median excess of AICc of each law over the samples of a packing."""
        tables = os.path.join(self.source, "data/tables")
        curves = list(csv.DictReader(open(os.path.join(tables, "loads/curves.csv"))))
        beads = list(csv.DictReader(open(os.path.join(tables, "spheres/states_500.csv"))))

        def of_curves(control):
            return [[(r["P_star"], r["phi"]) for r in curves if r["control"] == control and r["seed"] == str(seed)]
                    for seed in range(1, 9)]

        def of_beads(state):
            return [[(r["P"], r["phi"]) for r in beads
                     if r["state"] == state and r["seed"] == str(seed) and r["branch"] != "unload"]
                    for seed in range(1, 6)]
        paths = {"cohesive disks, 400": [f"data/tables/demo/seed-{seed}/path.csv" for seed in range(1, 9)],
                 "cohesive disks, isotropic": of_curves("isotropic"),
                 "cohesive disks, oedometer": of_curves("oedometric"),
                 "cohesive spheres in 3D": ["data/tables/spheres/powder3d_path.csv"],
                 "glass beads, dense (a)": of_beads("a"), "glass beads, loose (d)": of_beads("d")}
        laws = ["heckel", "kawakita", "cooper-eaton", "walker", "gurnham", "adams"]
        for packing, samples, *shown in self.claim_table("| packing | samples | heckel |"):
            self.number(samples, len(paths[packing]), f"samples of {packing}")
            excess = {law: [] for law in laws}
            for path in paths[packing]:
                if not isinstance(path, str):
                    with open(os.path.join(self.directory, "sample.csv"), "w") as file:
                        file.write("P,phi\n" + "".join(f"{P},{phi}\n" for P, phi in path))
                    path = "sample.csv"
                found = {r["law"]: float(r["delta_aicc"]) for r in self.rows(f"floc fit compression {path}")}
                for law in laws:
                    excess[law].append(found[law])
            for law, value in zip(laws, shown, strict=True):
                self.number(value, statistics.median(excess[law]), f"AICc of {law}, {packing}")

    def loads(self):
        tables = os.path.join(self.source, "data/tables/loads")
        tests = list(csv.DictReader(open(os.path.join(tables, "biaxial.csv"))))
        columns = ["phi", "peak_friction", "peak_strain", "steady_friction", "steady_phi", "steady_z"]
        for cells in self.claim_table("| packing | samples | Phi before | largest friction"):
            found = [r for r in tests if r["packing"] == cells[0]]
            self.number(cells[1], len(found), f"biaxial tests of {cells[0]} packings")
            for name, shown in zip(columns, cells[2:], strict=True):
                values = [float(r[name]) for r in found]
                self.mean_and_scatter(shown, values, f"biaxial tests of {cells[0]} packings, {name}")
        tests = {r["seed"]: r for r in csv.DictReader(open(os.path.join(tables, "oedometer.csv")))}
        columns = ["K0_mean", "K0_stddev", "K0_top", "ratio_of_moduli", "ratio_1", "ratio_2", "ratio_3"]
        for cells in self.claim_table("| sample | Phi | K0, mean of states"):
            row = tests[cells[0]]
            for part, name in zip(cells[1].split(" to "), ("first_phi", "last_phi"), strict=True):
                self.number(part, row[name], f"oedometer {cells[0]}, {name}")
            for name, shown in zip(columns, cells[2:], strict=True):
                self.number(shown, row[name], f"oedometer {cells[0]}, {name}")
        self.consolidation_curves(list(csv.DictReader(open(os.path.join(tables, "curves.csv")))))
        states = list(csv.DictReader(open(os.path.join(tables, "pressed.csv"))))
        for pressure, *shown in self.claim_table("| P*, pressed at once | Phi | K0 |"):
            for name, cell in zip(("phi", "K0"), shown, strict=True):
                values = [float(r[name]) for r in states if abs(float(r["P_star"]) / float(pressure) - 1.0) < 0.01]
                self.mean_and_scatter(cell, values, f"{name} of a powder pressed at once, P* = {pressure}")

    def consolidation_curves(self, states):
        for cells in self.claim_table("| P* | Phi, isotropic | Phi, oedometer | K0 |"):
            for shown, control, name in zip(cells[1:], ("isotropic", "oedometric", "oedometric"), ("phi", "phi", "K0"),
                                            strict=True):
                values = [float(r[name]) for r in states
                          if r["control"] == control and abs(float(r["P_star"]) / float(cells[0]) - 1.0) < 0.01]
                what = f"{name} under {control} load at P* = {cells[0]}"
                if bool(shown) != (len(values) == 8):
                    self.fault(f"{what}: {len(values)} states, the page says {shown or 'none'}")
                elif shown:
                    self.mean_and_scatter(shown, values, what)
        text = " ".join(self.docs.text().split())
        for pattern, arguments in ((r"is ([\d.]+) \+- ([\d.]+) under isotropic and ([\d.]+) \+- ([\d.]+) under oedometric load",
                                    "--law log --window 0.05 0.5"),
                                   (r"between few pressures \(`--law full`\): ([\d.]+) \+- ([\d.]+) and ([\d.]+) \+- ([\d.]+)\.",
                                    "--law full")):
            shown = re.search(pattern, text).groups()
            for k, control in enumerate(("isotropic", "oedometric")):
                for seed in range(1, 9):
                    with open(os.path.join(self.directory, f"{control}-{seed}.csv"), "w") as file:
                        rows = [f"{r['P_star']},{r['phi']}" for r in states
                                if r["control"] == control and r["seed"] == str(seed) and float(r["P_star"]) < 13.4]
                        file.write("P_star,phi\n" + "\n".join(rows) + "\n")
                fitted = [r for r in self.rows(f"floc fit consolidation {control}-*.csv {arguments}")
                          if r["sample"] == "pooled" and r["parameter"] == "lambda"][0]
                self.number(shown[2 * k], fitted["value"], f"lambda under {control} load {arguments}")
                self.number(shown[2 * k + 1], fitted["stderr"], f"its error, {control} {arguments}")

    def lattice(self):
        study = list(csv.DictReader(open(os.path.join(self.source, "data/tables/lattice/study.csv"))))
        columns = ["E", "other_share_nodes", "beta1_nodes", "beta2_nodes", "beta1_forces", "pearson_bonded"]
        for cells in self.claim_table("| grains | nodes | load | rho_m"):
            grains, nodes, load, content, ratio = cells[:5]
            found = [r for r in study if r["grains"] == grains and r["load"] == load and r["ratio"] == ratio + ".0" and
                     abs(float(r["rho_m"]) - float(content)) < 1e-3 and
                     abs(float(r["nodes_a_diameter"]) - float(nodes)) < 0.06]
            what = f"lattice of {grains} grains, {nodes} nodes a diameter, {load}, rho_m = {content}, k_p/k_m = {ratio}"
            if len(found) != 1:
                self.fault(f"{what}: {len(found)} rows of data/tables/lattice/study.csv")
                continue
            for name, shown in zip(columns, cells[5:]):
                percent = shown.endswith("%")
                self.number(shown.rstrip(" %"), float(found[0][name]) * (100.0 if percent else 1.0), f"{what}, {name}")

    @staticmethod
    def assembled(states, state):
        """Returns the step of the assembly: the last step before any load."""
        return max(int(r["step"]) for r in states if r["state"] == state and r["branch"] == "assembly")

    @staticmethod
    def highest(states, state):
        return max((float(r["P"]), int(r["step"])) for r in states if r["state"] == state)[1]

    def tradeoff(self):
        rows = list(csv.DictReader(open(os.path.join(self.source, "data/tables/tradeoff/disks-cohesive.csv"))))

        def error(row):
            values = [float(row[name]) for name in ("error_before_high", "error_after_high") if row[name]]
            return max(values) if values else None

        for knob, value, cost, of_phi, of_b, mean_phi, mean_b in self.claim_table("| knob | value | cost_ratio"):
            chosen = {r["observable"]: r for r in rows if r["knob"] == knob and r["value"] == value}
            what = f"tradeoff {knob} {value}"
            if not chosen:
                self.fault(what + ": not in data/tables/tradeoff/disks-cohesive.csv")
                continue
            any_row = chosen.get("phi", chosen.get("B"))
            self.number(cost, any_row["cost_ratio"], what + ", cost_ratio")
            for name, shown in (("phi", of_phi), ("B", of_b)):
                if shown:
                    self.number(shown, error(chosen[name]), f"{what}, error of {name}")
            for name, shown in (("phi", mean_phi), ("B", mean_b)):
                if shown:
                    mean, stderr = shown.split(" +- ")
                    self.number(mean, chosen[name]["mean_difference"], f"{what}, mean of {name}")
                    self.number(stderr, chosen[name]["mean_stderr"], f"{what}, standard error of {name}")

    def names_of_tradeoff(self):
        """Checks that the page names every observable once, and every parameter of the program's tables."""
        help_text = subprocess.run([self.floc, "tradeoff", "--help"], capture_output=True, text=True, check=True).stdout
        known = re.search(r"--observables TEXT:\{(.*?)\}", help_text).group(1).split(",")
        told = [name for row in self.claim_table("| observable | of | meaning |") for name in row[0].split(", ")]
        if sorted(known) != sorted(told):
            self.fault(f"observables of floc tradeoff: {sorted(set(known) ^ set(told))} are not on the page, or not in the program")
        knobs = " ".join(row[0] for row in self.claim_table("| knob | of | strictest |"))
        path = os.path.join(self.source, "data/tables/tradeoff/disks-cohesive.csv")
        for knob in {row["knob"] for row in csv.DictReader(open(path))} - {"strict", "scene", "together"}:
            if not re.search(rf"\b{knob}\b", knobs):
                self.fault(f"parameters of floc tradeoff: {knob} is not on the page")

    def settings_that_matter(self):
        """Checks the results on the page that the script in the directory of the tables computes."""
        summary = runpy.run_path(os.path.join(self.source, "data/tables/tradeoff/summary.py"))
        made = {row[0]: row for row in summary["rows_of"](os.path.join(self.source, "data/tables/tradeoff"))}
        told = {row[0]: tuple(row) for row in self.claim_table("| kind | samples | settings that matter most |")}
        for kind in sorted(made.keys() | told.keys()):
            if made.get(kind) != told.get(kind):
                self.fault(f"settings that matter, {kind}: {told.get(kind)}, expected {made.get(kind)}")

    # Grains with corners.

    def checked_shape(self, shape, dimension=2):
        """Returns the exit code and the output of floc scene check for a scene with grains of this shape."""
        with open(os.path.join(self.directory, "shape.toml"), "w") as file:
            file.write(shapes.scene(shape, dimension))
        done = subprocess.run([self.floc, "scene", "check", "shape.toml", "--format", "csv"], cwd=self.directory,
                              capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr

    def accepts_shape(self, accepted, shape, dimension=2, words=""):
        code, said = self.checked_shape(shape, dimension)
        if (code == 0) != accepted or words not in said:
            self.fault(f"shape = {shape} in {dimension}D, expected {'no fault' if accepted else 'a fault'}: {said}")
        return said

    def kinds_of_shapes(self):
        """Checks that kinds, keys, defaults and limits agree with floc scene check."""
        rows = shapes.kinds_in_table(self.claim_table("| `grains.shape.kind` | its keys | shapes |"))
        said = self.accepts_shape(False, {"kind": "ball"})
        if set(re.findall(r'"(\w+)"', said)) - {"ball"} != set(rows):
            self.fault(f"the page has the kinds of shapes {list(rows)}, the program says {said}")
        text = " ".join(self.docs.text().split())
        rounding = re.search(r"corners and edges over the diameter, from (\S+) \(the default\) to ([\d.]+);", text)
        count = re.search(r"number of different shapes that are drawn: (\d+), at most ([\d ]+), and at most", text)
        most = int(count[2].replace(" ", ""))
        points = os.path.join(self.directory, "points")
        checksum = shapes.write_files(points)
        every = {key for row in rows.values() for key in row.keys}
        for kind, row in rows.items():
            base = shapes.valid(kind, points + ".csv")
            whole = {**base, **shapes.further(kind, checksum)}
            if set(whole) - {"kind"} != set(row.keys):
                self.fault(f"shapes of kind {kind}: the test has the keys {list(whole)}, the page {list(row.keys)}")
            self.accepts_shape(True, whole)
            self.accepts_shape(not row.flat, dict(base, sides=[1, 1, 1]) if kind == "box" else (
                dict(base, file=points + "3.csv") if kind == "file" else base), 3)
            for key in sorted(every - set(row.keys)):
                self.accepts_shape(False, dict(base, **{key: 4}), words=f'shapes of kind = "{kind}" have no key {key}')
            for key, key_row in row.keys.items():
                default, low, high = key_row
                if key == "rounding":
                    default, low, high = float(rounding[1]), float(rounding[1]), float(rounding[2])
                elif key == "count":
                    default, high = int(count[1]), most
                if key in base and default is None and key not in ("vertices", "sha256"):
                    self.accepts_shape(False, {k: v for k, v in base.items() if k != key}, words="is missing")
                for limit, sign in ((low, -1), (high, 1)):
                    if limit is None:
                        continue
                    beyond = limit + sign * (1 if isinstance(limit, int) and key != "aspect" else 0.001)
                    self.accepts_shape(False, dict(base, **{key: beyond}), words=key)
                    if key != "count":
                        self.accepts_shape(True, dict(shapes.cheap(base, key), **{key: limit}))
                if default is not None:
                    without = {k: v for k, v in base.items() if k != key}
                    _, left_out = self.checked_shape(without)
                    if self.checked_shape(dict(without, **{key: default})) != (0, left_out):
                        self.fault(f"{key} = {default} is not the default of shapes of kind {kind}")
                    if self.checked_shape(dict(without, **{key: shapes.another(default)}))[1] == left_out:
                        self.fault(f"{key} of shapes of kind {kind} changes nothing that floc scene check prints")
        longest = re.search(r"the longest side is at most (\d+) times the shortest", text)
        self.accepts_shape(True, {"kind": "box", "sides": [1, int(longest[1])]})
        self.accepts_shape(False, {"kind": "box", "sides": [1, 1.001 * int(longest[1])]})
        self.accepts_shape(False, {"kind": "voronoi", "cells": 20, "count": 21}, words="count")
        formats = set(re.findall(r"`\.(\w+)`", rows["file"].meaning))
        for extension in sorted(formats | set(shapes.FORMATS)):
            self.accepts_shape(extension in formats, {"kind": "file", "file": f"{points}3.{extension}"}, 3)
        self.accepts_shape(False, {"kind": "file", "file": points + ".csv", "sha256": "0" * 64}, words="SHA-256")

    def shapes_of_states(self):
        """Checks that the datasets of shapes are those on the page, with the stated rows and contents."""
        rows = {name: size for names, size, _ in self.claim_table("| dataset | rows | holds |")
                for name in re.findall(r"`(\w+)`", names)}
        points = os.path.join(self.directory, "points")
        shapes.write_files(points)
        for k, (dimension, shape) in enumerate(shapes.samples(points)):
            with open(os.path.join(self.directory, f"shape{k}.toml"), "w") as file:
                file.write(shapes.scene(shape, dimension))
            self.shell(f"floc run shape{k}.toml -o shape{k}")
            for fault in shapes.faults_of_state(os.path.join(self.directory, f"shape{k}", "state-0000.h5"), rows, shape):
                self.fault(f"state of {shape} in {dimension}D: {fault}")

    # Checks of numbers that take long. Collapses are chaotic: another version or compiler makes other samples of the
    # same ensemble. Their means agree within their errors.

    def agrees(self, shown, error, value, what):
        """Checks that two means of four samples differ by at most three standard errors of their difference."""
        if abs(float(shown) - float(value)) > 3.0 * math.sqrt(2.0) * error:
            self.fault(f"{what}: the page says {shown}, with a standard error of {error:.2g}, the program {value}")

    def ensembles(self):
        """Makes four samples of 1400 disks of each scene, and checks the fits of two scenes."""
        scenes = {cells[0].strip("`") for cells in self.claim_table("| scene                          | P*")}
        for scene in sorted(scenes):
            self.shell(f"floc run data/scenes/{scene}.toml --seeds 1..4 --jobs 2 -o {scene} "
                       f"{'' if scene.startswith('type2') else '--until 1'}")
        for cells in self.docs.table("| scene                          | P*"):
            scene = cells[0].strip("`")
            phi, z = [], []
            for seed in range(1, 5):
                path = self.path(f"{scene}/seed-{seed}/path.csv")
                row = path[self.step_at(path, "load", cells[1])]
                phi.append(float(row["phi"]))
                z.append(float(row["z"]))
            mean, deviation = cells[2].split(" +- ")
            self.agrees(mean, float(deviation) / 2.0, statistics.mean(phi), f"{scene}, P* = {cells[1]}, Phi")
            self.agrees(cells[4], statistics.stdev(z) / 2.0, statistics.mean(z), f"{scene}, P* = {cells[1]}, z")
        text = self.docs.text().replace("\n", " ")
        for scene, law, name, pattern in (
                ("type2_rolling_small", "full", "lambda", r"with rolling resistance lambda = ([\d.]+) \+- ([\d.]+)"),
                ("type2_rolling_small", "full", "Phi_max", r"and Phi_max = ([\d.]+) \+- ([\d.]+) \(0.7745\)"),
                ("type2_no_rolling", "power", "Phi_max", r"`--law power` gives Phi_max = ([\d.]+) \+- ([\d.]+)")):
            value, error = re.search(pattern, text).groups()
            rows = {r["parameter"]: r for r in self.rows(f"floc fit consolidation {scene} --law {law}")
                    if r["sample"] == "pooled"}
            self.agrees(value, float(error), rows[name]["value"], f"{scene}, {name}")

    def structures(self):
        """Checks structures of the samples that ensembles() made."""
        for scene, pressure, phi, xi, dF, size in self.claim_table("| scene                 | P*"):
            scene = scene.strip("`")
            path = self.path(f"{scene}/seed-1/path.csv")
            step = self.step_at(path, "load", pressure)
            row = self.rows(f"floc structure {scene}/seed-*/state-{step:04d}.h5 --average")[-1]
            what = f"structure of {scene} at P* = {pressure}"
            self.agrees(phi, 0.02 * float(phi), row["phi"], what + ", Phi")
            self.agrees(size, 0.05 * float(size), row["pore_size"], what + ", pore_size")
            for name, shown in (("xi", xi), ("dF", dF)):
                if shown:
                    value, error = shown.split(" +- ")
                    self.agrees(value, float(error), row[name], f"{what}, {name}")

    # All checks.

    def nothing_is_unclaimed(self):
        checked = self.claimed_tables | set(UNCHECKED_TABLES)
        checked |= {"| scene                          | P*", "| scene                 | P*"}  # of the long part
        for page in self.docs.pages:
            for language, text, line in page.blocks:
                if language in ("", "text") and text not in self.claimed_blocks:
                    self.fault(f"{page.name}:{line}: no check reads this block")
            for header, _, line in page.tables:
                if not any(part in header for part in checked):
                    self.fault(f"{page.name}:{line}: no check reads this table: {header}")

    def run(self):
        try:
            self.commands()
            if self.long:
                self.ensembles()
                self.structures()
            else:
                of_demo = (self.demo_moduli, self.progress, self.rolling_stiffness, self.network, self.compare,
                           self.python, self.python_package)
                for check in (self.demo_moduli, self.fit_of_demo_tables, self.demo_results, self.progress, self.scene_check,
                              self.scene_faults, self.rolling_stiffness, self.network, self.compare, self.crystal,
                              self.preconsolidation, self.measured_tables, self.conversions, self.python, self.python_package, self.spheres,
                              self.spheres_of_lammps, self.quasistatic, self.rigid, self.softening, self.fast_beads, self.compaction, self.compaction_variants,
                              self.compaction_moduli, self.lambda_of_ensembles, self.compaction_sweep, self.powder2d, self.wet, self.loads, self.compression_laws,
                              self.lattice, self.tradeoff, self.names_of_tradeoff, self.settings_that_matter, self.kinds_of_shapes, self.shapes_of_states):
                    try:
                        with self.hanging_on_demo(check in of_demo):
                            check()
                    except Exception as error:  # one stale place does not hide the others
                        self.fault(f"{check.__name__}: {type(error).__name__}: {error}")
                self.nothing_is_unclaimed()
        finally:
            shutil.rmtree(self.directory, ignore_errors=True)
        if self.n_other:
            print(f"{self.n_other} numbers and lines of the demo are not those of the pages: OpenBLAS takes its kernels "
                  f"for {self.kernels} here, and those of the pages are for {DEMO_KERNELS}")
        print(f"{len(self.faults)} faults")
        return 1 if self.faults else 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--floc", required=True)
    parser.add_argument("--source", required=True)
    parser.add_argument("--long", action="store_true")
    arguments = parser.parse_args()
    return Test(os.path.abspath(arguments.floc), os.path.abspath(arguments.source), arguments.long).run()


if __name__ == "__main__":
    sys.exit(main())
