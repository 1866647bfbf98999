import pickle
import tempfile
import unittest
from pathlib import Path

import numpy as np
from scenes import bar, box, demo, small_demo, sources

import gracilis


class Scenes(unittest.TestCase):
    def test_the_built_in_hip_has_six_muscles_and_three_coordinates(self):
        scene = demo()
        self.assertEqual(len(scene.muscles), 6)
        self.assertEqual(scene.coordinates, ["hip_flexion_r", "hip_adduction_r", "hip_rotation_r"])
        self.assertEqual(len(scene.poses), 11)
        np.testing.assert_array_equal(scene.poses[-1].coordinates, [np.radians(10), 0, 0])

    def test_surfaces_are_read_only_views_of_metres(self):
        vertices, faces = demo().muscles["iliacus_r"]
        self.assertEqual((vertices.dtype, faces.dtype), (np.float64, np.int32))
        self.assertEqual((vertices.shape[1], faces.shape[1]), (3, 3))
        self.assertLess(np.ptp(vertices, axis=0).max(), 0.5)
        for array in (vertices, faces):
            self.assertFalse(array.flags.writeable)
            self.assertFalse(array.flags.owndata)

    def test_a_scene_of_arrays_holds_them_bit_by_bit(self):
        scene = gracilis.Scene(**bar())
        np.testing.assert_array_equal(scene.muscles["muscle"][0], bar()["muscles"][0]["surface"][0])
        np.testing.assert_array_equal(scene.bones["upper"][1], bar()["bones"][1]["surface"][1])
        self.assertEqual(scene.coordinates, ["bend"])

    def test_settings_have_the_scene_files_names(self):
        scene = gracilis.Scene(**bar(iterations=7, contact={"muscle": "none"}))
        self.assertIn("iterations = 7", scene.settings_text())
        self.assertIn('muscle = "none"', scene.settings_text())
        self.assertIn("iterations = 5", small_demo().settings_text())

    def test_a_scene_is_made_again_elsewhere(self):
        for scene in (gracilis.Scene(**bar(iterations=7)), small_demo()):
            again = pickle.loads(pickle.dumps(scene))
            for name, (vertices, _) in scene.muscles.items():
                np.testing.assert_array_equal(again.muscles[name][0], vertices)
            self.assertEqual(again.settings_text(), scene.settings_text())
            self.assertEqual(len(again.poses), len(scene.poses))

    def test_what_is_worth_knowing_is_a_warning(self):
        muscle = bar()["muscles"][0]
        vertices, faces = muscle["surface"]
        muscle["surface"] = (vertices, np.vstack([faces, [[0, 0, 1]]]).astype(np.int32))
        muscle["attachments"] = [
            dict(name=end, end=end, bone=bone, bone_distance_mm=3) for end, bone in (("origin", "lower"), ("insertion", "upper"))
        ]
        with self.assertWarns(gracilis.SceneWarning) as heard:
            scene = gracilis.Scene(**bar(muscles=[muscle]))
        self.assertIn(str(heard.warning), scene.warnings)

    def test_files_are_read_with_what_is_set(self):
        file = sources / "tests" / "app" / "nowhere.toml"
        with self.assertRaisesRegex(gracilis.InputError, "nowhere.toml") as raised:
            gracilis.load(file, iterations=3)
        self.assertEqual(raised.exception.exit_code, 3)
        self.assertEqual(raised.exception.problems[0]["file"], str(file))


    def test_a_file_has_no_arrays(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "scene.toml"
            file.write_text('schema = 1\n[[bones]]\nname = "femur"\ngiven = 0\n')
            with self.assertRaisesRegex(gracilis.ConfigurationError, "scene.toml:2.*no program gives surface 0 of 'femur'"):
                gracilis.load(file)


class Refusals(unittest.TestCase):
    def refused(self, message, kind=gracilis.InputError, **changes):
        with self.assertRaisesRegex(kind, message) as raised:
            gracilis.Scene(**bar(**changes))
        self.assertGreaterEqual(len(raised.exception.problems), 1)

    def muscle(self, surface=None, **changes):
        muscle = dict(bar()["muscles"][0], **changes)
        if surface is not None:
            muscle["surface"] = surface
        return [muscle]

    def test_shapes_and_dtypes(self):
        vertices, faces = box((0, 0, 0), (0.1, 0.1, 0.1))
        for surface, message in (
            ((vertices[:, :2], faces), r"vertices: must be float64 \(n, 3\), in m, and is float64 \(\d+, 2\)"),
            ((vertices.ravel(), faces), r"vertices: must be float64 \(n, 3\), in m, and is float64 \(\d+,\)"),
            ((vertices.astype(complex), faces), "and is complex128"),
            ((vertices.astype(int), faces), r"vertices: must be .* and is int64"),
            ((vertices, faces.astype(float)), r"faces: must be int32 \(m, 3\), and is float64"),
            ((vertices, faces[:, :2]), r"faces: must be int32 \(m, 3\), and is int32 \(\d+, 2\)"),
            ((vertices, faces - 1), "has an index outside"),
            ((vertices, faces + 1), "vertices that do not exist"),
            ((vertices, faces.astype(np.int64) + 2**40), "has an index outside"),
            (("a", faces), "and is"),
            (vertices, "must be a pair"),
            ((vertices * 1000, faces), "the unit is wrong"),
            ((vertices * np.nan, faces), "not finite"),
            ((vertices, faces[:-1]), "open edge"),
        ):
            with self.subTest(message):
                self.refused(f"muscle.*{message}", muscles=self.muscle(surface))

    def test_names_and_values_have_the_programs_messages(self):
        wrong = gracilis.ConfigurationError
        self.refused("did you mean 'iterations'", wrong, settings=dict(iteration=3))
        self.refused("'iterations' must be an integer", wrong, iterations=-1)
        self.refused("there is no body 'middle'", wrong, muscles=self.muscle(
            attachments=[dict(name="low", end="origin", body="middle", vertices=[0, 1, 2])]))  # fmt: skip
        self.refused("unknown key", wrong, bonez=[])
        self.refused("which no scene file can hold", name=object())

    def test_a_vertex_that_is_not_there(self):
        attachments = bar()["muscles"][0]["attachments"]
        attachments[0]["vertices"] = [0, 1, 100000]
        self.refused("low", gracilis.ConfigurationError, muscles=self.muscle(attachments=attachments))

    def test_of_built_in_scenes(self):
        with self.assertRaisesRegex(gracilis.InputError, "no built-in scene 'knee'"):
            gracilis.demo("knee")
        with self.assertRaisesRegex(gracilis.ConfigurationError, "did you mean 'physical'"):
            gracilis.demo(preset="phisical")


if __name__ == "__main__":
    unittest.main()
