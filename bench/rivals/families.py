"""The problems: all public files, and generated ones of every family of `nda generate`."""

import dataclasses
import pathlib
import re
import subprocess

from rivals.problem import read_text

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
ARCS = ROOT.parent / "shared/data/arcs"
FOLDERS = ("real", "simulated", "balas_saltzman_3ap", "setpacking", "lap_orlib", "kim2010_4x4x4")
MANY_ARCS = 5000
GIANT_ARCS = 200_000

# name -> arguments of `nda generate`; other seeds than those of ../shared/data/arcs/simulated.
GENERATED = {
    "poore-5.1-a300": "poore-5.1 --arcs 300 --seed 2",
    "poore-5.1-m8": "poore-5.1 --arcs 1000 --min-size 8 --max-size 8 --seed 2",
    "poore-5.1-m12": "poore-5.1 --arcs 5000 --min-size 12 --max-size 12 --seed 2",
    "poore-5.1-a5000": "poore-5.1 --arcs 5000 --seed 2",
    "poore-5.3-s2": "poore-5.3 --seed 2",
    "poore-5.3-s3": "poore-5.3 --seed 3",
    "poore-5.3-mvar": "poore-5.3 --min-size 5 --max-size 9 --seed 2",
    "tracking-small-s2": "tracking --preset small --seed 2",
    "tracking-medium-s2": "tracking --preset medium --seed 2",
    "tracking-medium-s3": "tracking --preset medium --seed 3",
    "tracking-largesparse-s2": "tracking --preset largesparse --seed 2",
    "groups-hard6-s2": "groups --preset hard6 --seed 2",
    "groups-hard6-s3": "groups --preset hard6 --seed 3",
    "groups-hard7-s2": "groups --preset hard7 --seed 2",
    "groups-hard7-s3": "groups --preset hard7 --seed 3",
    "groups-hard8-s2": "groups --preset hard8 --seed 2",
    "groups-hard8-s3": "groups --preset hard8 --seed 3",
    "groups-largegroup-s1": "groups --preset largegroup --seed 1",
    "six-scan-s1": "six-scan --seed 1",
    "six-scan-s2": "six-scan --seed 2",
    "map3-n10": "map3 --size 10 --seed 2",
    "map3-n20": "map3 --size 20 --seed 2",
    "map3-n30": "map3 --size 30 --max-cost 1000 --seed 2",
    "planted-m200": "planted --size 200 --arcs 3000 --seed 2",
    "planted-m400": "planted --size 400 --arcs 8000 --seed 2",
    "planted-free": "planted --seed 2",
    "planted-priced": "planted --singletons priced --seed 2",
    "planted-forbidden": "planted --singletons forbidden --miss-rate 0 --seed 2",
    "planted-a100000": "planted --size 5000 --arcs 100000 --seed 2",
    "planted-a1000000": "planted --size 20000 --arcs 1000000 --seed 2",
    "gadgets-100": "gadgets --gadgets 100 --seed 2",
    "gadgets-1000": "gadgets --gadgets 1000 --seed 2",
    "gadgets-3000": "gadgets --gadgets 3000 --seed 2",
}

# A few seconds each at most, and of every kind: integral, with gaps, forbidden singletons, many components.
QUICK = {
    "tracking-small-s2": GENERATED["tracking-small-s2"],
    "poore-5.3-m5": "poore-5.3 --min-size 5 --max-size 5 --seed 2",
    "map3-n8": "map3 --size 8 --seed 2",
    "planted-s100": "planted --size 100 --arcs 1000 --singletons forbidden --miss-rate 0 --seed 2",
    "gadgets-30": "gadgets --gadgets 30 --seed 2",
    "groups-two": "groups --preset hard6 --targets 12 --seed 2",
}


@dataclasses.dataclass
class Instance:
    """A file; best_known is the least cost that is listed for it, None where nothing is."""

    name: str
    family: str
    path: pathlib.Path
    best_known: float
    arcs: int  # lines in the file


def header_arcs(text):
    return int(re.search(rb"^p .*\s(\d+)\s*$", text, re.MULTILINE)[1])


def _stated_optimum(text):
    """What a generated file says of its optimum."""
    found = re.search(rb"^c optimum (\S+)", text[:2000], re.MULTILINE)
    return float(found[1]) if found else None


def _generate(nda, folder, name, arguments):
    path = folder / f"{name}.nda"
    subprocess.run([nda, "generate", *arguments.split(), "-o", path], check=True, stderr=subprocess.DEVNULL)
    text = path.read_bytes()
    return Instance(name, arguments.split()[0], path, _stated_optimum(text), header_arcs(text))


def _public(references, path):
    best = references.get(path.name, (None, None))[0]
    return Instance(path.name.split(".nda")[0], path.parent.name, path, best, header_arcs(read_text(path)))


def instances(nda, folder, quick, patterns, references):
    """All problems whose name or family has one of the patterns in it, the most telling first: those of many arcs, then few, then giants."""

    def wanted(*names):
        return not patterns or any(pattern in name for pattern in patterns for name in names)

    generated = QUICK if quick else GENERATED
    found = [_generate(nda, folder, *item) for item in generated.items() if wanted(item[0], item[1].split()[0])]
    if not quick:
        paths = [path for name in FOLDERS for path in sorted((ARCS / name).glob("*.nda*"))]
        found += [_public(references, path) for path in paths if wanted(path.name, path.parent.name)]

    def rank(instance):
        return instance.arcs > GIANT_ARCS, instance.arcs < MANY_ARCS, instance.arcs

    return sorted(found, key=rank)
