"""Every source file and folder stands in the CMakeLists.txt beside it: nothing is forgotten in the build."""

import re

import tree

# Built by projects of their own.
SEPARATE = {"tests/install/consumer"}


def words(root, path):
    """The words of a CMakeLists.txt, comments left out; none if there is no such file."""
    if not (root / path).exists():
        return set()
    return set(re.findall(r"[\w./-]+", re.sub(r"#.*", "", tree.read(root, path))))


def sources(root):
    findings = []
    for path in tree.files(root, (".cpp",), "src", "tests", "bench", "examples"):
        if str(path.parent) not in SEPARATE and path.name not in words(root, path.parent / "CMakeLists.txt"):
            findings.append(f"{path}:1: not in {path.parent}/CMakeLists.txt")
    return findings


def folders(root):
    findings = []
    for path in tree.files(root, (".txt",), "src", "tests", "bench", "examples"):
        if path.name != "CMakeLists.txt" or str(path.parent) in SEPARATE:
            continue
        above = path.parent.parent / "CMakeLists.txt"
        if path.parent.name not in words(root, above):
            findings.append(f"{path}:1: folder {path.parent} is not in {above}")
    return findings


if __name__ == "__main__":
    tree.main(sources, folders)
