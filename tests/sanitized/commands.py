"""Runs every command of a program with states of every kind; tests/sanitized/run calls it with a program that has
sanitizers:

  commands.py --floc PROGRAM --source DIR [--only WORDS]

A command may refuse a state for which it is not meant, with a message and an exit code of its own (2, 3, 4 or 5). It
may not end with a signal or a report of a sanitizer. Each command has to succeed with some kind of state, and each
kind with some command."""
import argparse
import collections
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "sweep"))
import loads  # noqa: E402

TIMEOUT = 900
EXIT_CODES = (0, 2, 3, 4, 5)
NOTHING_SELECTED = 5  # exit code of this script
REPORTS = ("AddressSanitizer", "LeakSanitizer", "runtime error:", "terminate called", "Assertion")

# {state} is the last state of {run}, {first} the first one.
COMMANDS = """
verify {run}
verify {state} --format json
info {state} --format json
info {state} --scene
moduli {run} --columns all
moduli {state} --strains full --prestress
moduli {state} --method bounds
moduli {state} --method iterative
moduli {state} --method single-factor
moduli {state} --increments increments.csv --force
moduli {state} --rolling-stiffness 1,10
modes {state} --count 5
forces {state} --contacts contacts.csv --range-of 0,1
forces {state} --selection canonical --gap 1e-3
network {run} --columns all
network {state} --with bonds,phases
network {state} --without mechanics --pdf forces.csv --unit F0 --particle-stress stress.csv
network {state} --exponents e.csv --pressure-pdf p.csv --like-neighbours l.csv --clusters c.csv
structure {run}
structure {state} --average --intensity I.csv --prediction u.csv
structure {state} --pair-correlation g.csv --gaps z.csv --pores pores.csv --map phi.csv --map-size 16,16
structure {state} --porosity e.csv --probes 200 --profile slices.csv --profile-axis y --slices 5
compare {first} {state} --displacements u.csv --contacts c.csv
compare {run} --against-first
export {state} --grains grains.csv --contacts contacts.csv
convert {state} out.vtu
convert {state} out.xyz
convert {state} out.data
convert out.vtu from-vtu.h5 --law normal.stiffness=1000 --overwrite
convert out.xyz from-xyz.h5 --law normal.stiffness=1000 --overwrite
convert out.data from-data.h5 --law normal.stiffness=1000 --overwrite
lattice {state} --matrix 0.05 --per-diameter 5 --stiffness grain=100,matrix=1 --load compression --stress s.csv --forces f.csv
lattice {state} --matrix 0.05 --per-diameter 5 --stiffness grain=100,matrix=1 --load tension --moduli
lattice {state} --matrix 0.05 --per-diameter 5 --stiffness grain=100,matrix=1 --load strain:0,0.01,0 --boundary uniform-strain --phases p.svg
lattice {state} --matrix 0.05 --per-diameter 5 --load strain:0,0,0.01,0,0,0.02 --boundary uniform-strain --map m.png --cut x,0.3
lattice {state} --matrix 0.05 --per-diameter 5 --load compression --boundary plates --pdf pdf.csv
lattice {state} --matrix 0.05 --per-diameter 5 --stiffness grain=100,matrix=1 --load tension --strength grain=10,matrix=1 --end-at 0.99 --curve c.csv --cracks c.svg --yes
draw {state} -o forces.svg
draw {state} -o forces.png --forces particle-pressure --width 20
draw {state} -o forces.pdf --forces phases
draw {state} -o section.svg --cut z,0.4 --forces particle-pressure
draw {state} -o increment.pdf --forces increment
draw {run} -o strip.svg --steps 0,1
draw {first} -o change.svg --compare {state}
plot {run} -o plot.svg
plot {run} -o moduli.svg --show moduli
plot {run} -o coordination.svg --show coordination
plot {run} -o forces.svg --show forces
plot {run} -o pressures.svg --show pressures
plot {run} -o scattering.svg --show scattering
plot {run} -o test.svg --show test
plot {run} -o fabric.svg --show fabric
report {run} -o report.html
fit consolidation {run} --bootstrap 20
fit compression {run}
fit elastic {run}
fit preconsolidation {run}
fit cycle {run}
fit strength {run}
fit force-distribution {state} --draws 20
fit force-distribution {state} --form tails --draws 5
""".strip().splitlines()

# Commands without a state; each of them has to succeed.
ALONE = """
chain --n 20 --R 0.5 --kn 1 --kt 1 --kr 1e-4
chain --n 20 --R 0.5 --kn 1 --kt 1 --kr 1e-4 --bend 2
scene new powder
scene check powder.toml --set grains.count=40
run powder.toml -o powder --set grains.count=30 --until 1
campaign new study
campaign check study.toml
help columns
fit consolidation {source}/data/tables/demo --law log
fit preconsolidation {source}/data/tables/reload
fit consolidation {source}/data/tables/oedometer/oedometer.csv --loading virgin --law log --window 200,6400
info {source}/data/tables/oedometer/oedometer.csv
plot {source}/data/tables/demo -o tables.svg
convert {source}/data/packings/disks/disks16.txt disks.h5
tradeoff small.toml --budget 60 --samples 1 --observables phi
""".strip().splitlines()

# Additional scenes: pressure cycles, and a run with --track-energy.
CYCLE = loads.stage("to = 4.0", "steps = 6") + loads.stage("to = 0.5", "steps = 5") + loads.stage("to = 6.0", "steps = 6")
DYNAMIC = loads.stage("to = 0.6", "steps = 1")


