"""What the structure checks share: the files of a source tree, their code, and how findings are told.

A check is a function from the root of a tree to findings, each "file:line: what is wrong"; run as a
program it prints them and exits with 1 if there are any, with 77 if a tool it needs is not installed.
"""

import pathlib
import re
import shutil
import sys

SKIPPED = {"build", ".git", ".cache", "__pycache__"}
CPP = (".cpp", ".hpp")
NOT_INSTALLED = 77

_COMMENT = r"//[^\n]*|/\*.*?\*/"
_LITERAL = (r'R"(?P<tag>[^\s()\\]{0,16})\(.*?\)(?P=tag)"'
            r'|"(?:\\.|[^"\\\n])*"'
            r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'")
_TOKEN = re.compile(f"(?P<comment>{_COMMENT})|(?P<literal>{_LITERAL})", re.DOTALL)


def files(root, suffixes, *folders):
    """Paths relative to root, sorted, of the files with such a suffix (below the folders, if named)."""
    found = []
    for start in folders or (".",):
        for path in (root / start).rglob("*"):
            relative = path.relative_to(root)
            if path.is_file() and path.suffix in suffixes and not SKIPPED & set(relative.parts):
                found.append(relative)
    return sorted(set(found))


def read(root, path):
    return (root / path).read_text(encoding="utf-8")


def lines(text):
    """Pairs (number, line), counted from 1."""
    return list(enumerate(text.split("\n"), start=1))


def without_comments(text):
    """The same lines, comments blanked."""
    return _TOKEN.sub(lambda m: _newlines(m) if m["comment"] else m[0], text)


def code_only(text):
    """The same lines, comments blanked and literals emptied."""
    return _TOKEN.sub(lambda m: _newlines(m) if m["comment"] else '""' + _newlines(m), text)


def comments_only(text):
    """The same lines, everything but comments blanked."""
    kept, end = [], 0
    for match in _TOKEN.finditer(text):
        kept.append("\n" * text.count("\n", end, match.start()))
        kept.append(match[0] if match["comment"] else _newlines(match))
        end = match.end()
    return "".join(kept)


def _newlines(match):
    return "\n" * match[0].count("\n")


def require(tool):
    if not shutil.which(tool):
        print(f"{tool} is not installed")
        sys.exit(NOT_INSTALLED)


def main(*checks):
    """Runs the checks on the tree named on the command line."""
    root = pathlib.Path(sys.argv[1])
    findings = [finding for check in checks for finding in check(root)]
    print("\n".join(findings) or "nothing found")
    sys.exit(1 if findings else 0)
