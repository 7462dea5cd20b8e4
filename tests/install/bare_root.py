#!/usr/bin/python3
"""Follows README and the documentation on a bare Debian 12 in the way of a new user, without any other step.

    bare_root.py packages --source DIRECTORY --build DIRECTORY     what docs/install.md says of Debian packages
    bare_root.py clone --source DIRECTORY                          what README says of a clone: .ci/demo

The first command makes the packages of the build and requires that lintian finds no error in them.

Each command makes a root with debootstrap from the package server that apt uses on this machine, runs the blocks of
README, of the first tutorial and of its Python example, and compares their output with the pages. It has to run as
root, and otherwise exits with code 77. --keep keeps the root.
"""
import argparse
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../docs"))
import pages  # noqa: E402

NOT_TRIED = 77


class Root:
    """A bare Debian, in which every command runs in a new shell."""

    HOME = "/root/work"

    def __init__(self, directory):
        self.directory = directory
        uri = subprocess.run(["apt-get", "indextargets", "--format", "$(REPO_URI)", "Created-By: Packages",
                              "Codename: bookworm"], capture_output=True, text=True, check=True).stdout.split()[0]
        subprocess.run(["debootstrap", "--variant=minbase", "bookworm", directory, uri], check=True,
                       stdout=subprocess.DEVNULL)
        for part in ("sources.list", "sources.list.d", "apt.conf.d", "auth.conf.d"):
            source, target = f"/etc/apt/{part}", f"{directory}/etc/apt/{part}"
            if os.path.isdir(source):
                shutil.copytree(source, target, dirs_exist_ok=True)
            elif os.path.exists(source):
                shutil.copy(source, target)
        with open(f"{directory}/etc/apt/apt.conf.d/90yes", "w", encoding="ascii") as file:
            file.write('APT::Get::Assume-Yes "true";\n')  # what a reader answers
        for name in ("resolv.conf", "hosts"):
            shutil.copy(f"/etc/{name}", f"{directory}/etc/{name}")
        os.makedirs(directory + self.HOME)
        for kind, place in (("proc", "proc"), ("sysfs", "sys")):
            subprocess.run(["mount", "-t", kind, kind, f"{directory}/{place}"], check=True)
        subprocess.run(["mount", "--bind", "/dev", f"{directory}/dev"], check=True)
        self.environment = {"PATH": "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root",
                            "LANG": "C.UTF-8", "DEBIAN_FRONTEND": "noninteractive"}
        self.run("apt-get update -qq")

    def run(self, commands, check=True):
        """Runs commands. @return their stdout"""
        print("$", commands.strip().replace("\n", "\n  "), flush=True)
        done = subprocess.run(["chroot", self.directory, "/bin/bash", "-c", f"set -e; cd {self.HOME}; {commands}"],
                              env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT if check else None,
                              text=True)
        if check and done.returncode != 0:
            raise AssertionError(f"exit code {done.returncode}:\n{done.stdout[-3000:]}")
        return done.stdout

    def close(self):
        for place in ("dev", "sys", "proc"):
            subprocess.run(["umount", "--lazy", f"{self.directory}/{place}"], check=False)


