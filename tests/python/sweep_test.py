import unittest

import numpy as np
from scenes import bar

import gracilis


class Sweeps(unittest.TestCase):
    poses = [{"bend": 5.0}, {"bend": 10.0}, {"bend": -10.0}]

    def test_every_pose_is_what_a_simulation_makes_of_it(self):
        scene = gracilis.Scene(**bar())
        swept = gracilis.sweep(scene, self.poses, method="skinning", processes=2)
        self.assertEqual(swept.muscles, ["muscle"])
        self.assertEqual((swept.volumes.shape, swept.fiber_lengths.shape), ((3, 1), (3, 1)))
        sim = gracilis.Simulation(scene, method="skinning")
        for number, pose in enumerate(self.poses):
            sim.reset()
            sim.advance(pose)
            np.testing.assert_array_equal(swept.vertices["muscle"][number], sim.muscles["muscle"].vertices)
            self.assertEqual(swept.volumes[number, 0], sim.muscles["muscle"].volume)
            self.assertEqual(swept.fiber_lengths[number, 0], sim.muscles["muscle"].mean_fiber_length)

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
        with self.assertRaises(ValueError):
            gracilis.sweep(gracilis.Scene(**bar()), [])


if __name__ == "__main__":
    unittest.main()
