"""Which arrays and parameters are accepted, and the errors for the others."""

import unittest

import numpy as np

import dibhr
from helpers import FolderTest, circle, hills, run_dibhr, write_pgm


def refused(test, error, words, make):
    with test.assertRaises(error) as raised:
        make()
    test.assertEqual(str(raised.exception), words)


class Arrays(unittest.TestCase):
    def proxies(self, surface):
        rows = dibhr.Renderer(surface).run(circle(500, (80, 60), 90.0, 55.0, 0.02))
        return dibhr.vectors(rows, "p")

    def test_of_any_order_and_type_make_the_same_surface(self):
        levels = hills()
        expected = self.proxies(dibhr.Surface(levels))
        larger = np.repeat(np.repeat(levels, 2, axis=0), 2, axis=1)
        for same in (
            np.asfortranarray(levels),
            larger[::2, ::2],
            levels[::-1][::-1],
            levels.astype(np.uint16),
            levels.astype(">u2"),
            levels.astype(np.float32),
            levels.astype(np.float64),
            levels.astype(">f8"),
        ):
            surface = dibhr.Surface(same, highest_level=255)
            np.testing.assert_array_equal(self.proxies(surface), expected)

    def test_are_copied(self):
        levels = hills()
        surface = dibhr.Surface(levels)
        expected = self.proxies(surface)
        levels[:] = 0
        np.testing.assert_array_equal(self.proxies(surface), expected)

    def test_say_themselves_what_depth_1_is(self):
        for dtype, highest in ((np.uint8, 255), (np.uint16, 65535), (np.float32, 1), (float, 1)):
            surface = dibhr.Surface(np.zeros((4, 6), dtype))
            self.assertEqual((surface.shape, surface.highest_level), ((4, 6), highest))
        self.assertEqual(dibhr.Surface(np.zeros((4, 6)), highest_level=0.1).shape, (4, 6))
        dibhr.Surface(np.full((4, 6), 0.1), highest_level=0.1)

    def test_that_are_no_depth_image_are_refused(self):
        flat = np.zeros((4, 6), np.uint8)
        holed = np.zeros((4, 6))
        holed[2, 5] = np.nan
        for words, make in (
            ("depth: its shape is (4, 6, 3); (rows, columns) of at least (2, 2) is needed",
             lambda: dibhr.Surface(np.zeros((4, 6, 3), np.uint8))),
            ("depth: its shape is (1, 6); (rows, columns) of at least (2, 2) is needed",
             lambda: dibhr.Surface(flat[:1])),
            ("depth: uint8, uint16, float32 or float64 is needed, not int64",
             lambda: dibhr.Surface([[1, 2], [3, 4]])),
            ("depth: uint8, uint16, float32 or float64 is needed, not bool",
             lambda: dibhr.Surface(flat > 0)),
            ("depth: uint8, uint16, float32 or float64 is needed, not complex128",
             lambda: dibhr.Surface(flat.astype(complex))),
            ("depth[2, 5]: nan is not in 0 to 1", lambda: dibhr.Surface(holed)),
            ("depth[0, 0]: 300 is not in 0 to 255",
             lambda: dibhr.Surface(np.full((4, 6), 300.0), highest_level=255)),
            ("depth[0, 0]: -1 is not in 0 to 1", lambda: dibhr.Surface(np.full((4, 6), -1.0))),
            ("highest_level: 0 is not a level above 0",
             lambda: dibhr.Surface(flat, highest_level=0)),
            ("to: its shape is (4, 5), that of depth is (4, 6)",
             lambda: dibhr.Surface(flat, flat[:, :5])),
            ("to: is uint16, depth is uint8; give highest_level, which both share",
             lambda: dibhr.Surface(flat, flat.astype(np.uint16))),
            ("blend: 1.5 is not in 0 to 1", lambda: dibhr.Surface(flat, blend=1.5)),
            ("blend: 'nan' is not a number", lambda: dibhr.Surface(flat).blended(np.nan)),
            ("depth: some of its values are masked; fill them",
             lambda: dibhr.Surface(np.ma.masked_equal(flat, 0))),
            ("bump: its shape is (6,); (rows, columns) of at least (1, 1) is needed",
             lambda: dibhr.Surface(flat, bump=flat[0])),
        ):  # fmt: skip
            with self.subTest(words):
                refused(self, dibhr.InputError, words, make)

    def test_of_goals_are_n_by_3_finite_numbers(self):
        renderer = dibhr.Renderer(dibhr.Surface(hills()))
        goals = circle(5, (80, 60), 90.0, 55.0, 0.02)
        self.assertEqual(len(renderer.run(np.empty((0, 3)))), 0)
        for same in (goals.tolist(), np.asfortranarray(goals), goals.astype(np.float32)):
            self.assertEqual(len(renderer.run(same)), 5)
        wrong = goals.copy()
        wrong[1, 2] = np.inf
        for words, make in (
            ("goals: its shape is (5, 2); (N, 3) is needed", lambda: renderer.run(goals[:, :2])),
            ("goals: its shape is (3,); (N, 3) is needed", lambda: renderer.run([1, 2, 3])),
            ("goals[1, 2]: inf is not a finite number", lambda: renderer.run(wrong)),
            ("goals: real numbers are needed", lambda: renderer.run([["a", "b", "c"]])),
            ("goals: real numbers are needed", lambda: renderer.run([[1, 2, 3], [4]])),
            ("goals: real numbers are needed", lambda: renderer.run(goals + 1j)),
            ("goal: its shape is (2,); (3,) is needed", lambda: renderer.update((1, 2))),
            ("goal[0]: nan is not a finite number", lambda: renderer.update((np.nan, 2, 3))),
            ("dt: 0 is not a time above 0", lambda: renderer.update((1, 2, 3), dt=0)),
            ("t: its shape is (4,); (5,) is needed", lambda: renderer.run(goals, np.arange(4.0))),
            ("t: time falls; sort the goals by time", lambda: renderer.run(goals, [9, 9, 8, 8, 8])),
            ("t: begins before the last update; reset() to begin again",
             lambda: renderer.run(goals, [0, 0, 0, 0, 0])),
            ("blend: 2.0 is not in 0 to 1", lambda: renderer.run(goals, blend=[0, 0, 0, 0, 2])),
        ):  # fmt: skip
            with self.subTest(words):
                refused(self, dibhr.InputError, words, make)


