#!/usr/bin/env python3
"""Tests the man pages and the shell completion that docs/write-help makes from the help of the program.

    help_test.py --floc PROGRAM --source DIRECTORY
"""
import argparse
import glob
import gzip
import os
import re
import shutil
import subprocess
import sys
import tempfile

# Words of a command line, the last one incomplete, and the completions that the shell offers. A set that begins with
# ... is a part of the completions.
COMPLETED = [
    (["floc", "mod"], {"moduli", "modes"}),
    (["floc", "fit", "el"], {"elastic"}),
    (["floc", "moduli", "--str"], {"--strains"}),
    (["floc", "moduli", "--strains", ""], {"diagonal", "full"}),
    (["floc", "moduli", "--prestress", "demo"], set()),  # files: the shell's own completion
    (["floc", ""], {"...", "run", "help", "campaign", "--version"}),
    (["floc", "campaign", "run", "--w"], {"--with-parent"}),
]


def said(*arguments, **options):
    return subprocess.run(arguments, capture_output=True, text=True, **options)


def in_bash(script, words):
    quoted = " ".join(f"'{word}'" for word in words)
    done = said("bash", "-c", f"source '{script}'; COMP_WORDS=({quoted}) COMP_CWORD={len(words) - 1}; _floc; "
                              "printf '%s\\n' \"${COMPREPLY[@]}\"")
    return done.stdout + done.stderr


def in_zsh(script, words):
    """zsh removes completions that do not begin with the incomplete word; this is done here instead."""
    quoted = " ".join(f"'{word}'" for word in words)
    done = said("zsh", "-f", "-c", "compadd() { shift; print -l -- $@ }; _files() { }; "
                                   f"words=({quoted}); CURRENT={len(words)}; source '{script}'")
    return "\n".join(line for line in done.stdout.split("\n") if line.startswith(words[-1])) + done.stderr


def faults_of_completion(directory):
    shells = [("bash", in_bash, "bash-completion/completions/floc")]
    if shutil.which("zsh"):
        shells.append(("zsh", in_zsh, "zsh/site-functions/_floc"))
    else:
        print("NOT TESTED: no zsh is installed")
    for shell, complete, script in shells:
        for words, expected in COMPLETED:
            offered = set(complete(os.path.join(directory, script), words).split())
            if not (expected - {"..."} <= offered if "..." in expected else offered == expected):
                yield f"{shell} completes {words} with {sorted(offered)}, expected {sorted(expected)}"


def faults_of_pages(directory, floc):
    pages = {os.path.basename(name).removesuffix(".gz"): gzip.open(name, "rt", encoding="utf-8").read()
             for name in glob.glob(f"{directory}/man/man1/*.1.gz")}
    commands = re.findall(r"^  ([a-z]+) ", said(floc, "--help").stdout.split("Subcommands:")[1], re.MULTILINE)
    for command in commands:
        text = pages.get(f"floc-{command}.1", "").replace("\\-", "-")
        for option in re.findall(r"^  (-\S+)", said(floc, command, "--help").stdout, re.MULTILINE):
            if option != "-h,--help" and f"\\fB{option}\\fR" not in text:
                yield f"floc-{command}.1 does not name {option}"
        if f"floc-{command}(1)" not in pages["floc.1"].replace("\\-", "-"):
            yield f"floc.1 does not name floc-{command}(1)"
    if not shutil.which("groff"):
        print("NOT TESTED: no groff is installed, so no man page was formatted")
        return
    for name in sorted(pages):
        warnings = said("groff", "-man", "-ww", "-Tascii", input=pages[name]).stderr
        if warnings:
            yield f"groff warns of {name}: {warnings}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--floc", required=True)
    parser.add_argument("--source", required=True)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="floc-help-") as directory:
        subprocess.run([os.path.join(arguments.source, "docs/write-help"), "--floc", arguments.floc, directory],
                       check=True)
        faults = list(faults_of_completion(directory)) + list(faults_of_pages(directory, arguments.floc))
    for fault in faults:
        print("FAULT:", fault)
    print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
