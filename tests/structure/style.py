"""Lengths, forbidden words and calls, code that was commented out (CONTRIBUTING.md)."""

import json
import re
import statistics
import subprocess

import tree

LONGEST_FUNCTION = 100
LONGEST_FILE = 500
LARGEST_MEDIAN = 12
MEASURED = ("src", "include", "tests", "bench", "examples", "fuzz")

# Files that are tables, not code.
TABLES = set()

# Spelled in halves, or this file would find itself.
_UNFINISHED = re.compile(r"\b(" + "|".join(("TO" "DO", "FIX" "ME", "XX" "X")) + r")\b")
_TEXT = tree.CPP + (".py", ".sh", ".cmake", ".md", ".txt", ".in")

# The library returns and throws; only the program prints, ends or looks at its surroundings.
_CALL = re.compile(r"\bstd::(cout|cerr|clog)\b"
                   r"|(?<![\w.>])(?:std::)?(?:v?f?printf|f?puts|putchar|abort|terminate|_?exit|quick_exit"
                   r"|getenv|setenv|system)\s*\("
                   r"|\bfmt::print\b")

_DEAD_CODE = re.compile(
    r"^//(?!/)\s*(return\b.*;"
    r"|(if|for|while|switch) \(.*[{;]"
    r"|#\s*(include|if|endif|define)\b.*"
    r"|[{}]"
    r"|[\w:.>*&<, -]*\w\(.*\);"
    r"|[\w:.>*&<,\[\] -]+ [-+*/]?= .*;)$")


def functions(root):
    """Triples (path, first line, number of lines) of every function body."""
    paths = [str(path) for path in tree.files(root, tree.CPP, *MEASURED)]
    if not paths:
        return []
    output = subprocess.run(
        ["ctags", "--language-force=C++", "--kinds-C++=f", "--fields=+ne", "--output-format=json",
         "-f", "-", "-L", "-"],
        cwd=root, input="\n".join(paths), capture_output=True, text=True, check=True).stdout
    tags = [json.loads(line) for line in output.splitlines()]
    return [(tag["path"], tag["line"], tag["end"] - tag["line"] + 1) for tag in tags if "end" in tag]


def function_lengths(root):
    tree.require("ctags")
    measured = functions(root)
    findings = [f"{path}:{line}: a function of {length} lines (at most {LONGEST_FUNCTION})"
                for path, line, length in measured if length > LONGEST_FUNCTION]
    sources = [length for path, _, length in measured if path.startswith("src/")]
    median = statistics.median(sources) if sources else 0
    if median > LARGEST_MEDIAN:
        findings.append(f"src:0: the median function has {median:g} lines (at most {LARGEST_MEDIAN})")
    return findings


def file_lengths(root):
    findings = []
    for path in tree.files(root, tree.CPP + (".py", ".sh")):
        length = tree.read(root, path).count("\n")
        if length > LONGEST_FILE and str(path) not in TABLES:
            findings.append(f"{path}:{length}: a file of {length} lines (at most {LONGEST_FILE})")
    return findings


def unfinished(root):
    return [f"{path}:{number}: unfinished: {line.strip()}"
            for path in tree.files(root, _TEXT)
            for number, line in tree.lines(tree.read(root, path)) if _UNFINISHED.search(line)]


def forbidden_calls(root):
    findings = []
    for path in tree.files(root, tree.CPP, "src", "include"):
        if path.parts[:2] == ("src", "cli"):
            continue
        for number, line in tree.lines(tree.code_only(tree.read(root, path))):
            if _CALL.search(line):
                findings.append(f"{path}:{number}: the library must not: {line.strip()}")
    return findings


def dead_code(root):
    findings = []
    for path in tree.files(root, tree.CPP):
        for number, line in tree.lines(tree.comments_only(tree.read(root, path))):
            if _DEAD_CODE.match(line.strip()):
                findings.append(f"{path}:{number}: code that was commented out: {line.strip()}")
    return findings


if __name__ == "__main__":
    tree.main(function_lengths, file_lengths, unfinished, forbidden_calls, dead_code)
