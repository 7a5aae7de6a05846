"""Shared code of the Python module's tests."""

import contextlib
import locale
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

PROGRAM = os.environ["DIBHR_PROGRAM"]


def run_dibhr(folder, *arguments):
    """Runs the program in `folder`, which also has its settings; returns its result."""
    homes = {name: str(folder) for name in ("XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME")}
    environment = os.environ | homes
    return subprocess.run(
        [PROGRAM, *map(str, arguments)], cwd=folder, env=environment, capture_output=True, text=True
    )


def read_rows(file):
    """The rows that the program wrote as CSV, by the names of its columns."""
    return np.genfromtxt(file, delimiter=",", names=True, dtype=None, encoding="utf-8")


def write_pgm(file, levels):
    """A grey picture of 8 or 16 bits, as a file."""
    rows, columns = levels.shape
    highest = np.iinfo(levels.dtype).max
    head = f"P5\n{columns} {rows}\n{highest}\n".encode()
    file.write_bytes(head + levels.astype(levels.dtype.newbyteorder(">")).tobytes())


def hills(rows=120, columns=160, dtype=np.uint8):
    """Round hills and a step, over all levels."""
    y, x = np.mgrid[0:rows, 0:columns]
    height = 0.5 + 0.25 * np.sin(x / 9.0) * np.cos(y / 11.0) + 0.2 * (x > columns / 2)
    return np.round(height * np.iinfo(dtype).max).astype(dtype)


def circle(count=20000, centre=(242.0, 242.0), z=108.0, radius=200.0, step=4.961 / 200.0):
    """The paper's circle: 4961 px/s at 1 kHz."""
    angle = np.arange(count) * step
    x = centre[0] + radius * np.cos(angle)
    y = centre[1] + radius * np.sin(angle)
    return np.column_stack([x, y, np.full(count, z)])


@contextlib.contextmanager
def decimal_commas():
    """Sets the German number format for this process, as a program of Qt or GTK does."""
    with tempfile.TemporaryDirectory() as folder:
        words = ["localedef", "-i", "de_DE", "-f", "UTF-8", f"{folder}/de_DE.UTF-8"]
        subprocess.run(words, check=True)
        os.environ["LOCPATH"] = folder
        try:
            locale.setlocale(locale.LC_ALL, "de_DE.UTF-8")
            assert locale.localeconv()["decimal_point"] == ","
            yield
        finally:
            locale.setlocale(locale.LC_ALL, "C")
            del os.environ["LOCPATH"]


class FolderTest(unittest.TestCase):
    """A test with an empty folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
