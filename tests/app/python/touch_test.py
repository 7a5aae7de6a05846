"""The module gives the same bits as `dibhr touch`."""

import unittest

import numpy as np

import dibhr
from helpers import FolderTest, circle, hills, read_rows, run_dibhr, write_pgm

# All but the time an update took.
COLUMNS = "t gx gy gz px py pz fx fy fz cx cy cz contact primitive i j moves".split()


class SameBitsAsTheProgram(FolderTest):
    def touched_by_program(self, levels, goals, t, *options):
        write_pgm(self.folder / "depth.pgm", levels)
        table = np.column_stack([t, goals])
        np.savetxt(self.folder / "goals.csv", table, "%.17g", ",", header="t,x,y,z", comments="")
        files = ["--depth", "depth.pgm", "--goals", "goals.csv", "--out", "out.csv"]
        result = run_dibhr(self.folder, "touch", "--raw-depth", *files, *options)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return read_rows(self.folder / "out.csv")

    def assert_same(self, rows, expected):
        self.assertEqual(rows.dtype.names, expected.dtype.names)
        self.assertEqual(len(rows), len(expected))
        for column in COLUMNS:
            same = rows[column] == expected[column]
            self.assertTrue(same.all(), f"{column}: {np.argmin(same)}")
            if rows[column].dtype.kind == "f":
                signs = np.signbit(rows[column]) == np.signbit(expected[column])
                self.assertTrue(signs.all(), column)

    def test_on_20_000_goals_of_the_papers_circle(self):
        levels = np.full((486, 720), 128, np.uint8)
        goals, t = circle(), np.arange(20000) * 0.001
        expected = self.touched_by_program(levels, goals, t, "--friction", "0.4")
        rows = dibhr.Renderer(dibhr.Surface(levels), friction=0.4).run(goals, t)
        self.assert_same(rows, expected)
        self.assertTrue(rows["contact"][1:].all())
        force = dibhr.vectors(rows, "f")[-2:]
        force /= np.linalg.norm(force, axis=1)[:, None]
        self.assertAlmostEqual(np.degrees(np.arccos(force[0] @ force[1])), 0.528, delta=0.0005)

    def test_with_every_algorithm_and_other_parameters_over_hills(self):
        for algorithm in dibhr.ALGORITHMS:
            with self.subTest(algorithm):
                levels = hills()
                goals = circle(3000, (80, 60), 0.0, 55.0, 0.02)
                goals[:, 2] = 100 + 80 * np.sin(np.arange(3000) / 200)
                t = np.cumsum(np.tile([0.001, 0.0012, 0.0, 0.03], 750))
                options = ["--algorithm", algorithm, "--relief", "180", "--stiffness", "0.8"]
                options += ["--damping", "3", "--damping-cutoff", "50"]
                options += ["--static-friction", "0.6", "--dynamic-friction", "0.3"]
                expected = self.touched_by_program(levels, goals, t, *options)
                renderer = dibhr.Renderer(
                    dibhr.Surface(levels), algorithm=algorithm, relief=180, stiffness=0.8,
                    damping=3, damping_cutoff=50, static_friction=0.6, dynamic_friction=0.3,
                )  # fmt: skip
                rows = renderer.run(goals, t)
                self.assert_same(rows, expected)
                self.assertEqual(set(np.unique(rows["contact"])), {False, True})

    def test_with_16_bits_and_a_bump_map(self):
        levels, bump = hills(dtype=np.uint16), hills(31, 47)
        write_pgm(self.folder / "bump.pgm", bump)
        goals, t = circle(2000, (80, 60), 90.0, 55.0, 0.02), np.arange(2000) * 0.001
        expected = self.touched_by_program(
            levels, goals, t, "--bump", "bump.pgm", "--roughness", "9", "--pixel-pitch", "0.3"
        )
        renderer = dibhr.Renderer(
            dibhr.Surface(levels, bump=bump), roughness=9, pixel_pitch=0.3
        )
        self.assert_same(renderer.run(goals, t), expected)

    def test_in_pieces_and_one_by_one(self):
        levels, goals = hills(), circle(400, (80, 60), 90.0, 55.0, 0.02)
        whole = dibhr.Renderer(dibhr.Surface(levels)).run(goals)
        pieces = dibhr.Renderer(dibhr.Surface(levels))
        pieced = np.concatenate([pieces.run(goals[k : k + 100]) for k in range(0, 400, 100)])
        single = dibhr.Renderer(dibhr.Surface(levels))
        for k, goal in enumerate(goals):
            touch = single.update(goal)
            self.assertEqual(touch.goal, tuple(goal))
            for rows in (whole, pieced):
                self.assertEqual(touch.proxy, tuple(dibhr.vectors(rows[k], "p")))
                self.assertEqual(touch.spring_force, tuple(dibhr.vectors(rows[k], "f")))
                self.assertEqual(touch.sent_force, tuple(dibhr.vectors(rows[k], "c")))
                facts = (touch.contact, touch.primitive, touch.i, touch.j, touch.moves)
                self.assertEqual(facts, tuple(rows[k][["contact", "primitive", "i", "j", "moves"]]))

    def test_tells_while_the_proxy_is_catching_up(self):
        columns = np.arange(1200)
        levels = np.repeat([100 + columns**2 % 3], 20, axis=0).astype(np.uint8)
        renderer = dibhr.Renderer(dibhr.Surface(levels), friction=0)
        goals = [(5, 10, 120), (5, 10, 80)] + 9 * [(1190, 10, 80)]
        told = [renderer.update(goal).bound_met for goal in goals]
        self.assertEqual(told[:3] + told[-1:], [False, False, True, False])

    def test_again_after_a_reset(self):
        renderer = dibhr.Renderer(dibhr.Surface(hills()))
        goals, t = circle(300, (80, 60), 90.0, 55.0, 0.02), np.arange(300) * 0.001
        first = renderer.run(goals, t)
        renderer.reset()
        self.assert_same(renderer.run(goals, t), first)


