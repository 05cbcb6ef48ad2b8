"""What the scripts of this folder share."""

import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent


def processor():
    """Name of this machine's processor."""
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), "?")


def build(*targets):
    """Builds benchmarks in build/release; returns the folder of their programs."""
    subprocess.run(["cmake", "--preset", "release", "-DNDA_BUILD_BENCHMARKS=ON"], cwd=ROOT, check=True)
    subprocess.run(["cmake", "--build", ROOT / "build/release", "--target", *targets], check=True)
    return ROOT / "build/release/bench"


def write_between(page, begin, end, text):
    """Replaces what stands between two markers of a page."""
    before, rest = page.read_text().split(begin)
    page.write_text(before + begin + text + end + rest.split(end)[1])
