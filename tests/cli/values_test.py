#!/usr/bin/env python3
"""Gives invalid numbers to every numeric option of every command, and a directory, a missing file and unreadable
files to every path option. The list of options comes from the help of the program, so new options are tested
automatically. For a new option with text, the kind of text has to be added below.

    values_test.py --floc PROGRAM --source DIRECTORY
"""
import argparse
import concurrent.futures
import itertools
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

# Largest time (s) that a call may take on a busy machine.
LIMIT = 20.0
# Numbers that no option accepts, and numbers that some options accept.
NEVER = ["nan", "inf", "-inf", "0x10"]
NEVER_WHOLE = ["18446744073709551616", "1.5"]
SOMETIMES = ["-1", "0", "1e300"]
CODES = {0, 2, 3, 4}
REFUSED = {2, 4}

SCENE = """[scene]
name = "values"
dimension = 2
units = "reduced"
[grains]
count = 6
diameter = {distribution = "constant", value = 1.0}
[contact]
normal = {law = "linear", stiffness = 1e3}
damping = {restitution = 0.1}
[cell]
solid_fraction = 0.5
mass = 1.0
inertial_number_cap = 1e-1
[assembly]
protocol = "direct"
pressure = 1.0
[[load]]
name = "load"
to = 2.0
steps_per_decade = 1
[equilibrium]
force = 1e-2
moment = 1e-2
stress = 1e-2
energy = 1e-2
"""
CAMPAIGN = """[campaign]
scene = "scene.toml"
seeds = "1..2"
[[collect]]
table = "path"
columns = ["phi"]
"""
GRAINS = "x,y,r\n" + "".join(f"{a * 0.999},{b * 0.999},0.5\n" for a in range(3) for b in range(3))
CELL, LAW = "2.997,0;0,2.997", "normal.stiffness=1e3,friction.coefficient=0.5,friction.stiffness=1e3"
BALLS = "x,y,z,r\n" + "".join(f"{a},{b},{c},0.505\n" for a, b, c in itertools.product(range(2), repeat=3))
PATH = "P_star,P,phi\n" + "".join(f"{10.0 ** (0.2 * k - 2):.6g},{10.0 ** (0.2 * k - 2):.6g},{0.4 + 0.015 * k:.6g}\n"
                                  for k in range(20))
CYCLE = PATH + "50,50,0.67\n20,20,0.665\n10,10,0.66\n5,5,0.658\n"
COMPACTED = "e,p,sc,se\n" + "".join(f"{2.0 - 0.1 * k},{0.01 * 2 ** k},{0.002 * (1 + k % 3)},50\n" for k in range(12))
SHEARED = "sigma1,sigma3,strain,volumetric_strain\n" + "".join(
    f"{100 + min(20 * k, 160)},100,{0.001 * k},{-2e-4 * k}\n" for k in range(30))
MODULI = "P,phi,B\n" + "".join(f"{10.0 ** k:.6g},{0.7 + 0.03 * k:.6g},{1e3 * 10.0 ** (0.5 * k) + k % 2:.6g}\n" for k in range(6))
FORCES = "normal_force\n" + "".join(f"{0.1 * k + 0.05}\n" for k in range(30))


def outputs(*options):
    """Returns the options with a file for each of them."""
    return " ".join(f"--{option}=out/{{n}}-{option}.csv" for option in options)


