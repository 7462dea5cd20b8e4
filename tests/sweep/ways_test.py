"""Runs every scene of loads.py in every possible way, and compares the states bit for bit:

  ways_test.py --floc PROGRAM [--only WORDS]

A scene that is refused must be refused in every way, with exit code 4 or 2 and a message. No way may end with a
signal. The Python package is used if it can be imported; it needs the modules of this program."""
import argparse
import collections
import csv
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import warnings

import loads

try:
    import floc as package
except ImportError:
    package = None

TIMEOUT = 300
NOTHING_SELECTED = 5  # exit code


class Failure(Exception):
    pass


def states_of(directory):
    """Returns the bytes of each state, and the path without wall times."""
    found = {path.name: path.read_bytes() for path in sorted(directory.glob("state-*.h5"))}
    if not found:
        raise Failure(f"{directory.name}: no state")
    return found


class Ways:
    """The ways to run one scene. Each raises a Failure if its states differ from those of floc run."""

    def __init__(self, program, scene, directory):
        self.program, self.scene, self.directory = program, scene, directory
        self.n_checkpoints = 0
        self.expected = {}

    def floc(self, *arguments, code=0, cwd=None):
        done = subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True, cwd=cwd or self.directory,
                              timeout=TIMEOUT)
        if done.returncode not in (code if isinstance(code, tuple) else (code,)):
            raise Failure(f"floc {' '.join(map(str, arguments))}: exit code {done.returncode}, expected {code}: "
                          f"{done.stderr[-2000:]}")
        return done.stdout + done.stderr

    def run(self, name, *options, **kwargs):
        self.floc("run", self.scene, "-o", name, "--no-timing", *options, **kwargs)
        return self.directory / name

    def plain(self):
        self.expected = states_of(self.run("plain"))

    def require_same(self, directory, n_states=None):
        if states_of(directory) != dict(list(self.expected.items())[:n_states]):
            raise Failure(f"{directory.name}: other states than those of floc run")

    def seeds(self):
        self.require_same(self.run("seeds", "--seeds", "1..1", "--until", "0") / "seed-1", 1)

    def jobs(self):
        self.run("jobs", "--seeds", "1..2", "--jobs", "2", "--threads", "2")
        if states_of(self.directory / "jobs/seed-2") == states_of(self.directory / "jobs/seed-1"):
            raise Failure("two seeds gave the same states")
        self.require_same(self.directory / "jobs/seed-1")

    def resumed(self):
        """Stops the run after some states and resumes it, with tracking of contacts, which must not change
        anything."""
        options = ["--track-contacts", "0.5"]
        if "[box]" in self.scene.read_text():
            self.run("resumed", *options, code=4)
            options = []
        self.run("resumed", *options, "--until", "1")
        self.require_same(self.run("resumed", *options, "--resume"))

    def killed(self):
        """Kills the run at its first checkpoint, or at its end if it is too fast, and resumes it."""
        process = subprocess.Popen([self.program, "run", self.scene, "-o", "killed", "--no-timing"], cwd=self.directory,
                                   stderr=subprocess.DEVNULL)
        checkpoint = self.directory / "killed/checkpoint/checkpoint.h5"
        while process.poll() is None and not checkpoint.exists():
            time.sleep(0.001)
        process.send_signal(signal.SIGKILL)
        process.wait(TIMEOUT)
        self.n_checkpoints += checkpoint.exists()
        self.require_same(self.run("killed", "--resume"))

    def checked(self):
        self.floc("scene", "check", self.scene)

    def campaign(self):
        """Calls the program as the rules of a Snakefile do."""
        (self.directory / "plan.toml").write_text(f'[campaign]\nscene = "{self.scene.name}"\nseeds = "1..1"\n'
                                                  '[[collect]]\ntable = "path"\ncolumns = ["phi", "z"]\n')
        self.floc("campaign", "plan", "plan.toml", "-o", "campaign")
        campaign = self.directory / "campaign"
        sample = f"runs/{self.scene.stem}/seed-1"
        self.floc("campaign", "run", "scene.toml", "--seed", "1", "-o", sample, cwd=campaign)
        (campaign / "runs.csv").write_text(self.floc("campaign", "collect", ".", "--table", "runs", "--format", "csv",
                                                     cwd=campaign))
        if (campaign / "scene.toml").read_text() != self.scene.read_text():  # states hold the scene, and files in it
            self.require_same_path(campaign / sample)
        else:
            self.require_same(campaign / sample)

    def require_same_path(self, directory):
        """Compares all digits of every row, except wall times."""
        rows = []
        for file in (directory / "path.csv", self.directory / "plain/path.csv"):
            with open(file, newline="") as lines:
                rows.append([{**row, "seconds": ""} for row in csv.DictReader(lines)])
        if rows[0] != rows[1]:
            raise Failure("another path than that of floc run")

    def python(self):
        """Stops the run with a Python exception in the middle of a stage, and resumes it."""
        def stop(progress):
            if progress.step > 0 and not progress.equilibrium:
                raise InterruptedError

        directory = self.directory / "python"
        try:
            package.run(self.scene, directory, timing=False, on_progress=stop, interval=0.0)
        except InterruptedError:
            self.n_checkpoints += 1
            package.run(self.scene, directory, timing=False, resume=True)
        self.require_same(directory)

    def all(self):
        ways = [self.checked, self.seeds, self.jobs, self.resumed, self.killed, self.campaign]
        return ways + ([self.python] if package else [])

    def refuse(self, words):
        """Checks that the scene is refused in every way. @return number of ways"""
        def words_in(text):
            if words not in text or "terminate" in text:
                raise Failure(f"refused in other words than \"{words}\": {text[-2000:]}")

        refusals = [("scene", "check", self.scene), ("run", self.scene, "-o", "x"),
                    ("run", self.scene, "-o", "x", "--seeds", "1..2", "--jobs", "2"), ("campaign", "plan", "plan.toml", "-o", "x")]
        (self.directory / "plan.toml").write_text(f'[campaign]\nscene = "{self.scene.name}"\nseeds = "1..1"\n'
                                                  '[[collect]]\ntable = "path"\ncolumns = ["phi"]\n')
        for refusal in refusals:
            words_in(self.floc(*refusal, code=(2, 4)))
            if (self.directory / "x").exists():
                raise Failure(f"{' '.join(map(str, refusal))}: refused, but it left a directory")
        if package:
            try:
                package.run(self.scene, self.directory / "x")
                raise Failure("Python did not refuse it")
            except package.InputError as error:
                words_in(str(error))
        return len(refusals) + bool(package)


