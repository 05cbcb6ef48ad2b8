"""Who may include what (docs/architecture.md): folders only downwards, each library behind its adapter."""

import re

import tree

# A folder of src/ may include its own headers and those of a lower level.
LEVEL = {
    "core": 0,
    "io": 1, "assign2d": 1, "dual": 1, "decompose": 1, "bnb": 1, "lp": 1, "generate": 1, "reduce": 1,
    "relax": 2, "cutting": 2, "baselines": 2,
    "recovery": 3, "bounded": 3, "rows": 3,
    "solve": 4,
    "kbest": 5, "msap": 5, "mio": 5, "mip": 5,
    "track": 6,
    "cli": 7,
}

# Folders that may include less than their level allows.
ONLY = {
    "baselines": {"core"},  # they judge the rest, so they share nothing with it
}

# Header of a library -> the folders that may include it.
LIBRARY = {
    "boost/": {"decompose"},
    "lemon/": {"assign2d"},
    "coin/": {"lp"},
    "nlopt": {"dual"},
    "Eigen/": {"dual"},
    "tbb/": {"solve"},
    "oneapi/": {"solve"},
    "nlohmann/": {"io"},
    "zlib.h": {"io"},
    "CLI/": {"cli"},
}

# Headers of the operating system -> the folders that deal with it.
SYSTEM = re.compile(r"sys/\w+\.h|(fcntl|pthread|signal|spawn|stdlib|unistd)\.h")
SYSTEM_FOLDERS = {"io", "solve", "mip", "cli"}

# Libraries that only one file of that folder may include.
ONE_ADAPTER = {"lemon/", "nlopt", "coin/", "tbb/"}

_INCLUDE = re.compile(r'^\s*#\s*include\s*(<[^>]+>|"[^"]+")')


def includes(root, path):
    """Triples (line number, header, whether in angle brackets)."""
    found = []
    for number, line in tree.lines(tree.without_comments(tree.read(root, path))):
        match = _INCLUDE.match(line)
        if match:
            found.append((number, match[1][1:-1], match[1][0] == "<"))
    return found


def is_standard(header):
    return "/" not in header and "." not in header


def library_of(header):
    return next((prefix for prefix in LIBRARY if header.startswith(prefix)), None)


def project_fault(folder, header):
    """What is wrong with including a header of the project from a folder of src/, or None."""
    other = header.split("/")[0]
    if other in ("nda", folder):
        return None
    if other not in LEVEL:
        return f'"{header}" is not named by its folder'
    if folder in ONLY:
        return None if other in ONLY[folder] else f"{folder} may include only {sorted(ONLY[folder])}"
    if LEVEL[other] < LEVEL[folder]:
        return None
    return f'"{header}": {folder} (level {LEVEL[folder]}) must not include {other} (level {LEVEL[other]})'


def library_fault(folder, header):
    if is_standard(header):
        return None
    allowed = SYSTEM_FOLDERS if SYSTEM.fullmatch(header) else LIBRARY.get(library_of(header))
    if allowed is None:
        return f"<{header}> belongs to no library listed in tests/structure/layers.py"
    return None if folder in allowed else f"<{header}> is for {sorted(allowed)} only"


def source_layers(root):
    findings = []
    for path in tree.files(root, tree.CPP, "src"):
        folder = path.parts[1]
        if folder not in LEVEL:
            findings.append(f"{path}:1: folder {folder} has no level in tests/structure/layers.py")
            continue
        for number, header, angled in includes(root, path):
            fault = (library_fault if angled else project_fault)(folder, header)
            if fault:
                findings.append(f"{path}:{number}: {fault}")
    return findings


def public_headers(root):
    """The public face, and the examples that use it, know the standard library and nda/ alone."""
    findings = []
    for path in tree.files(root, tree.CPP, "include", "examples"):
        for number, header, angled in includes(root, path):
            if not (is_standard(header) if angled else header.startswith("nda/")):
                findings.append(f"{path}:{number}: {header} is neither standard nor public")
    return findings


def single_adapters(root):
    users = {library: {} for library in ONE_ADAPTER}
    for path in tree.files(root, tree.CPP, "src"):
        for number, header, angled in includes(root, path):
            library = library_of(header) if angled else None
            if library in ONE_ADAPTER:
                users[library].setdefault(path, number)
    return [f"{path}:{number}: second adapter of {library}; the first is {sorted(where)[0]}"
            for library, where in users.items() for path, number in sorted(where.items())[1:]]


def complete_umbrella(root):
    """nda/nda.hpp includes every public header (the version header is made by the build)."""
    umbrella = root / "include/nda/nda.hpp"
    if not umbrella.exists():
        return []
    named = {header for _, header, _ in includes(root, "include/nda/nda.hpp")}
    present = {f"nda/{path.name}" for path in tree.files(root, tree.CPP, "include/nda")}
    return [f"include/nda/nda.hpp:1: does not include {header}"
            for header in sorted(present - named - {"nda/nda.hpp"})]


if __name__ == "__main__":
    tree.main(source_layers, public_headers, single_adapters, complete_umbrella)
