import unittest

import numpy as np
from scenes import bar, small_demo

import gracilis


class Sweeps(unittest.TestCase):
    poses = [{"bend": 5.0}, {"bend": 10.0}, {"bend": -10.0}]

    def test_every_pose_is_what_a_simulation_makes_of_it(self):
        scene, told = gracilis.Scene(**bar()), []
        swept = gracilis.sweep(scene, self.poses, method="skinning", step_deg=None, processes=2,
                               progress=lambda *each: told.append(each))  # fmt: skip
        self.assertEqual(told, [(1, 3), (2, 3), (3, 3)])
        self.assertEqual(swept.muscles, ["muscle"])
        self.assertEqual((swept.volumes.shape, swept.fiber_lengths.shape), ((3, 1), (3, 1)))
        sim = gracilis.Simulation(scene, method="skinning")
        for number, pose in enumerate(self.poses):
            sim.reset()
            sim.advance(pose)
            np.testing.assert_array_equal(swept.vertices["muscle"][number], sim.muscles["muscle"].vertices)
            self.assertEqual(swept.volumes[number, 0], sim.muscles["muscle"].volume)
            self.assertEqual(swept.fiber_lengths[number, 0], sim.muscles["muscle"].mean_fiber_length)

    def test_it_walks_there_in_equal_steps_of_two_degrees_at_most(self):
        scene = gracilis.Scene(**bar(contact={"muscle": "none"}, iterations=5, time_mode="dynamic"))

        def swept(settle):
            return gracilis.sweep(scene, [{"bend": 9.0}], fibers=False, settle=settle, processes=1).vertices["muscle"][0]

        sim = gracilis.Simulation(scene)
        for step in range(1, 6):
            sim.advance({"bend": step / 5 * 9.0})
        walked = np.array(sim.muscles["muscle"].vertices)
        np.testing.assert_array_equal(swept(0), walked)
        sim.advance({"bend": 9.0})
        np.testing.assert_array_equal(swept(1), sim.muscles["muscle"].vertices)
        sim.reset()
        sim.advance({"bend": 9.0})
        self.assertFalse(np.array_equal(walked, sim.muscles["muscle"].vertices))

    def test_poses_of_a_motion_bring_their_activations(self):
        def scene(activation):
            return gracilis.Scene(**bar(contact={"muscle": "none"}, iterations=5,
                                        motion=dict(coordinates=["bend"], key_poses_deg=[[0], [4]]),
                                        activations=[dict(muscle="muscle", value=activation)]))  # fmt: skip

        def swept(scene, pose):
            return gracilis.sweep(scene, [pose], fibers=False, processes=1).vertices["muscle"]

        relaxed, active = scene(0.0), scene(0.5)
        pose = relaxed.poses[-1]
        self.assertAlmostEqual(pose.degrees["bend"], 4)
        np.testing.assert_array_equal(swept(relaxed, pose), swept(relaxed, pose.degrees))
        self.assertFalse(np.array_equal(swept(active, active.poses[-1]), swept(active, pose)))
        with self.assertRaisesRegex(gracilis.InputError, "of another scene"):
            gracilis.sweep(small_demo(), [pose])

    def test_settings_are_an_axis(self):
        swept = gracilis.sweep(gracilis.Scene(**bar(contact={"muscle": "none"})), self.poses[:1], fibers=False,
                               settings=[dict(iterations=1), dict(iterations=30)], processes=2)  # fmt: skip
        self.assertEqual(swept.volumes.shape, (2, 1, 1))
        self.assertFalse(np.array_equal(*swept.vertices["muscle"]))
        self.assertTrue(np.isnan(swept.fiber_lengths).all())

    def test_an_error_in_a_process_arrives(self):
        with self.assertRaisesRegex(gracilis.ConfigurationError, "did you mean 'bend'") as raised:
            gracilis.sweep(gracilis.Scene(**bar()), [{"bent": 1}], method="skinning", processes=1)
        self.assertEqual(raised.exception.exit_code, 2)
        for poses, step_deg in (([], 2), (self.poses, 0)):
            with self.assertRaises(ValueError):
                gracilis.sweep(gracilis.Scene(**bar()), poses, step_deg=step_deg)


if __name__ == "__main__":
    unittest.main()
