import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
from scenes import box, program, sources

import gracilis

model = sources / "tests" / "opensim" / "reference" / "arm26_right.osim"


class OpenSim(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        angles = np.radians(np.linspace(10, 100, 10))
        self.motion = dict(time=np.arange(10) / 10, r_elbow_flex=angles)

    def test_paths_are_those_of_the_program(self):
        table = gracilis.Table(self.motion, r_elbow_flex=np.degrees(self.motion["r_elbow_flex"]))
        table.in_degrees = True
        gracilis.write_sto(self.folder / "motion.sto", table)
        subprocess.run([program, "paths", str(model), "--motion", str(self.folder / "motion.sto"), "--out", str(self.folder),
                        "--prefix", "arm"], check=True, capture_output=True)  # fmt: skip
        lengths, arms = gracilis.paths(model, self.motion)
        for mine, name in ((lengths, "Length"), (arms["r_elbow_flex"], "MomentArm_r_elbow_flex")):
            theirs = gracilis.read_sto(self.folder / f"arm_MuscleAnalysis_{name}.sto")
            self.assertEqual(list(mine), list(theirs))
            for column in mine:
                np.testing.assert_allclose(mine[column], theirs[column], atol=1e-9)
        self.assertGreater(np.ptp(arms["r_elbow_flex"]["BIClong"]), 0.005)

    def test_activations_carry_the_motion_and_progress_is_told(self):
        rows = []
        activations, forces = gracilis.static_optimization(model, self.motion, progress=lambda *done: rows.append(done))
        self.assertEqual(len(rows), 10)
        self.assertTrue(all(total == 10 for _, total in rows))
        self.assertIn("BIClong", activations)
        self.assertTrue(all((0 <= activations[muscle]).all() for muscle in activations))
        self.assertGreater(max(forces["BIClong"]), 1)

        def fail(*done):
            raise KeyError("enough")

        with self.assertRaises(KeyError):
            gracilis.static_optimization(model, self.motion, progress=fail)

    def test_a_model_becomes_a_scene(self):
        (scene,) = gracilis.import_model(model, self.folder / "scene", muscles=["BIClong"])
        loaded = gracilis.load(scene)
        self.assertEqual(list(loaded.muscles), ["BIClong"])
        with self.assertRaisesRegex(gracilis.ConfigurationError, "holds a model already"):
            gracilis.import_model(model, self.folder / "scene")
        with self.assertRaisesRegex(gracilis.InputError, "nowhere.osim"):
            gracilis.paths("nowhere.osim", self.motion)


class Preparing(unittest.TestCase):
    def test_overlapping_surfaces_come_apart(self):
        given = {"low": box((0, 0, 0), (0.04, 0.04, 0.04), 6), "high": box((0, 0, 0.039), (0.04, 0.04, 0.08), 6)}
        try:
            prepared = gracilis.prepare(given, edge_length=0.006)
        except gracilis.Error as error:
            self.assertIn("built without", str(error))
            self.skipTest("built without prepare")
        self.assertEqual(list(prepared), ["low", "high"])
        low, high = prepared["low"][0], prepared["high"][0]
        inner = low[(low[:, 2] > 0.03) & (np.abs(low[:, :2] - 0.02) < 0.012).all(axis=1)]
        bottom = high[high[:, 2] < 0.05]
        self.assertGreater(len(inner), 5)
        for vertex in inner:  # above it, the other surface's nearest vertices
            nearest = np.argsort(np.linalg.norm(bottom[:, :2] - vertex[:2], axis=1))[:3]
            self.assertGreater(bottom[nearest, 2].min(), vertex[2])
        overlapping = gracilis.prepare(given, edge_length=0.006, keep_overlaps=True)
        self.assertGreater(overlapping["low"][0][:, 2].max(), overlapping["high"][0][:, 2].min())
        for wrong in (-1, True, "small"):
            with self.assertRaisesRegex(gracilis.ConfigurationError, "'edge_length' must be"):
                gracilis.prepare(given, edge_length=wrong)
        with self.assertRaisesRegex(gracilis.ConfigurationError, "'keep_overlaps' must be"):
            gracilis.prepare(given, keep_overlaps=1)
        with self.assertRaisesRegex(gracilis.ConfigurationError, "no setting 'edge'"):
            gracilis.prepare(given, edge=1)


if __name__ == "__main__":
    unittest.main()