# For each command, a call that takes milliseconds: its arguments, by their names in the help, and its options. Each
# call replaces {n} by a different name.
CALLS = {
    "run": ({"SCENE": "scene.toml"}, "-o=run-{n} --until=0"),
    "scene check": ({"SCENE": "scene.toml"}, ""),
    "scene new": ({"NAME": "new-{n}"}, ""),
    "moduli": ({"STATE": "disks.h5"}, "--force"),
    "modes": ({"STATE": "disks.h5"}, ""),
    "forces": ({"STATE": "disks.h5"}, outputs("contacts")),
    "network": ({"STATE": "disks.h5"}, "--with=bonds,phases " + outputs(
        "pdf", "particle-stress", "exponents", "pressure-pdf", "like-neighbours", "clusters")),
    "lattice": ({"STATE": "balls.h5"}, "--matrix=0.05 --per-diameter=3 " + outputs("pdf")),
    "structure": ({"STATE": "disks.h5"}, outputs(
        "intensity", "pair-correlation", "gaps", "pores", "map", "porosity", "profile", "prediction")),
    "compare": ({"STATE": "disks.h5 disks.h5"}, outputs("displacements", "contacts")),
    "fit consolidation": ({"TABLE": "path.csv"}, "--law=log --window=0.01,100"),
    "fit compression": ({"TABLE": "path.csv"}, "--law=heckel"),
    "fit preconsolidation": ({"TABLE": "path.csv"}, ""),
    "fit elastic": ({"TABLE": "cycle.csv"}, ""),
    "fit cycle": ({"TABLE": "cycle.csv"}, ""),
    "fit moduli": ({"TABLE": "moduli.csv"}, ""),
    "fit strength": ({"TABLE": "sheared.csv"}, "--critical-from=0.01 --modulus=1,2"),
    "fit dynamic-compaction": ({"TABLE": "compacted.csv"}, ""),
    "fit force-distribution": ({"INPUT": "forces.csv"}, "--form=tails --draws=2"),
    "verify": ({"STATE": "disks.h5"}, ""),
    "info": ({"STATE": "disks.h5"}, ""),
    "convert": ({"IN": "disks.csv", "OUT": "out/{n}.h5"}, f"--columns=radius=r --cell={CELL} --law={LAW}"),
    "chain": ({}, "--n=3 --R=0.5 --kn=1 --kt=1 --kr=1"),
    "draw": ({"STATE": "balls.h5"}, "-o=out/{n}.png"),
    "plot": ({"INPUT": "disks.h5"}, "-o=out/{n}.svg"),
    "report": ({"DIR": "made"}, "-o=out/{n}.html"),
    # The study refuses this scene, but only after it has checked its options.
    "tradeoff": ({"SCENE": "saved.toml"}, ""),
    "plan": ({"SCENE": "scene.toml"}, "--budget=1h --pilot"),
    "demo": ({"DIR": "demo-{n}"}, ""),
    "export": ({"STATE": "disks.h5"}, "--grains=out/{n}.csv"),
    "campaign new": ({"NAME": "campaign-{n}"}, ""),
    "campaign check": ({"FILE": "campaign.toml"}, ""),
    "campaign plan": ({"FILE": "campaign.toml"}, "-o=plan-{n}"),
    "campaign run": ({"SCENE": "scene.toml"}, "-o=case-{n} --seed=1"),
    "campaign collect": ({"DIR": "plan"}, ""),
    "campaign outcome": ({"DIR": "plan"}, ""),
    "campaign page": ({"DIR": "plan"}, "-o=out/{n}.html"),
    "help columns": ({"TABLE": "moduli"}, ""),
}
# Options that need another call, because they exclude options of the call above or need additional ones.
INSTEAD = {
    ("run", "--jobs"): "-o=run-{n} --until=0 --seeds=1..1",
    ("run", "--seeds"): "-o=run-{n} --until=0",
    ("structure", "--map-size"): "--map=out/{n}.csv",
    ("draw", "--columns"): "-o=out/{n}.png",
    ("draw", "--steps"): "-o=out/{n}.png",
    ("plot", "--steps"): "-o=out/{n}.svg",
    ("plan", "--budget"): "--pilot",
    ("plan", "--check"): "",
    ("lattice", "--curve"): "--matrix=0.05 --per-diameter=3 --strength=grain=1e-9",
    ("lattice", "--cracks"): "--matrix=0.05 --per-diameter=3 --strength=grain=1e-9",
}
# Arguments that are given in addition to the tested argument.
BESIDE = {("compare", "STATE"): "{} disks.h5"}
# A failing run of a campaign is reported in a message and in a file, but the command itself succeeds.
TOLD = {("campaign run", "SCENE"), ("campaign run", "--set")}
ARGUMENTS_INSTEAD = {("draw", "--steps"): {"STATE": "made"}, ("plot", "--steps"): {"INPUT": "made"}}