def save_states(program, directory):
    """Makes the states from which scenes start."""
    for dimension, name in loads.SAVED_STATE.items():
        scene = directory / f"save{dimension}.toml"
        scene.write_text(loads.powder(dimension))
        ways = Ways(program, scene, directory)
        shutil.copy(ways.run(f"save{dimension}") / "state-0000.h5", directory / name)


def refuse_threads(program, directory):
    """If OpenMP cannot start the requested number of threads, no thread may wait for one that never starts. With
    fewer grains the program would use one thread."""
    scene = directory / "threads.toml"
    scene.write_text(loads.powder(2).replace(f"count = {loads.GRAINS}", "count = 2800"))
    done = subprocess.run([program, "run", scene, "-o", "threads", "--threads", "2"], cwd=directory, capture_output=True, text=True,
                          timeout=60, env={**os.environ, "OMP_THREAD_LIMIT": "1"})
    if done.returncode != 4 or "OMP_THREAD_LIMIT" not in done.stderr:
        raise Failure(f"exit code {done.returncode}: {done.stderr[-2000:]}")


class Sweep:
    def __init__(self, program, root, only):
        self.program, self.root, self.only = program, root, only
        self.covered, self.faults = collections.Counter(), []

    def samples(self, scenes):
        for number, scene in enumerate(scenes):
            for dimension in scene.dimensions:
                if self.only in scene.name:
                    yield number, scene, dimension

    def ways_of(self, scene, dimension, kind, number):
        directory = self.root / f"{kind}{number}-{dimension}"
        directory.mkdir()
        for name in loads.SAVED_STATE.values():
            shutil.copy(self.root / name, directory)
        file = directory / "small.toml"
        file.write_text(scene.text(dimension))
        return Ways(self.program, file, directory)

    def guard(self, what, task):
        try:
            return task()
        except (Failure, subprocess.TimeoutExpired) as error:
            self.faults.append(f"{what}: {error}")
        except Exception as error:  # what Python raises is a fault too
            self.faults.append(f"{what}: {type(error).__name__}: {error}")
        return None

    def compare(self, scene, dimension, ways):
        ways.plain()
        self.covered["states"] += len(ways.expected)
        for way in ways.all():
            self.guard(f"{scene.name} in {dimension}D, {way.__name__}", way)
            self.covered["ways"] += 1
        self.covered["checkpoints"] += ways.n_checkpoints

    def run(self):
        save_states(self.program, self.root)
        self.guard("too few threads", lambda: refuse_threads(self.program, self.root))
        for number, scene, dimension in self.samples(loads.SCENES):
            ways = self.ways_of(scene, dimension, "run", number)
            self.guard(f"{scene.name} in {dimension}D", lambda: self.compare(scene, dimension, ways))
            self.covered["scenes"] += 1
            shutil.rmtree(ways.directory)
        for number, scene, dimension in self.samples(loads.REFUSED):
            ways = self.ways_of(scene, dimension, "refused", number)
            n = self.guard(f"{scene.name} in {dimension}D", lambda: ways.refuse(scene.refused))
            self.covered["refusals"] += n or 0
            self.covered["refused scenes"] += 1

    def report(self):
        c = self.covered
        print(f"controls: {', '.join(loads.controls())}")
        print(f"scenes: {c['scenes']} in 2D and 3D, {c['states']} states, each by floc run and {c['ways']} other ways in all, "
              f"{c['checkpoints']} resumed from checkpoints; Python: {'yes' if package else 'not built'}")
        print(f"refused: {c['refused scenes']} scenes, {c['refusals']} refusals in words")
        for fault in self.faults:
            print(f"FAULT {fault}")
        if self.faults:
            return 1
        return 0 if c["scenes"] + c["refused scenes"] > 0 else NOTHING_SELECTED


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--floc", required=True, help="the program")
    parser.add_argument("--only", default="", help="scenes whose name holds these words")
    arguments = parser.parse_args()
    warnings.simplefilter("ignore")  # of what the program says too
    with tempfile.TemporaryDirectory(prefix="floc-ways-") as root:
        sweep = Sweep(os.path.abspath(arguments.floc), pathlib.Path(root), arguments.only)
        sweep.run()
    return sweep.report()


if __name__ == "__main__":
    sys.exit(main())
