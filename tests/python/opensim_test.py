import re
import subprocess
import tempfile
import unittest
import warnings
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

    def warnings_of(self, call):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            call()
        self.assertTrue(all(issubclass(each.category, gracilis.SceneWarning) for each in caught))
        return [str(each.message) for each in caught]

    def test_forces_that_take_no_part_and_loads_of_a_part_of_the_time_are_told(self):
        text = model.read_text()
        body = re.search(r'<Body name="(r_[^"]*)"', text).group(1)
        with_heel = self.folder / "heel.osim"
        head, tail = text.split("<ForceSet", 1)
        before, after = tail.split("<objects>", 1)
        with_heel.write_text(f'{head}<ForceSet{before}<objects><HuntCrossleyForce name="heel"/>{after}')
        forces = self.folder / "forces.xml"
        forces.write_text('<OpenSimDocument Version="40000"><ForceSet name="more"><objects><CoordinateActuator name="reserve">'
                          "<coordinate>r_elbow_flex</coordinate><optimal_force>10</optimal_force></CoordinateActuator>"
                          '<Spaceship name="odd"/></objects></ForceSet></OpenSimDocument>')  # fmt: skip
        pull = {f"pull_v{axis}": np.zeros(5) for axis in "xyz"}
        gracilis.write_sto(self.folder / "loads.sto", dict(time=np.arange(5) / 10, **pull))
        loads = self.folder / "loads.xml"
        loads.write_text('<OpenSimDocument Version="40000"><ExternalLoads name="loads"><objects><ExternalForce name="pull">'
                         f"<applied_to_body>{body}</applied_to_body><force_expressed_in_body>ground</force_expressed_in_body>"
                         "<force_identifier>pull_v</force_identifier></ExternalForce></objects>"
                         "<datafile>loads.sto</datafile></ExternalLoads></OpenSimDocument>")  # fmt: skip
        said = self.warnings_of(lambda: gracilis.static_optimization(with_heel, self.motion, loads=loads, forces=[forces]))
        for expected in ("not supported: .*odd", f"{loads}: the loads are measured from 0 to 0.4 s only",
                         r"2 of the model's forces took no part.*: heel, odd"):  # fmt: skip
            self.assertTrue(any(re.search(expected, each) for each in said), f"{expected} is not in {said}")

    def test_weakness_says_what_is_missing(self):
        heavy = self.folder / "heavy.osim"
        heavy.write_text(re.sub(r"<mass>([\d.]+)</mass>", lambda found: f"<mass>{1000 * float(found[1])}</mass>",
                                model.read_text()))  # fmt: skip
        said = self.warnings_of(lambda: gracilis.static_optimization(heavy, self.motion))
        self.assertTrue(any("too weak; missing (N m or N): r_" in each for each in said), said)

    def test_lengths_that_opensim_has_otherwise_are_told(self):
        said = [each for each in self.warnings_of(lambda: gracilis.paths(model, self.motion)) if "what OpenSim computes" in each]
        done = subprocess.run([program, "paths", str(model), "--coord", "r_elbow_flex=10:100:10", "--out", str(self.folder)],
                              check=True, capture_output=True, text=True)  # fmt: skip
        by_command = [line for line in done.stderr.splitlines() if "what OpenSim computes" in line]
        self.assertEqual(len(said), len(by_command))
        for mine, theirs in zip(said, by_command):
            self.assertIn(mine, theirs)

    def test_a_motion_without_rows_is_refused(self):
        for function in (gracilis.paths, gracilis.static_optimization):
            with self.assertRaisesRegex(gracilis.InputError, "has no rows"):
                function(model, dict(time=np.zeros(0), r_elbow_flex=np.zeros(0)))

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