# Kinds of text of the options: "in" (a file that is read), "out" (a file that is written), "dir" (a directory that is
# read), "new" (a file or directory that is made), "into" (a directory that may exist), a pattern with {} in place of
# a number, or "words".
TEXTS = {
    "SCENE": "in", "STATE": "in", "TABLE": "in", "INPUT": "in", "FILE": "in", "IN": "in", "DIR": "dir", "NAME": "new",
    "--output": "out", "--seeds": "{}..2", "--set": "equilibrium.force={}", "--columns": "words",
    "--accuracy": "B={}", "--increments": "out", "--pdf": "out", "--particle-stress": "out", "--exponents": "out",
    "--pressure-pdf": "out", "--like-neighbours": "out", "--clusters": "out", "--stiffness": "grain={}",
    "--load": "stress:{},0,0,0,0,0", "--compare": "in", "--stress": "out", "--forces": "out", "--plot": "out",
    "--map": "out", "--phases": "out", "--cut": "y,{}", "--strength": "grain={}", "--curve": "out", "--cracks": "out",
    "--intensity": "out", "--pair-correlation": "out", "--gaps": "out", "--prediction": "out", "--pores": "out",
    "--porosity": "out", "--sizes": "out", "--knobs": "words", "--phi-limit": "{}", "--profile": "out", "--displacements": "out", "--contacts": "out", "--state": "in",
    "--to": "words", "--from": "words", "--law": "normal.stiffness={}", "--cell": "{},0;0,3", "--contact-columns": "words",
    "--walls": "x={}:5", "--wall-law": "normal.stiffness={}", "--wall-ids": "{}=x-", "--gravity": "0,{}", "--wall-masses": "x+={}", ("convert", "--bonds"): "in",
    "--view": "{},20", "--slab": "z,{},0.6", "--grains": "out", "--scene": "in", "--table": "words",
    ("run", "--output"): "new", ("demo", "DIR"): "into", ("campaign plan", "--output"): "new",
    ("campaign run", "--output"): "new", ("draw", "--output"): "new", ("convert", "OUT"): "new",
    ("convert", "--contacts"): "in", ("convert", "--stress"): "{},1", ("help columns", "TABLE"): "words",
    ("campaign new", "--scene"): "words", ("campaign collect", "--table"): "words",
    ("campaign run", "--set"): "equilibrium.force={}",
    "--prices": "in", "--budget": "{}s", "--want": "phi={}", "--observables": "words", "--check": "dir",
    ("fit moduli", "--moduli"): "words",
    ("export", "--shapes"): "words",  # refused first: disks have no vertices
    ("tradeoff", "--plot"): "words",  # it is written after a study of minutes
}
# Paths inside input files, with a command that reads the file.
KEYS = {
    "grains.diameter.file": (["scene", "check"], "key.toml", SCENE.replace(
        'distribution = "constant", value = 1.0', 'distribution = "list", file = "PATH"')),
    "grains.diameter.file of a run": (["run"], "key.toml", SCENE.replace(
        'distribution = "constant", value = 1.0', 'distribution = "list", file = "PATH"')),
    "assembly.state": (["scene", "check"], "key.toml", SCENE.replace(
        'protocol = "direct"', 'protocol = "state"\nstate = "PATH"\ncopies = [1, 1]')),
    "campaign.scene": (["campaign", "check"], "key.toml", CAMPAIGN.replace("scene.toml", "PATH")),
}


