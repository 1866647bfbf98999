import tempfile
import unittest
from pathlib import Path

import numpy as np
from scenes import demo, demo_run

import gracilis


class Runs(unittest.TestCase):
    def test_frames_and_tables_are_those_of_the_folder(self):
        run = gracilis.Run(demo_run())
        self.assertEqual(run.muscles, list(demo().muscles))
        self.assertEqual(len(run.times), len(run))
        np.testing.assert_allclose(run.coordinates["hip_flexion_r_deg"], np.arange(11), atol=1e-3)
        vertices, faces = run.surface("iliacus_r", 0)
        np.testing.assert_array_equal(vertices, demo().muscles["iliacus_r"][0])
        np.testing.assert_array_equal(faces, demo().muscles["iliacus_r"][1])
        np.testing.assert_array_equal(run.surface("femur_r", -1)[0], run.surface("femur_r", 10)[0])
        self.assertEqual(run.manifest["scene"], demo().name)
        for values in run.measures.values():
            self.assertEqual(values.shape, (len(run), len(run.muscles)))

    def test_what_is_not_there_is_said(self):
        run = gracilis.Run(demo_run())
        with self.assertRaisesRegex(gracilis.ConfigurationError, "did you mean 'iliacus_r'"):
            run.surface("iliacus", 0)
        with self.assertRaisesRegex(IndexError, "the run has 11"):
            run.surface("iliacus_r", 11)
        with tempfile.TemporaryDirectory() as folder, self.assertRaisesRegex(gracilis.InputError, "run.json"):
            gracilis.Run(folder)

    def test_tables_are_those_of_the_folder(self):
        scene = gracilis.demo(flexion=2, only=["iliacus_r"], iterations=1)
        with tempfile.TemporaryDirectory() as folder:
            run = gracilis.run(scene, Path(folder) / "run", metrics="none")
            self.assertEqual(run.tables, sorted(file.stem for file in run.folder.glob("*.sto")))
            self.assertIn("fiber_lengths", run.tables)
            lengths = run.table("fiber_lengths")
            self.assertEqual(lengths["time"].shape, (len(run),))
            self.assertTrue(((lengths["iliacus_r"] > 0.01) & (lengths["iliacus_r"] < 0.3)).all())
            with self.assertRaisesRegex(gracilis.ConfigurationError, "did you mean 'fiber_lengths'"):
                run.table("fiber_length")

    def test_a_report_compares_runs_and_folders_of_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "report.html"
            self.assertEqual(gracilis.report([gracilis.Run(demo_run()), demo_run()], path), path)
            both = path.stat().st_size
            gracilis.report([str(demo_run())], path)
            self.assertGreater(both, path.stat().st_size)
            for none, message in (([], "needs a run"), ([None], "None is no run")):
                with self.assertRaisesRegex(gracilis.InputError, message):
                    gracilis.report(none, path)

    def test_a_report_is_a_page_and_stands_in_a_notebook(self):
        run = gracilis.Run(demo_run())
        with tempfile.TemporaryDirectory() as folder:
            page = run.report(Path(folder) / "report.html").read_text()
        self.assertIn("<!doctype html>", page.lower())
        self.assertIn("iliacus_r", page)
        shown = run._repr_html_()
        self.assertTrue(shown.startswith("<iframe"))
        self.assertIn("iliacus_r", shown)


class Tables(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.file = Path(self.folder.name) / "motion.sto"

    def test_what_is_written_is_read(self):
        table = gracilis.Table(time=np.arange(5) / 10, hip_flexion_r=np.linspace(0, 30, 5), other=[1, 2, 3, 4, 5])
        table.in_degrees = True
        gracilis.write_sto(self.file, table)
        again = gracilis.read_sto(self.file)
        self.assertEqual((list(again), again.in_degrees, again.name), (["time", "hip_flexion_r", "other"], True, "motion"))
        for column in table:
            np.testing.assert_array_equal(again[column], table[column])
        gracilis.write_sto(self.file, dict(again), name="plain")
        self.assertFalse(gracilis.read_sto(self.file).in_degrees)

    def test_tables_that_are_none_are_refused(self):
        time = np.arange(3.0)
        for table, message in (
            (dict(a=time), "no column 'time'"),
            (dict(time=time, a=time[:2]), "a: has 2 rows, and the time 3"),
            (dict(time=time[::-1], a=time), "does not increase in row 1"),
            (dict(time=time, a=time * np.nan), "not finite"),
            (dict(time=time, a=np.eye(3)), "one-dimensional"),
            (dict(time=time, a=["x", "y", "z"]), "one-dimensional array of numbers, and is <U1"),
        ):
            with self.subTest(message), self.assertRaisesRegex(gracilis.InputError, message):
                gracilis.write_sto(self.file, table)
        self.assertFalse(self.file.exists())
        self.file.write_text("nothing of use\n")
        with self.assertRaisesRegex(gracilis.InputError, "motion.sto"):
            gracilis.read_sto(self.file)


if __name__ == "__main__":
    unittest.main()
