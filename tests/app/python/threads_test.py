"""The interpreter is free while a run computes."""

import sys
import threading
import unittest

import numpy as np

import dibhr
from helpers import circle, hills


class Threads(unittest.TestCase):
    def test_of_python_advance_during_a_run(self):
        renderer = dibhr.Renderer(dibhr.Surface(hills()))
        goals = circle(100, (80, 60), 90.0, 55.0, 0.9)  # too few for NumPy to release the interpreter
        # A thread keeps the interpreter until a run releases it.
        interval = sys.getswitchinterval()
        sys.setswitchinterval(1000.0)
        self.addCleanup(sys.setswitchinterval, interval)
        advanced = []

        def run():
            for _ in range(500_000):  # some half a minute
                renderer.run(goals)
                if len(advanced) > 3:
                    return
            advanced.clear()

        thread = threading.Thread(target=run)
        thread.start()
        while thread.is_alive():
            advanced.append(True)
            thread.join(0.0001)
        self.assertGreater(len(advanced), 3)

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
        renderer = dibhr.Renderer(dibhr.Surface(hills()))
        goals = circle(10_000, (80, 60), 90.0, 55.0, 0.9)
        refused = []

        def run():
            for _ in range(5000):
                if refused:
                    return
                renderer.run(goals)

        thread = threading.Thread(target=run)
        thread.start()
        while thread.is_alive() and not refused:
            try:
                renderer.update((1, 1, 200))
            except dibhr.BusyError as error:
                refused.append(str(error))
        thread.join()
        self.assertEqual(
            refused, ["this renderer is at work in another thread; give each its own"]
        )
        renderer.update((1, 1, 200))


if __name__ == "__main__":
    unittest.main()