class Sweep:
    def __init__(self, floc, source, directory):
        sys.path.insert(0, os.path.join(source, "docs"))
        import program
        self.floc, self.directory = floc, pathlib.Path(directory)
        self.commands = {name: command for name, command in program.Program(floc).commands.items()
                         if name and command.options}
        self.jobs, self.faults, self.numbers = [], [], itertools.count()
        self.counts = dict.fromkeys(("commands", "numeric options", "texts with numbers", "paths", "keys"), 0)
        self.values = set()

    def prepare(self):
        (self.directory / "out").mkdir()
        (self.directory / "taken" / "inside").mkdir(parents=True)
        for name, text in {"scene.toml": SCENE, "campaign.toml": CAMPAIGN, "disks.csv": GRAINS, "balls.csv": BALLS,
                           "path.csv": PATH, "cycle.csv": CYCLE, "compacted.csv": COMPACTED, "sheared.csv": SHEARED,
                           "forces.csv": FORCES, "moduli.csv": MODULI, "file": "a file\n"}.items():
            (self.directory / name).write_text(text)
        balls_law = f"--law={LAW}"
        for arguments in (["convert", "disks.csv", "disks.h5", "--columns=radius=r", f"--cell={CELL}", f"--law={LAW}"],
                          ["convert", "balls.csv", "balls.h5", "--columns=radius=r", "--cell=2,0,0;0,2,0;0,0,2", balls_law],
                          ["run", "scene.toml", "-o", "made"], ["campaign", "plan", "campaign.toml", "-o", "plan"]):
            done = self.call(arguments)
            assert done.returncode == 0, done.stderr
        for table in ("runs", "means", "fits", "outcomes"):
            (self.directory / "plan" / f"{table}.csv").write_text(self.call(["campaign", "collect", "plan", "--table", table]).stdout)
        (self.directory / "saved.toml").write_text(SCENE.replace(
            'protocol = "direct"', 'protocol = "state"\nstate = "made/state-0000.h5"\ncopies = [1, 1]')
            .replace('[grains]\ncount = 6\ndiameter = {distribution = "constant", value = 1.0}\n', "")
            .replace("solid_fraction = 0.5\n", ""))

    def call(self, arguments):
        return subprocess.run([self.floc, *arguments], cwd=self.directory, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=LIMIT, errors="replace")

    def line(self, name, option, value):
        """Returns the arguments of a call in which an option or argument has a given value."""
        arguments, options = CALLS[name]
        arguments = {**arguments, **ARGUMENTS_INSTEAD.get((name, option), {})}
        words = INSTEAD.get((name, option), options).split()
        if option in arguments:
            arguments = {**arguments, option: value}
        else:
            excluded = self.excluded(name, option)
            words = [word for word in words if word.split("=")[0].replace("-o", "--output") not in {option, *excluded}]
            words.append(f"{option}={value}".replace(" ", "\0"))
        n = str(next(self.numbers))
        given = [word for text in arguments.values() for word in text.split()] + words
        given = [part for word in given for part in (word.split("=", 1) if word.startswith("-o=") else [word])]
        return name.split() + [word.replace("{n}", n).replace("\0", " ") for word in given]

    def excluded(self, name, option):
        for one in self.commands[name].options:
            if option in self.names_of(one):
                return one.excluded
        return []

    @staticmethod
    def names_of(option):
        """Returns the names of an option or argument: ["--output"] for "-o,--output", ["IN", "OUT"] for "IN...
        OUT"."""
        if option.is_argument:
            return re.findall(r"[A-Z]+", option.names)
        return [option.names.split(",")[-1]]

    def add(self, arguments, codes, named):
        self.jobs.append((arguments, codes, named))

    def add_number(self, name, option, pattern, kind):
        never = NEVER + (NEVER_WHOLE if kind == "whole" else [])
        if kind == "TOML":
            never = [value for value in never if value != "0x10"]  # which is a number there
        self.values.update(never + SOMETIMES)
        for value in never:
            self.add(self.line(name, option, pattern.replace("{}", value)), self.refused(name, option), option)
        for value in SOMETIMES:
            self.add(self.line(name, option, pattern.replace("{}", value)), CODES, None)

    def add_path(self, name, option, kind):
        wrong = {"in": ["taken", "nowhere/file", "file/below", "/proc/self/mem"], "out": ["taken"],
                 "dir": ["nowhere", "file"], "new": ["taken"], "into": ["file"]}[kind]
        self.values.update(wrong)
        for value in wrong:
            self.add(self.line(name, option, BESIDE.get((name, option), "{}").replace("{}", value)),
                     CODES if kind == "new" else self.refused(name, option), None if kind == "new" else value)

    @staticmethod
    def refused(name, option):
        return CODES if (name, option) in TOLD else REFUSED

    def collect(self):
        for name, command in self.commands.items():
            self.counts["commands"] += 1
            if name not in CALLS:
                self.faults.append(f"CALLS has no call of floc {name}")
                continue
            for option in command.options:
                for one in self.names_of(option):
                    self.collect_option(name, option, one)
        for key, (words, file, text) in KEYS.items():
            self.counts["keys"] += 1
            for number, value in enumerate(("taken", "nowhere", "/proc/self/mem")):
                path = f"{key.replace(' ', '-')}-{number}-{file}"
                (self.directory / path).write_text(text.replace("PATH", value))
                self.add([*words, path, *(["-o", path + ".d"] if words == ["run"] else [])], REFUSED, value)

    def collect_option(self, name, option, one):
        if option.keywords or not (option.takes or option.is_argument):
            return
        if "number" in option.takes:
            whole = "whole" in option.takes
            several = {"--fit-range": "0.1,{}", "--window": "0.01,{}", "--map-size": "3,{}"}
            if re.fullmatch(r"2, 3", option.takes):
                return
            self.counts["numeric options"] += 1
            self.add_number(name, one, several.get(one, "{}"), "whole" if whole else "number")
            return
        kind = TEXTS.get((name, one), TEXTS.get(one))
        if kind is None:
            self.faults.append(f"TEXTS does not say what {one} of floc {name} is")
        elif "{}" in kind:
            self.counts["texts with numbers"] += 1
            self.add_number(name, one, kind, {"--seeds": "whole", "--set": "TOML"}.get(one, "number"))
        elif kind != "words":
            self.counts["paths"] += 1
            self.add_path(name, one, kind)

    def try_one(self, job):
        arguments, codes, named = job
        words = "floc " + " ".join(arguments)
        try:
            done = self.call(arguments)
        except subprocess.TimeoutExpired:
            return f"{words}: takes more than {LIMIT:g} s"
        if done.returncode not in codes:
            return f"{words}: exit code {done.returncode}, expected one of {sorted(codes)}: {done.stderr.strip()[-400:]}"
        plain = named and named.lstrip("-").replace("-", "_")
        if named and plain not in done.stderr.replace("-", "_"):
            return f"{words}: does not name {named}: {done.stderr.strip()[-400:]}"
        return None

    def run(self):
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            self.faults += [fault for fault in pool.map(self.try_one, self.jobs) if fault]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--floc", required=True)
    parser.add_argument("--source", required=True)
    arguments = parser.parse_args()
    began = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="floc-values-") as directory:
        sweep = Sweep(arguments.floc, arguments.source, directory)
        sweep.prepare()
        sweep.collect()
        sweep.run()
    for fault in sweep.faults:
        print("FAULT:", fault)
    counts = ", ".join(f"{n} {what}" for what, n in sweep.counts.items())
    print(f"{counts}; {len(sweep.values)} values; {len(sweep.jobs)} calls in {time.monotonic() - began:.0f} s; "
          f"{len(sweep.faults)} faults")
    return 1 if sweep.faults else 0


if __name__ == "__main__":
    sys.exit(main())
