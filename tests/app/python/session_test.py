"""Recorded sessions as arrays."""

import os
import pathlib
import shutil
import sqlite3
import subprocess
import tempfile
import unittest

import numpy as np

import dibhr
from helpers import FolderTest, circle, decimal_commas, hills, read_rows, run_dibhr

TICKS = 1000


class Sessions(FolderTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.recorded = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.recorded.cleanup)
        file = pathlib.Path(cls.recorded.name) / "mine.dibhr"
        recorder = os.environ["DIBHR_RECORDER"]
        subprocess.run([recorder], cwd=file.parent, check=True, stdout=subprocess.DEVNULL)
        with sqlite3.connect(file) as database:
            first = database.execute("SELECT min(t) FROM tick").fetchone()[0]
            database.execute("INSERT INTO mark VALUES(1, ?, 'nose', 'très doux')", (first + 0.5,))
        database.close()

    def setUp(self):
        super().setUp()
        self.file = self.folder / "mine.dibhr"
        shutil.copy(pathlib.Path(self.recorded.name) / "mine.dibhr", self.file)
        self.session = dibhr.Session(self.file)

    def test_have_the_ticks_that_export_writes(self):
        result = run_dibhr(self.folder, "export", self.file, "--csv", "all.csv")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        expected = read_rows(self.folder / "all.csv")
        ticks = self.session.ticks()
        self.assertEqual(ticks.dtype.names, expected.dtype.names)
        self.assertEqual((len(ticks), len(self.session)), (TICKS, TICKS))
        touched = ticks["surface"]
        self.assertEqual(touched.sum(), TICKS - 50)
        for column in ticks.dtype.names:
            np.testing.assert_array_equal(
                ticks[column][touched], expected[column][touched].astype(ticks[column].dtype)
            )
        self.assertTrue(np.isnan(ticks["video_s"][~touched]).all())
        self.assertTrue((ticks["frame"][~touched] == -1).all())
        self.assertGreater(ticks["contact"].sum(), 100)
        self.assertLessEqual({"none", "triangle"}, set(ticks["primitive"]))

    def test_and_runs_are_the_same_in_a_program_with_decimal_commas(self):
        def of_it_all():
            session = dibhr.Session(self.file)
            rows = dibhr.Renderer(dibhr.Surface(hills())).run(circle(200, (80, 60), 40.0, 30.0))
            return session.ticks(), session.parameters, session.marks, rows

        expected = of_it_all()
        with decimal_commas():
            found = of_it_all()
            with self.assertRaisesRegex(dibhr.InputError, r"0\.5"):
                dibhr.Renderer(dibhr.Surface(hills()), stiffness=-0.5)
        self.assertEqual(found[1:3], expected[1:3])
        for one, other in ((found[0], expected[0]), (found[3], expected[3])):
            for column in set(one.dtype.names) - {"ns"}:
                np.testing.assert_array_equal(one[column], other[column])

    def test_begin_as_the_rows_of_a_run(self):
        rows = dibhr.Renderer(dibhr.Surface(np.zeros((4, 4)))).run([[1, 1, 1]])
        names = rows.dtype.names
        self.assertEqual(self.session.ticks().dtype.names[: len(names)], names)
        for name in names:
            self.assertEqual(dibhr.TICK_ROW[name], rows.dtype[name])

    def test_give_the_ticks_of_a_range_of_time(self):
        ticks = self.session.ticks()
        self.assertEqual((ticks["t"][0], ticks["t"][-1]), (self.session.begin, self.session.end))
        begin, end = ticks["t"][200], ticks["t"][299]
        np.testing.assert_array_equal(self.session.ticks(begin, end)["tick"], ticks["tick"][200:300])
        np.testing.assert_array_equal(self.session.ticks(end=end)["tick"], ticks["tick"][:300])
        self.assertEqual(len(self.session.ticks(begin=1e9)), 0)
        with self.assertRaises(dibhr.InputError):
            self.session.ticks(begin=float("nan"))

    def test_have_facts_parameters_sources_and_marks(self):
        self.assertEqual(self.session.facts["device"], "a scripted hand")
        self.assertEqual((self.session.missing, self.session.warning), (0, ""))
        first, second = self.session.parameters
        self.assertEqual((first["first_tick"], second["first_tick"]), (0, TICKS // 2))
        self.assertEqual(first["touch"], dibhr.Renderer(dibhr.Surface(np.zeros((4, 4)))).parameters)
        self.assertEqual((first["force_enabled"], first["bump"]), (True, None))
        touch = second["touch"]
        self.assertEqual((touch["static_friction"], touch["dynamic_friction"]), (0.3, 0.2))
        self.assertEqual(
            set(self.session.ticks()["settings"]), {first["version"], second["version"]}
        )
        self.assertGreater(len(self.session.sources), 0)
        for source in self.session.sources:  # with and without motion and in-betweens
            self.assertTrue(source["depth"].endswith("film_depth.mkv"))
            self.assertTrue(source["fill_holes"])
        (mark,) = self.session.marks
        self.assertEqual((mark["tag"], mark["text"]), ("nose", "très doux"))
        self.assertAlmostEqual(mark["t"], self.session.begin + 0.5)
        self.session.check()

    def test_can_be_touched_again(self):
        """After a beginning without contact, every low goal touches the flat surface."""
        ticks = self.session.ticks()
        renderer = dibhr.Renderer(
            dibhr.Surface(np.full((90, 120), 255, np.uint8)), **self.session.parameters[0]["touch"]
        )
        rows = renderer.run(dibhr.vectors(ticks, "g"), ticks["t"])
        np.testing.assert_array_equal(dibhr.vectors(rows, "g"), dibhr.vectors(ticks, "g"))

    def test_may_have_any_name(self):
        name = self.folder / os.fsdecode(b"m\xff \xc3\xa9%?.dibhr")
        with self.assertRaises(FileNotFoundError):
            dibhr.Session(name)
        self.file.rename(name)
        self.assertEqual(len(dibhr.Session(str(name)).ticks()), TICKS)

    def test_may_hold_texts_that_are_no_utf_8(self):
        with sqlite3.connect(self.file) as database:
            database.execute("UPDATE session SET value = CAST(x'ff41' AS TEXT) WHERE key = 'device'")
            database.execute("UPDATE mark SET text = CAST(x'42fe' AS TEXT)")
        database.close()
        session = dibhr.Session(self.file)
        self.assertEqual(os.fsencode(session.facts["device"]), b"\xffA")
        self.assertEqual(os.fsencode(session.marks[0]["text"]), b"B\xfe")
        self.assertEqual(len(session.ticks()), TICKS)

    def test_that_cannot_be_read_are_errors_in_the_programs_words(self):
        (self.folder / "text.dibhr").write_text("no session\n" * 1000)
        (self.folder / "cut.dibhr").write_bytes(self.file.read_bytes()[:5000])
        for name, kind in (
            ("none.dibhr", dibhr.MissingFileError),
            ("text.dibhr", dibhr.InputError),
            ("cut.dibhr", dibhr.InputError),
        ):
            with self.subTest(name):
                told = run_dibhr(self.folder, "report", self.folder / name, "--out", "report")
                with self.assertRaises(kind) as raised:
                    dibhr.Session(self.folder / name).ticks()
                self.assertEqual(f"dibhr: {raised.exception}\n", told.stderr)


if __name__ == "__main__":
    unittest.main()
