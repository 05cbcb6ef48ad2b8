"""docs/options.md says what `nda options` says, and the table of options has every field of Options.

    options.py ROOT PROGRAM            compares
    options.py ROOT PROGRAM --write    writes the page
"""

import pathlib
import re
import subprocess
import sys

import tree

PAGE = "docs/options.md"
HEADER = "include/nda/options.hpp"
PRESETS = ("default", "realtime", "exact")

_STRUCT = re.compile(r"^struct (\w*)Options {$(.*?)^};$", re.MULTILINE | re.DOTALL)
_FIELD = re.compile(r"^  [\w:]+ (\w+) =", re.MULTILINE)

_TOP = """# Options

What a solve can be told. In the library these are the fields of `nda::Options`, on the command line
`nda solve --set NAME=VALUE`; `--time-limit`, `--gap`, `--threads`, `--seed` and `--method` are short for
`time_limit_s`, `relative_gap`, `num_threads`, `seed`, and `method` or `relaxation.dual_method`. A preset comes
first, then these flags, then `--set`.

The program prints this table with `nda options`; a preset has the default where its column is empty.

| option | default | `realtime` | `exact` | meaning | must be |
|---|---|---|---|---|---|
"""
_BOTTOM = """
[Which method when](methods.md) tells which of them are worth changing.

<!-- python3 tests/structure/options.py . build/release/nda --write -->
"""


def offered(program, preset):
    """Triples (value, meaning, rule) by name, as the program lists them."""
    text = subprocess.run([program, "options", "--preset", preset], capture_output=True, text=True,
                          check=True).stdout.splitlines()
    options = {}
    for first, second in zip(text[::2], text[1::2]):
        name, _, value = first.partition("=")
        meaning, _, rule = second.strip().rpartition(": ")
        options[name] = (value, meaning, rule)
    return options


def page(program):
    presets = [offered(program, preset) for preset in PRESETS]
    rows = ""
    for name, (value, meaning, rule) in presets[0].items():
        others = [preset[name][0] for preset in presets[1:]]
        cells = [f"`{name}`", value, *("" if other == value else other for other in others),
                 meaning.replace("|", "\\|"), rule]
        rows += "| " + " | ".join(cells) + " |\n"
    return _TOP + rows + _BOTTOM


def matches(root, program):
    written = tree.read(root, PAGE) if (root / PAGE).exists() else ""
    for number, (line, expected) in enumerate(zip(written.split("\n"), page(program).split("\n")), start=1):
        if line != expected:
            return [f"{PAGE}:{number}: the program says: {expected}"]
    return [] if written == page(program) else [f"{PAGE}:1: is not complete"]


def complete(root, program):
    """A field with a default is an option, those of nested structs behind the name of their group."""
    fields = [f"{match[1].lower()}.{field}".lstrip(".") for match in _STRUCT.finditer(tree.read(root, HEADER))
              for field in _FIELD.findall(match[2])]
    listed = offered(program, PRESETS[0])
    return [f"{HEADER}:1: the program does not list {field}" for field in fields if field not in listed]


if __name__ == "__main__":
    PROGRAM = sys.argv[2]
    if sys.argv[3:] == ["--write"]:
        (pathlib.Path(sys.argv[1]) / PAGE).write_text(page(PROGRAM), encoding="utf-8")
    tree.main(lambda root: matches(root, PROGRAM), lambda root: complete(root, PROGRAM))
