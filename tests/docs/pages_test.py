#!/usr/bin/env python3
"""Tests the documentation: links, navigation, generated tables, scene keys, commands.

    pages_test.py --floc PROGRAM --source DIRECTORY
"""
import argparse
import glob
import os
import re
import subprocess
import sys

import pages

# Patterns of the code with which lib/floc/scene reads a key, and with which contact laws declare theirs.
READ = re.compile(r"\.(?:number|integer|text|choice|table|tables|numbers|texts|flat_numbers)\(\s*\"([a-z_]+)\"")
READ_PAIR = re.compile(r"read_sizes\(t, \"([a-z_]+)\", \"([a-z_]+)\"")
SLOT = re.compile(r"visit\(\"([a-z_]+)\", law\.")
DECLARED = re.compile(r"\{\"([a-z_]+)\", (?:&|k[A-Z])")
ACCURACY = re.compile(r"^    \{\"(\w+)\", \{\"", re.MULTILINE)
# Keys that floc itself writes into scenes.
WRITTEN_BY_FLOC = {"chosen", "state_sha256"}


class Test:
    def __init__(self, floc, source):
        self.floc = floc
        self.source = source
        self.docs = pages.Documentation(source)
        self.by_name = {page.name: page for page in self.docs.pages}
        self.faults = 0

    def fault(self, words):
        self.faults += 1
        print("FAULT:", words)

    def readme_is_one_screen(self):
        n = len(self.by_name["README.md"].lines) - 1
        if n > 150:
            self.fault(f"README.md has {n} lines, expected at most 150")

    def links_lead_somewhere(self):
        n = 0
        for page in self.docs.pages:
            for target, line in page.links():
                if re.match(r"[a-z]+:", target):
                    continue
                n += 1
                path, _, anchor = target.partition("#")
                name = os.path.normpath(os.path.join(os.path.dirname(page.name), path)) if path else page.name
                if not os.path.exists(os.path.join(self.source, name)):
                    self.fault(f"{page.name}:{line}: {target} is no file of the repository")
                elif anchor:
                    other = self.by_name.get(name) or pages.Page(self.source, name)
                    if anchor not in other.anchors():
                        self.fault(f"{page.name}:{line}: {name} has no heading #{anchor}")
        if n < 50:
            self.fault(f"only {n} links were found: is the test reading the pages?")

    def nothing_is_taken_for_html(self):
        """Finds <N> outside of backquotes, which Markdown reads as a tag and does not show."""
        for page in self.docs.pages:
            if page.name == "docs/columns.md":
                continue  # docs/build takes care of it
            for line, number in page.prose:
                words = re.sub(r"`[^`]*`", "", line)
                if not line.startswith("    ") and re.search(r"<(?!!--)[A-Za-z/]", words):
                    self.fault(f"{page.name}:{number}: put {words.strip()!r} into backquotes, or write &lt;")

    def versions_agree(self):
        version = re.search(r"project\(floc VERSION ([\d.]+)", self.read("CMakeLists.txt")).group(1)
        if f"\nversion: {version}\n" not in self.read("CITATION.cff"):
            self.fault(f"CITATION.cff does not say version {version}")
        if f"\n## {version}\n" not in self.read("CHANGELOG.md"):
            self.fault(f"CHANGELOG.md has no section {version}")

    def read(self, name):
        return open(os.path.join(self.source, name), encoding="utf-8").read()

    def navigation_has_every_page(self):
        text = self.read("docs/mkdocs.yml")
        listed = set(re.findall(r"([\w/-]+\.md)", text[text.index("\nnav:"):]))
        expected = {"index.md", "changelog.md", "contributing.md"}
        expected |= {name[len("docs/"):] for name in self.by_name if name.startswith("docs/")}
        for name in sorted(expected - listed):
            self.fault(f"docs/mkdocs.yml: {name} is not in the navigation")
        for name in sorted(listed - expected):
            self.fault(f"docs/mkdocs.yml: {name} is no page")

    def tables_are_those_of_the_program(self):
        done = subprocess.run([os.path.join(self.source, "docs/generate"), "--check", "--floc", self.floc],
                              capture_output=True, text=True)
        if done.returncode:
            self.fault(done.stdout + done.stderr)

    def every_command_has_a_page(self):
        said = subprocess.run([self.floc, "--help"], capture_output=True, text=True).stdout
        commands = set(re.findall(r"^  ([a-z]+) ", said[said.index("Subcommands:"):], re.MULTILINE))
        index = self.by_name["docs/commands/index.md"].text
        for command in sorted(commands):
            if f"docs/commands/{command}.md" not in self.by_name:
                self.fault(f"floc {command} has no page docs/commands/{command}.md")
            if f"[floc {command}]({command}.md)" not in index:
                self.fault(f"docs/commands/index.md does not name floc {command}")

    # Checks of scene keys.

    def keys_that_are_read(self):
        """Returns the keys that the sources read, and the numbers of contact laws."""
        keys = set(ACCURACY.findall(self.read("lib/floc/prices/accuracy.cc")))
        keys |= set(SLOT.findall(self.read("lib/floc/contact/law_parameters.h")))
        for name in glob.glob(os.path.join(self.source, "lib/floc/scene/*.cc")):
            text = open(name, encoding="utf-8").read()
            keys |= set(READ.findall(text)) | {key for pair in READ_PAIR.findall(text) for key in pair}
        for name in glob.glob(os.path.join(self.source, "lib/floc/contact/*/*.h")):
            keys |= set(DECLARED.findall(open(name, encoding="utf-8").read()))
        return keys - WRITTEN_BY_FLOC

    def keys_that_are_described(self):
        """Returns every word in backquotes in the tables of scenes.md, with each part of dotted keys."""
        words, paths = set(), []
        for header, rows, _ in self.by_name["docs/scenes.md"].tables:
            for row in [[header]] + rows:
                for cell in row:
                    for quoted in re.findall(r"`([^`]*)`", cell):
                        words |= set(re.findall(r"[a-z_A-Z]+", quoted))
                if header.startswith("| key |"):
                    paths += re.findall(r"`([\w.]+)`", row[0])
        return words, paths

    def every_key_of_scenes_is_described(self):
        read = self.keys_that_are_read()
        described, paths = self.keys_that_are_described()
        if len(read) < 90:
            self.fault(f"only {len(read)} keys were found in lib/floc/scene: is the test reading them?")
        for key in sorted(read - described):
            self.fault(f"docs/scenes.md does not describe the key {key!r}, which scenes read")
        sources = "".join(open(name, encoding="utf-8").read() for name in
                          glob.glob(os.path.join(self.source, "lib/floc/scene/*.cc")) +
                          [os.path.join(self.source, "lib/floc/prices/accuracy.cc")] +
                          glob.glob(os.path.join(self.source, "lib/floc/contact/*.cc")))
        for path in paths:
            if f'"{path.split(".")[-1]}"' not in sources:
                self.fault(f"docs/scenes.md describes {path}, which no scene reads")

    def run(self):
        for check in (self.readme_is_one_screen, self.links_lead_somewhere, self.nothing_is_taken_for_html,
                      self.versions_agree, self.navigation_has_every_page, self.tables_are_those_of_the_program,
                      self.every_command_has_a_page, self.every_key_of_scenes_is_described):
            check()
        print(f"{len(self.docs.pages)} pages, {self.faults} faults")
        return 1 if self.faults else 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--floc", required=True)
    parser.add_argument("--source", required=True)
    arguments = parser.parse_args()
    return Test(os.path.abspath(arguments.floc), os.path.abspath(arguments.source)).run()


if __name__ == "__main__":
    sys.exit(main())
