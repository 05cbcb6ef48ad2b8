"""A task in a process of its own: it can be killed when it does not heed its time limit, and what libraries print is caught."""

import ctypes
import os
import pickle
import select
import signal
import sys
import tempfile
import time


class Log:
    """What this process prints, C libraries included, goes into a file from now on."""

    def __init__(self):
        self._file = tempfile.TemporaryFile()
        os.dup2(self._file.fileno(), 1)
        os.dup2(self._file.fileno(), 2)
        self._read = 0

    def take(self):
        """Lines printed since the last call."""
        sys.stdout.flush()
        ctypes.CDLL(None).fflush(None)
        end = os.fstat(self._file.fileno()).st_size
        data = os.pread(self._file.fileno(), end - self._read, self._read)
        self._read = end
        return data.decode(errors="replace").splitlines()


def run(task, limit_s):
    """(task(log), "") from a child; (None, why) where there is no result: "killed" after so many seconds, its last error, "died"."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        os.setpgid(0, 0)
        os.close(reading)
        _work(task, writing)
    os.close(writing)
    data, killed = _collect(reading, time.monotonic() + limit_s)
    os.close(reading)
    if killed:
        _kill(child)
    os.waitpid(child, 0)
    if killed:
        return None, "killed"
    return pickle.loads(data) if data else (None, "died")


def _work(task, writing):
    try:
        result = task(Log()), ""
    except Exception as error:
        result = None, f"{type(error).__name__}: {error}"
    with os.fdopen(writing, "wb") as pipe:
        pipe.write(pickle.dumps(result))
    os._exit(0)


def _collect(reading, deadline):
    """All bytes until the other end closes, and whether the deadline came first."""
    data = b""
    while True:
        ready, _, _ = select.select([reading], [], [], max(0.0, deadline - time.monotonic()))
        if not ready:
            return data, True
        piece = os.read(reading, 1 << 20)
        if not piece:
            return data, False
        data += piece


def _kill(child):
    try:
        os.killpg(child, signal.SIGKILL)
    except ProcessLookupError:
        os.kill(child, signal.SIGKILL)
