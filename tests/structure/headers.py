"""Every public header compiles alone, twice in a row.

    headers.py ROOT COMPILER INCLUDE-DIRECTORY...
"""

import concurrent.futures
import os
import subprocess
import sys

import tree


def fault(compiler, directories, header):
    """The compiler's first error, or None."""
    source = f'#include "{header}"\n' * 2
    command = [compiler, "-std=c++20", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-x", "c++", "-"]
    result = subprocess.run(command + [f"-I{directory}" for directory in directories],
                            input=source, capture_output=True, text=True)
    if result.returncode == 0:
        return None
    return next((line for line in result.stderr.splitlines() if "error" in line), result.stderr)


def alone(root, compiler, directories):
    paths = tree.files(root, (".hpp",), "include")
    headers = [str(path.relative_to("include")) for path in paths]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        faults = list(pool.map(lambda header: fault(compiler, directories, header), headers))
    return [f"{path}:1: does not compile alone: {fault}" for path, fault in zip(paths, faults) if fault]


if __name__ == "__main__":
    tree.main(lambda root: alone(root, sys.argv[2], sys.argv[3:]))
