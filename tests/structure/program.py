"""The README lists the commands that the program has, no more and no fewer.

    program.py ROOT PROGRAM
"""

import re
import subprocess
import sys

import tree

_ROW = re.compile(r"^\| `nda (\w+)")
_COMMAND = re.compile(r"^  (\w+) ")


def listed(root):
    """Command -> line of the README."""
    rows = ((number, _ROW.match(line)) for number, line in tree.lines(tree.read(root, "README.md")))
    return {match[1]: number for number, match in rows if match}


def offered(program):
    """The commands under `Subcommands:` in the program's help."""
    text = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    paragraph = text.partition("Subcommands:\n")[2].split("\n\n")[0]
    return {match[1] for match in map(_COMMAND.match, paragraph.splitlines()) if match}


def commands(root, program):
    in_readme, in_program = listed(root), offered(program)
    return [f"README.md:{in_readme[name]}: the program has no command {name}"
            for name in sorted(in_readme.keys() - in_program)] + \
           [f"README.md:1: does not list the command {name}"
            for name in sorted(in_program - in_readme.keys())]


if __name__ == "__main__":
    tree.main(lambda root: commands(root, sys.argv[2]))
