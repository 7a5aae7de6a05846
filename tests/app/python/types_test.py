"""The package's type hints match the module, and its example runs."""

import ast
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import dibhr
from helpers import FolderTest

PACKAGE = pathlib.Path(dibhr.__file__).parent
EXAMPLE = pathlib.Path(__file__).parents[3] / "app/python/examples/force_profile.py"


def is_public(name):
    return not name.startswith("_")


def stub_names(body):
    """The public names that these statements of the stub declare."""
    names = set()
    for node in body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            names.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            names.add(node.target.id)
    return set(filter(is_public, names))


def argument_count(function):
    """The number in the first line of a compiled function's docstring."""
    return len(re.findall(r"[(\s](\w+): ", function.__doc__.splitlines()[0]))


class Types(FolderTest):
    def setUp(self):
        super().setUp()
        self.stub = ast.parse((PACKAGE / "_dibhr.pyi").read_text())

    def test_of_the_compiled_part_are_what_it_has(self):
        compiled = dibhr._dibhr
        self.assertEqual(stub_names(self.stub.body), set(filter(is_public, dir(compiled))))
        for node in self.stub.body:
            if not isinstance(node, ast.ClassDef):
                continue
            known = getattr(compiled, node.name)
            self.assertEqual(stub_names(node.body), set(filter(is_public, vars(known))))
            for function in node.body:
                with self.subTest(f"{node.name}.{function.name}"):
                    count = argument_count(getattr(known, function.name))
                    self.assertEqual(len(function.args.args), count)

    def test_come_with_the_package(self):
        self.assertTrue((PACKAGE / "py.typed").exists())

    def test_and_meanings_stand_with_every_public_name(self):
        values = {"ALGORITHMS", "PARAMETERS", "TICK_ROW", "TOUCH_ROW"}
        for name in set(dibhr.__all__) - values:
            with self.subTest(name):
                known = getattr(dibhr, name)
                self.assertTrue(known.__doc__)
                self.assertEqual(known.__module__, "dibhr")
                for member, value in vars(known).items():
                    if is_public(member) and (callable(value) or isinstance(value, property)):
                        self.assertTrue(value.__doc__, member)

    @unittest.skipUnless(shutil.which("mypy"), "mypy is not installed")
    def test_satisfy_mypy(self):
        (self.folder / "use.py").write_text(
            "import numpy as np\n"
            "import dibhr\n"
            "renderer = dibhr.Renderer(dibhr.Surface(np.zeros((4, 6))), stiffness=0.8)\n"
            "x: float = renderer.update((1.0, 2.0, 3.0)).sent_force[0]\n"
            "rows = renderer.run(np.zeros((3, 3)), dt=0.002)\n"
            "newton: float = float(dibhr.vectors(rows, 'f')[0, 2])\n"
            "begin: float = dibhr.Session('a.dibhr').begin\n"
        )
        result = subprocess.run(
            ["mypy", "--strict", "--follow-imports=silent", "--cache-dir=cache", "use.py"],
            cwd=self.folder,
            env=dict(os.environ, MYPYPATH=str(PACKAGE.parent)),
            capture_output=True,
            text=True,
        )
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)


class SourceTree(FolderTest):
    def test_without_the_compiled_part_says_how_to_build_it(self):
        shutil.copytree(PACKAGE, self.folder / "dibhr", ignore=shutil.ignore_patterns("*.so"))
        result = subprocess.run(
            [sys.executable, "-B", "-c", "import dibhr"],
            cwd=self.folder,
            env=dict(os.environ, PYTHONPATH=str(self.folder)),
            capture_output=True,
            text=True,
        )
        self.assertEqual(result.returncode, 1)
        said = result.stderr.splitlines()[-1]
        self.assertTrue(said.startswith("ImportError: the compiled part of dibhr is not beside "))
        self.assertIn("app/prepare release dibhr_python", said)
        self.assertNotIn("circular", result.stderr)


class Example(FolderTest):
    @unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
    def test_draws_a_picture(self):
        self.assertLessEqual(len(EXAMPLE.read_text().splitlines()), 40)
        subprocess.run(
            [sys.executable, EXAMPLE, "profile.png"],
            cwd=self.folder,
            env=dict(os.environ, MPLBACKEND="agg", MPLCONFIGDIR=str(self.folder)),
            check=True,
        )
        self.assertGreater((self.folder / "profile.png").stat().st_size, 10_000)


if __name__ == "__main__":
    unittest.main()
