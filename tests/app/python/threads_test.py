"""The interpreter is free while a run computes."""

import sys
import threading
import unittest

import numpy as np

import dibhr
from helpers import circle, hills


class Threads(unittest.TestCase):
    def test_of_python_advance_during_a_run(self):
        renderer = dibhr.Renderer(dibhr.Surface(hills()), algorithm="neighborhood")
        goals = circle(200_000, (80, 60), 90.0, 55.0, 0.9)
        # The interpreter is not taken from a thread that holds it; only a run gives it away.
        interval = sys.getswitchinterval()
        sys.setswitchinterval(1000.0)
        self.addCleanup(sys.setswitchinterval, interval)
        begun, over, advanced = threading.Event(), threading.Event(), []

        def run():
            begun.set()
            renderer.run(goals)
            advanced.append(count)
            over.set()

        count = 0
        thread = threading.Thread(target=run)
        thread.start()
        begun.wait()
        while not over.is_set() and count < 1000:
            count += 1
            over.wait(0.0001)
        thread.join()
        self.assertGreater(advanced[0], 3)

    def test_share_a_surface_and_get_the_bits_of_one(self):
        surface = dibhr.Surface(hills())
        goals = circle(20_000, (80, 60), 90.0, 55.0, 0.02)
        expected = dibhr.vectors(dibhr.Renderer(surface).run(goals), "c")
        results = [None] * 4

        def run(k):
            results[k] = dibhr.vectors(dibhr.Renderer(surface).run(goals), "c")

        threads = [threading.Thread(target=run, args=(k,)) for k in range(len(results))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for result in results:
            np.testing.assert_array_equal(result, expected)

    def test_do_not_share_a_renderer(self):
        renderer = dibhr.Renderer(dibhr.Surface(hills()), algorithm="neighborhood")
        thread = threading.Thread(
            target=renderer.run, args=(circle(400_000, (80, 60), 90.0, 55.0, 0.9),)
        )
        thread.start()
        refused = None
        while thread.is_alive() and refused is None:
            try:
                renderer.update((1, 1, 200))
            except dibhr.BusyError as error:
                refused = str(error)
        thread.join()
        self.assertEqual(refused, "this renderer is at work in another thread; give each its own")
        renderer.update((1, 1, 200))


if __name__ == "__main__":
    unittest.main()