class Reader:
    """Runs the commands of the pages and compares their output with the pages."""

    def __init__(self, root, source):
        self.root, self.source, self.faults = root, source, 0
        self.page = {page.name: page for page in pages.Documentation(source).pages}

    def fault(self, words):
        self.faults += 1
        print("FAULT:", words, flush=True)

    def block(self, name, part):
        found = [text for language, text, _ in self.page[name].blocks if language == "sh" and part in text]
        if len(found) != 1:
            raise AssertionError(f"{name} has {len(found)} blocks with {part!r}, expected one")
        return found[0]

    def compare_numbers(self, place, said, printed):
        """Compares the numbers of a part of a page with the printed numbers, in order."""
        numbers, others = pages.NUMBER.findall(said), pages.NUMBER.findall(printed)
        if len(numbers) != len(others) or not all(map(pages.rounds_to, numbers, map(float, others))):
            self.fault(f"{place} says\n{said}\nbut this was printed:\n{printed}")

    def first_result(self):
        """Runs the commands of README: run, moduli, picture, fit."""
        said = self.page["README.md"]
        moduli = self.block("README.md", "floc run data/scenes/demo.toml -o demo")
        run, table = moduli.strip().split("\n")
        self.root.run(run + " --resume" if os.path.exists(f"{self.root.directory}{self.root.HOME}/demo") else run)
        shown = next(text for language, text, _ in said.blocks if language == "text" and "B_reuss" in text)
        self.compare_numbers("README.md", shown, self.root.run(table))
        self.root.run(self.block("README.md", "floc draw demo -o strip.svg"))
        for name in ("strip.svg", "consolidation.svg"):
            if not os.path.exists(f"{self.root.directory}{self.root.HOME}/{name}"):
                self.fault(f"README.md: there is no {name}")

    def python(self):
        """Runs the five lines of Python in README, some of which end with their output."""
        code = next(text for language, text, _ in self.page["README.md"].blocks if language == "python")
        self.root.run(f"cat > example.py <<'END'\n{code}END")
        printed = self.root.run("python3 -W error::DeprecationWarning example.py").strip().split("\n")
        said = [line.split("# ")[1] for line in code.split("\n") if line.startswith("print(")]
        if len(said) != len(printed) or not said:
            self.fault(f"README.md: the example prints {printed}, expected {len(said)} lines")
        for one, other in zip(said, printed):
            self.compare_numbers("README.md, Python", one, other)

    def tutorial(self):
        """Runs the first tutorial from its plots on; README contains the run itself."""
        name = "docs/tutorials/powder2d.md"
        self.root.run(self.block(name, "floc plot demo"))
        printed = self.root.run(self.block(name, "floc moduli demo")).strip().split("\n")
        header, *rows = [line.split(",") for line in printed]
        columns = {"branch": "branch", "P*": "P_star", "Phi": "phi"}
        table = next((header, rows) for header, rows, _ in self.page[name].tables if "B_reuss" in header)
        names = [cell.strip() for cell in table[0].strip().strip("|").split("|")]
        places = [header.index(columns.get(one, one)) for one in names if columns.get(one, one) in header]
        wanted = [k for k, one in enumerate(names) if columns.get(one, one) in header]
        for row in table[1]:
            if not any(all(pages.rounds_to(row[k], float(other[place])) for k, place in zip(wanted, places))
                       for other in rows):
                self.fault(f"{name}: no state has the row {row}")
        self.root.run(self.block(name, "floc scene new powder"))
        self.root.run(self.block(name, "--until 1"))
        self.root.run(self.block(name, "--seeds 1..4"))

    def demo_says(self, printed):
        """Checks the law of six samples, which the tutorial also prints."""
        names = {"P1*": "P1_star", "P0*": "P0_star"}
        tables = self.page["docs/tutorials/powder2d.md"].tables
        for name, value, error, _ in next(rows for header, rows, _ in tables if "standard error" in header):
            line = re.search(rf"^\s*{names.get(name, name)}\s+(\S+)\s+(\S+)", printed, re.MULTILINE)
            # Page and program show "-" if the data do not identify a parameter.
            if not line or not all(shown == said if "-" in (shown, said) else pages.rounds_to(shown, float(said))
                                   for shown, said in ((value, line[1]), (error, line[2]))):
                self.fault(f"floc demo: expected {name} = {value} +- {error} in\n{printed[-3000:]}")


def packages_of(build, directory):
    """Makes the packages of a build and checks them with lintian. @return faults"""
    subprocess.run(["cpack", "-B", directory], cwd=build, check=True, stdout=subprocess.DEVNULL)
    packages = sorted(glob.glob(f"{directory}/*.deb"))
    if not shutil.which("lintian"):
        print("NOT TRIED: no lintian is installed")
        return packages, []
    said = subprocess.run(["lintian", "--allow-root", "--tag-display-limit", "0", *packages], capture_output=True,
                          text=True).stdout
    print(said)
    return packages, [line for line in said.split("\n") if line.startswith("E:")]


