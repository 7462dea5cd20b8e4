"""What the program says of itself: the columns of its tables, and the commands with their options, read from its help."""
import json
import re
import subprocess


class Option:
    """An option, a flag or an argument of a command."""

    LINE = re.compile(r"(.+?) (TEXT|FLOAT|U?INT)(:\S+(?: in)?)?(?:(?<= in) (\[[^\]]*\]))?(?:=(\S+))?(.*)")

    def __init__(self, left, meaning):
        """@param left  "--jobs INT:INT in [1 - 1024] Needs: --seeds" """
        self.meaning = meaning
        left, _, excluded = left.partition(" Excludes: ")
        self.excluded = excluded.split()
        left, _, needed = left.partition(" Needs: ")
        self.needed = needed.split()
        self.required = "REQUIRED" in left
        self.repeated = " ..." in left
        found = self.LINE.match(left)
        self.keywords, self.takes, self.default = [], "", None
        if not found:
            self.names = left.removesuffix(" REQUIRED")
            return
        self.names, kind, rule, limits, self.default, _ = found.groups()
        if self.default is None and rule and "=" in rule:
            rule, _, self.default = rule.partition("=")
        self.takes = {"TEXT": "text", "FLOAT": "number"}.get(kind, "whole number")
        if rule and rule.startswith(":{"):
            self.keywords = rule[2:-1].split(",")
            self.takes = ", ".join(self.keywords)
        elif rule == ":POSITIVE":
            self.takes = "positive " + self.takes
        elif rule == ":NONNEGATIVE":
            self.takes += " >= 0"
        if limits:
            self.takes += f" in {limits}"
        if self.repeated:
            self.takes += " ..."

    @property
    def is_argument(self):
        return not self.names.startswith("-")


class Command:
    def __init__(self, text):
        """@param text  what --help prints of it"""
        lines = text.split("\n")
        self.description = lines[0]
        self.options = []
        self.subcommands = []
        section, self.notes = "", []
        for line, following in zip(lines[1:], lines[2:] + [""]):
            if re.fullmatch(r"[A-Z][a-z]+:", line):
                section = line[:-1]
            elif re.match(r"  \S", line) and section:
                # What fits the first thirty letters has its meaning beside it, other names have it below.
                below = re.match(r" {30}\S", following)
                name, meaning = (line[2:], following.strip()) if below else (line[2:30].rstrip(), line[30:])
                if section == "Subcommands":
                    self.subcommands.append(name)
                elif name != "-h,--help":
                    self.options.append(Option(name, meaning))
            elif section and line and not line.startswith(" "):
                self.notes.append(line)


class Program:
    def __init__(self, floc):
        self.floc = floc
        self.version = self.said("--version").split()[1]
        self.tables = {}
        for row in json.loads(self.said("help", "columns", "--format", "json")):
            self.tables.setdefault(row["table"], []).append(row)
        self.commands = {}  # "fit elastic" -> Command; the program itself is ""
        self.read([])

    def said(self, *arguments):
        return subprocess.run([self.floc, *arguments], capture_output=True, text=True, check=True).stdout

    def read(self, words):
        command = Command(self.said(*words, "--help"))
        self.commands[" ".join(words)] = command
        for name in command.subcommands:
            self.read(words + [name])