class Safety(unittest.TestCase):
    def test_lets_no_more_through_than_max_force(self):
        levels = np.full((32, 32), 200, np.uint8)
        goals = np.column_stack([np.full(2000, 10.0), np.full(2000, 10.0), np.full(2000, 20.0)])
        goals[:, 2] = np.maximum(20.0, 220.0 - np.arange(2000))
        for most in (4.0, 1.5):
            rows = dibhr.Renderer(dibhr.Surface(levels), max_force=most).run(goals)
            sent = np.linalg.norm(dibhr.vectors(rows, "c"), axis=1)
            self.assertGreater(rows["fz"].max(), 8.0)
            self.assertAlmostEqual(sent.max(), most, places=9)
            self.assertLessEqual(np.diff(sent).max(), 0.5 + 1e-12)

    def test_sends_nothing_after_a_late_tick_and_says_why(self):
        renderer = dibhr.Renderer(dibhr.Surface(np.full((32, 32), 200, np.uint8)))
        renderer.run([[10, 10, 210], *[[10, 10, 190]] * 500])
        self.assertEqual(renderer.update((10, 10, 190)).cut, "")
        self.assertGreater(renderer.update((10, 10, 190)).sent_force[2], 0.0)
        late = renderer.update((10, 10, 190), dt=0.5)
        self.assertEqual((late.sent_force, late.cut), ((0.0, 0.0, 0.0), "late tick"))


class MovingSurface(unittest.TestCase):
    def test_blends_two_images_at_each_update(self):
        low, high = np.full((20, 30), 50, np.uint8), np.full((20, 30), 150, np.uint8)
        blend = np.linspace(0.0, 1.0, 101)
        renderer = dibhr.Renderer(dibhr.Surface(low, high))
        rows = renderer.run(np.tile([10.0, 10.0, 10.0], (101, 1)), blend=blend)
        np.testing.assert_allclose(rows["pz"], 50 + 100 * blend, atol=1e-9)

    def test_is_swapped_between_updates(self):
        low, high = np.full((20, 30), 50, np.uint8), np.full((20, 30), 150, np.uint8)
        between = dibhr.Surface(low, high).blended(0.25)
        renderer = dibhr.Renderer(dibhr.Surface(low))
        self.assertEqual(renderer.update((10, 10, 10)).proxy[2], 50.0)
        renderer.surface = between
        self.assertEqual(renderer.update((10, 10, 10)).proxy[2], 75.0)
        self.assertEqual(renderer.surface.blend, 0.25)
        renderer.surface = dibhr.Surface(np.full((4, 5), 20, np.uint8))
        self.assertEqual(renderer.update((29, 19, 10)).proxy, (4.0, 3.0, 20.0))
        renderer.surface = between
        np.testing.assert_array_equal(renderer.elevation([0, 4.5], [3, 2.5]), [75.0, 75.0])


if __name__ == "__main__":
    unittest.main()