def try_packages(reader, build):
    root, page = reader.root, "docs/install.md"
    with tempfile.TemporaryDirectory(prefix="floc-packages-") as directory:
        packages, errors = packages_of(build, directory)
        for package in packages:
            shutil.copy(package, root.directory + root.HOME)
    for error in errors:
        reader.fault(error)
    before = set(root.run("find /usr /etc -not -path '*/__pycache__*'").split("\n"))
    reader.demo_says(root.run(reader.block(page, "apt install ./floc_")))
    root.run(reader.block(page, "ln -s /usr/share/floc data"))
    reader.first_result()
    reader.tutorial()
    reader.python()
    for file in ("man/man1/floc-moduli.1.gz", "bash-completion/completions/floc"):
        root.run(f"test -e /usr/share/{file}")
    # Checks the library with the program in docs/install.md.
    root.run(reader.block(page, "apt install ./libfloc-dev"))
    cmake = next(text for language, text, _ in reader.page[page].blocks if language == "cmake")
    code = next(text for language, text, _ in reader.page[page].blocks if language == "cpp")
    root.run(f"cat > CMakeLists.txt <<'END'\n{cmake}END\ncat > stiffness.cc <<'END'\n{code}END")
    printed = root.run("cmake -S . -B build >build.log && cmake --build build >>build.log && "
                       "build/stiffness demo/state-0026.h5")
    reader.compare_numbers(page, "B = 28042.5, G = 10037.1", printed)
    root.run("apt-get install -qq ./floc-petsc_*.deb >install.log 2>&1; export OMPI_ALLOW_RUN_AS_ROOT=1 "
             "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; mpirun --oversubscribe -n 2 floc moduli --solver petsc "
             "demo/state-0026.h5 --columns B,G --format csv >petsc.csv")
    # After removal, only packages that floc needed remain.
    root.run("apt-get purge -qq floc libfloc-dev python3-floc floc-petsc >purge.log 2>&1")
    left = [line for line in root.run("find / -xdev -ipath '*floc*' -not -path '/root/*' -not -path '/proc/*' "
                                      "-not -path '/sys/*'").split("\n") if line and line not in before]
    # The name flock belongs to another program.
    left = [line for line in left if not line.startswith("/var/cache/apt") and re.search(r"floc(?!k)", line)]
    if left:
        reader.fault("the packages leave behind " + ", ".join(left[:10]))


def try_clone(reader):
    root = reader.root
    root.run("apt-get install -qq --no-install-recommends git ca-certificates >install.log 2>&1")
    subprocess.run(["git", "clone", "--quiet", reader.source, f"{root.directory}{root.HOME}/floc"], check=True)
    root.HOME += "/floc"
    # The other line of the block runs the tests, which .ci/run does elsewhere.
    demo = next(line for line in reader.block("README.md", ".ci/demo ").split("\n") if line.startswith(".ci/demo"))
    reader.demo_says(root.run(demo))
    program = reader.block("README.md", "export PATH=")
    build, package = (re.search(rf"`({command}[^`]*)`", reader.page["README.md"].text)[1]
                      for command in (".ci/build", "export PYTHONPATH="))
    root.run(build)
    run = root.run
    root.run = lambda commands: run(f"{program}\n{package}\n{commands}")
    reader.first_result()
    reader.python()
    reader.tutorial()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("way", choices=["packages", "clone"])
    parser.add_argument("--source", required=True)
    parser.add_argument("--build")
    parser.add_argument("--keep", action="store_true")
    arguments = parser.parse_args()
    if os.geteuid() != 0 or not shutil.which("debootstrap"):
        print("NOT TRIED: this needs root and Debian's debootstrap")
        return NOT_TRIED
    directory = tempfile.mkdtemp(prefix="floc-root-")
    root = None
    try:
        root = Root(directory)
        reader = Reader(root, arguments.source)
        if arguments.way == "packages":
            try_packages(reader, arguments.build)
        else:
            try_clone(reader)
        print(f"{reader.faults} faults")
        return 1 if reader.faults else 0
    finally:
        if root:
            root.close()
        if arguments.keep:
            print("the root is", directory)
        else:
            subprocess.run(["rm", "-rf", "--one-file-system", directory], check=False)


if __name__ == "__main__":
    sys.exit(main())
