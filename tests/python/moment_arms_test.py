import pickle
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
from scenes import program, small_demo

import gracilis

scene_file = """
schema = 1
name = "bar"
method = "skinning"
bones = [{ name = "lower", box = { size_mm = [40, 40, 20], center_mm = [0, 0, -11] } },
         { name = "upper", box = { size_mm = [40, 40, 20], center_mm = [0, 0, 111] } }]
[[joints]]
name = "hinge"
parent = "lower"
child = "upper"
center = [0, 0, 0.05]
axes = [{ coordinate = "bend", axis = [1, 0, 0], range_deg = [-60, 60] }]
[[muscles]]
name = "muscle"
box = { size_mm = [20, 20, 100], center_mm = [0, 30, 50], cells = [3, 3, 12] }
[[muscles.attachments]]
name = "low"
end = "origin"
bone = "lower"
body = "lower"
points_mm = [[-10, 20, 0], [10, 20, 0], [10, 40, 0], [-10, 40, 0]]
line = "closed"
bone_distance_mm = 40
landmark_distance_mm = 1
[[muscles.attachments]]
name = "high"
end = "insertion"
bone = "upper"
body = "upper"
points_mm = [[-10, 20, 100], [10, 20, 100], [10, 40, 100], [-10, 40, 100]]
line = "closed"
bone_distance_mm = 40
landmark_distance_mm = 1
"""


class MomentArms(unittest.TestCase):
    def test_they_are_those_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            file, out = Path(folder) / "bar.toml", Path(folder) / "run"
            file.write_text(scene_file)
            subprocess.run([program, "rom", str(file), "--coord", "bend=-20:20:5", "--out", str(out), "--metrics", "none"],
                           check=True, capture_output=True)  # fmt: skip
            table = gracilis.read_sto(out / "moment_arms.sto")
            again = gracilis.rom(gracilis.load(file), "bend", (-20, 20, 5), Path(folder) / "rom", metrics="none")
            for name in ("moment_arms.sto", "fiber_lengths.sto", "frames/muscle_0008.vtp"):
                self.assertEqual((Path(again.folder) / name).read_bytes(), (out / name).read_bytes(), name)
            scene = pickle.loads(pickle.dumps(gracilis.load(file)))  # made again from its file
            arms = gracilis.moment_arms(scene, "bend", range(-20, 21, 5))
        np.testing.assert_array_equal(arms.degrees, np.arange(-20, 21, 5))
        np.testing.assert_allclose(table["bend"], arms.degrees, atol=1e-4)
        # The program goes by lengths that it wrote with a micrometre's digits, 5 degrees apart.
        np.testing.assert_allclose(arms.arms["muscle"], table["muscle"], atol=2e-5)
        self.assertGreater(np.abs(arms.arms["muscle"]).min(), 0.01)

    def test_they_say_how_lengths_change(self):
        arms = gracilis.moment_arms(small_demo(), "hip_flexion_r", np.arange(0, 13, 3), method="skinning")
        slopes = -np.gradient(arms.lengths["iliacus_r"], np.radians(arms.degrees))
        np.testing.assert_allclose(arms.arms["iliacus_r"][1:-1], slopes[1:-1], rtol=1e-9)
        self.assertTrue((arms.arms["iliacus_r"] > 0.01).all())  # it flexes the hip

    def published(self, folder):
        file = Path(folder) / "published.csv"
        file.write_text("muscle,angle_deg,moment_arm_mm\niliacus_r,0,30\niliacus_r,6,32\n")
        return file

    def test_a_range_is_compared_with_published_arms(self):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "rom"
            run = gracilis.rom(small_demo(), "hip_flexion_r", (0, 6, 3), out, at={"hip_rotation_r": 5.0},
                               reference=self.published(folder), metrics="none")  # fmt: skip
            self.assertEqual(run.coordinates["hip_rotation_r_deg"][-1], 5)
            self.assertEqual(len((out / "reference.csv").read_text().splitlines()), 2)

    def test_several_ranges_give_arms_about_each_in_all_combinations(self):
        with tempfile.TemporaryDirectory() as folder:
            out, ranges = Path(folder) / "rom", {"hip_rotation_r": (0, 4, 2)}
            gracilis.rom(small_demo(), "hip_flexion_r", (0, 6, 3), out, at=ranges, metrics="none")
            for name in ("hip_flexion_r", "hip_rotation_r"):
                table = gracilis.read_sto(out / f"moment_arms_about_{name}.sto")
                poses = set(zip(np.round(table["hip_flexion_r"], 9), np.round(table["hip_rotation_r"], 9)))
                self.assertEqual(poses, {(f, r) for f in (0, 3, 6) for r in (0, 2, 4)})
            with self.assertRaisesRegex(gracilis.Error, "about one coordinate"):
                gracilis.rom(small_demo(), "hip_flexion_r", (0, 6, 3), at=ranges, reference=self.published(folder))

    def test_what_no_range_can_be(self):
        for wrong in ((0, 0, 1), (0, 10, 0), (0, 10, -1), (0, float("nan"), 1)):
            with self.subTest(wrong), self.assertRaisesRegex(gracilis.InputError, "goes nowhere"):
                gracilis.rom(small_demo(), "hip_flexion_r", wrong)
            with self.subTest(wrong), self.assertRaisesRegex(gracilis.Error, "goes nowhere"):
                gracilis.rom(small_demo(), "hip_flexion_r", (0, 6, 3), at={"hip_rotation_r": wrong})
        with self.assertRaisesRegex(gracilis.ConfigurationError, "did you mean 'hip_flexion_r'"):
            gracilis.rom(small_demo(), "hip_flexion", (0, 6, 3))
        with self.assertRaisesRegex(gracilis.ConfigurationError, "given twice"):
            gracilis.rom(small_demo(), "hip_flexion_r", (0, 6, 3), at={"hip_flexion_r": 1})

    def test_what_cannot_be_asked(self):
        scene = small_demo()
        with self.assertRaisesRegex(gracilis.ConfigurationError, "did you mean 'hip_flexion_r'"):
            gracilis.moment_arms(scene, "hip_flexion", range(3))
        with self.assertRaisesRegex(gracilis.InputError, "two finite numbers or more"):
            gracilis.moment_arms(scene, "hip_flexion_r", [1])
        with self.assertRaisesRegex(gracilis.InputError, "one-dimensional"):
            gracilis.moment_arms(scene, "hip_flexion_r", "10:20")


if __name__ == "__main__":
    unittest.main()