class Parameters(FolderTest):
    def setUp(self):
        super().setUp()
        self.surface = dibhr.Surface(hills())

    def test_of_the_table_are_keywords(self):
        for parameter in dibhr.PARAMETERS:
            with self.subTest(parameter.name):
                renderer = dibhr.Renderer(self.surface)
                self.assertTrue(parameter.help and parameter.label)
                self.assertEqual(renderer.parameters[parameter.name], parameter.default)
                self.assertLessEqual(parameter.lowest, parameter.default)
                renderer.set(friction=5.0)
                renderer.set(**{parameter.name: parameter.highest})
                self.assertEqual(renderer.parameters[parameter.name], parameter.highest)
        self.assertIn("N/mm", [parameter.unit for parameter in dibhr.PARAMETERS])
        renderer = dibhr.Renderer(self.surface)
        renderer.set(friction=0.25, algorithm="pga", max_force=2)
        chosen = renderer.parameters
        self.assertEqual((chosen["algorithm"], chosen["max_force"]), ("pga", 2.0))
        self.assertEqual((chosen["static_friction"], chosen["dynamic_friction"]), (0.25, 0.25))
        self.assertEqual(dibhr.Renderer(self.surface, **chosen).parameters, chosen)

    def test_one_friction_by_itself_wins(self):
        chosen = dibhr.Renderer(self.surface, friction=0.5, dynamic_friction=0.2).parameters
        self.assertEqual((chosen["static_friction"], chosen["dynamic_friction"]), (0.5, 0.2))
        chosen = dibhr.Renderer(self.surface, static_friction=0.1).parameters
        self.assertEqual((chosen["static_friction"], chosen["dynamic_friction"]), (0.1, 0.1))

    def test_are_refused_in_the_words_of_the_command_line(self):
        write_pgm(self.folder / "depth.pgm", hills())
        (self.folder / "goals.csv").write_text("t,x,y,z\n0,1,1,1\n")
        for keyword, value in (
            ("stiffness", 20),
            ("static_friction", -0.5),
            ("friction", 7),
            ("damping_cutoff", "fast"),
            ("pixel_pitch", "nan"),
            ("algorithm", "voxels"),
        ):
            with self.subTest(keyword):
                option = "--" + keyword.replace("_", "-")
                told = run_dibhr(
                    self.folder, "touch", "--depth", "depth.pgm", "--goals", "goals.csv",
                    f"{option}={value}",
                )  # fmt: skip
                self.assertEqual(told.returncode, 2)
                words = told.stderr.removeprefix("dibhr: ").split(" (see ")[0]
                refused(
                    self, dibhr.InputError, words.replace(option, keyword).strip(),
                    lambda: dibhr.Renderer(self.surface, **{keyword: value}),
                )  # fmt: skip

    def test_that_do_not_fit_or_do_not_exist_are_refused_and_change_nothing(self):
        renderer = dibhr.Renderer(self.surface)
        before = renderer.parameters
        for words, keywords in (
            ("dynamic_friction 0.5 is above the static friction 0.4: "
             "give static_friction of at least as much, or friction for both",
             {"stiffness": 1, "dynamic_friction": 0.5}),
            ("stifness: no such parameter; there are algorithm, "
             + ", ".join(parameter.name for parameter in dibhr.PARAMETERS)
             + ", friction, max_force",
             {"stifness": 1}),
            ("max_force: -1 is not in 0 to 1000", {"max_force": -1}),
        ):  # fmt: skip
            with self.subTest(words):
                refused(self, dibhr.InputError, words, lambda: renderer.set(**keywords))
        self.assertEqual(renderer.parameters, before)

    def test_errors_are_of_the_kinds_that_scripts_expect(self):
        self.assertTrue(issubclass(dibhr.InputError, (dibhr.Error)))
        self.assertTrue(issubclass(dibhr.InputError, ValueError))
        self.assertTrue(issubclass(dibhr.MissingFileError, FileNotFoundError))
        self.assertTrue(issubclass(dibhr.MissingFileError, dibhr.InputError))
        self.assertTrue(issubclass(dibhr.BusyError, RuntimeError))
        with self.assertRaises(ValueError):
            dibhr.Renderer(self.surface, relief=-1)
        with self.assertRaises(TypeError):
            dibhr.Renderer(None)


if __name__ == "__main__":
    unittest.main()