def kinds():
    """Returns a scene for each kind of state."""
    for dimension in (2, 3):
        yield f"powder {dimension}D", loads.powder(dimension) + CYCLE
        yield f"sheared {dimension}D", loads.powder(dimension) + loads.stage('control = "simple_shear"', "strain = 0.02", "steps = 2")
        yield f"sand {dimension}D", loads.sand(dimension) + loads.stage('control = "triaxial"', "strain = 0.01", "steps = 2")
        yield f"wet {dimension}D", loads.wet(dimension) + loads.stage("to = 1.0", "steps = 2")
        yield f"box {dimension}D", loads.box(dimension) + loads.stage("to = 0.8", "steps = 2")
    yield "beads 3D", loads.beads(3) + loads.stage("to = 2.0", "steps = 2")


class Sweep:
    def __init__(self, program, source, root, only):
        self.program, self.source, self.root, self.only = program, source, root, only
        self.done, self.refused = collections.Counter(), collections.Counter()
        self.n_faults, self.names = 0, []

    def fault(self, words):
        """Prints a fault immediately, because the sweep takes minutes."""
        self.n_faults += 1
        print(f"FAULT {words}", flush=True)

    def floc(self, what, command, directory):
        """Runs a command with a state. @return whether it succeeded"""
        arguments = shlex.split(command)
        try:
            done = subprocess.run([self.program, *arguments], capture_output=True, cwd=directory, timeout=TIMEOUT)
        except subprocess.TimeoutExpired:
            self.fault(f"{what}: floc {command}: takes more than {TIMEOUT} s")
            return False
        words = done.stderr.decode(errors="replace")
        if done.returncode not in EXIT_CODES or any(report in words for report in REPORTS):
            self.fault(f"{what}: floc {command}: exit code {done.returncode}: {words[-3000:]}")
        elif done.returncode and not words.strip():
            self.fault(f"{what}: floc {command}: exit code {done.returncode} without a word")
        return done.returncode == 0

    def analyse(self, kind, directory, run):
        states = sorted((directory / run).glob("state-*.h5"))
        if not states:
            self.fault(f"{kind}: no state")
            return
        for command in COMMANDS:
            if self.floc(kind, command.format(state=states[-1], first=states[0], run=run), directory):
                self.done[command] += 1
                self.done[kind] += 1
            else:
                self.refused[command] += 1

    def kinds(self):
        n = 0
        for kind, text in kinds():
            if self.only not in kind:
                continue
            self.names.append(kind)
            directory = self.root / kind.replace(" ", "-")
            directory.mkdir()
            (directory / "scene.toml").write_text(text)
            self.floc(kind, "run scene.toml -o run", directory)
            self.analyse(kind, directory, "run")
            if not self.done[kind]:
                self.fault(f"{kind}: no command succeeded")
            tracked = text.replace("[equilibrium]", '[equilibrium]\nfinish = "dynamic"')
            (directory / "tracked.toml").write_text(tracked)
            self.floc(kind, "run tracked.toml -o tracked --track-energy --until 1", directory)
            n += 1
        for command in COMMANDS:
            if n and not self.only and not self.done[command]:
                self.fault(f"floc {command}: succeeded with no kind of state")
        return n

    def shipped(self):
        """Runs every shipped scene with few grains up to its second state."""
        n = 0
        for scene in sorted((self.source / "data/scenes").glob("*.toml")):
            if self.only not in scene.name:
                continue
            self.names.append(scene.name)
            text = scene.read_text()
            # Lists of diameters cannot be shortened, and scenes of rigid grains take minutes.
            whole = 'distribution = "list"' in text or 'normal = {law = "rigid"}' in text
            few = [] if whole else ["--set", "grains.count=24"]
            self.floc(scene.name, f"scene check {scene}", self.root)
            command = ["run", str(scene), "-o", scene.stem, "--until", "1", *few]
            if few and self.floc(scene.name, shlex.join(command), self.root):
                n += 1
        return n

    def alone(self):
        directory = self.root / "alone"
        directory.mkdir()
        (directory / "small.toml").write_text(loads.powder(2) + loads.stage("to = 1.0", "steps = 1"))
        n = 0
        for command in ALONE:
            if self.only not in command:
                continue
            self.names.append(command)
            if self.floc("alone", command.format(source=self.source), directory):
                n += 1
            else:
                self.fault(f"floc {command}: does not succeed")
        return n


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--floc", required=True, help="the program")
    parser.add_argument("--source", required=True, help="folder of the sources")
    parser.add_argument("--only", default="", help="kinds, scenes and commands with these words in their names")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="floc-commands-") as root:
        sweep = Sweep(os.path.abspath(arguments.floc), pathlib.Path(arguments.source).resolve(), pathlib.Path(root), arguments.only)
        n_kinds, n_shipped, n_alone = sweep.kinds(), sweep.shipped(), sweep.alone()
    print(f"kinds of states: {n_kinds} ({', '.join(sweep.names[:n_kinds])}); commands on each: {len(COMMANDS)}, "
          f"{sum(sweep.done[c] for c in COMMANDS)} done, {sum(sweep.refused.values())} refused in words")
    print(f"shipped scenes of few grains: {n_shipped} run; commands without a state: {n_alone} done")
    if sweep.n_faults:
        return 1
    return 0 if sweep.names else NOTHING_SELECTED


if __name__ == "__main__":
    sys.exit(main())
