import gc
import os
import resource
import signal
import threading
import time
import unittest
import weakref

import numpy as np
from scenes import bar, demo, demo_run, small_demo

import gracilis


bending = dict(motion=dict(coordinates=["bend"], key_poses_deg=[[0], [5]]))


def memory():
    """Bytes that this process holds."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


class Moving(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.sim = gracilis.Simulation(small_demo())
        cls.muscle = cls.sim.muscles["iliacus_r"]

    def setUp(self):
        self.sim.reset()

    def test_frame_0_is_the_input(self):
        np.testing.assert_array_equal(self.muscle.vertices, small_demo().muscles["iliacus_r"][0])
        self.assertEqual((self.sim.frame, self.sim.time), (0, 0))

    def test_degrees_and_radians_mean_the_same(self):
        self.sim.advance({"hip_flexion_r": 5.0})
        by_degrees = self.sim.state_hash()
        self.assertAlmostEqual(self.sim.degrees["hip_flexion_r"], 5.0)
        self.sim.reset()
        self.sim.advance(radians={"hip_flexion_r": np.radians(5.0)})
        self.assertEqual(self.sim.state_hash(), by_degrees)
        self.assertEqual(self.sim.radians["hip_flexion_r"], np.radians(5.0))

    def test_coordinates_that_are_not_named_stay(self):
        self.sim.advance({"hip_flexion_r": 5.0})
        self.sim.advance({"hip_rotation_r": 2.0})
        self.assertAlmostEqual(self.sim.degrees["hip_flexion_r"], 5.0)
        self.assertAlmostEqual(self.sim.degrees["hip_rotation_r"], 2.0)
        self.assertEqual(self.sim.frame, 2)

    def test_attached_vertices_move_with_their_bones(self):
        self.sim.advance({"hip_flexion_r": 5.0})
        turned = self.sim.bones["femur_r"].transform
        moved = small_demo().bones["femur_r"][0] @ turned[:3, :3].T + turned[:3, 3]
        np.testing.assert_allclose(self.sim.bones["femur_r"].vertices, moved, atol=1e-15)
        rest = small_demo().muscles["iliacus_r"][0]
        held = rest @ turned[:3, :3].T + turned[:3, 3]
        gap = np.linalg.norm(self.muscle.vertices - held, axis=1)
        self.assertGreater((gap < 1e-6).sum(), 10)
        self.assertLess((gap < 1e-6).sum(), len(rest))

    def test_volume_is_that_of_the_surface(self):
        self.sim.advance({"hip_flexion_r": 5.0})
        a, b, c = (self.muscle.vertices[self.muscle.faces[:, k]] for k in range(3))
        volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
        self.assertAlmostEqual(self.muscle.volume * 1e6, volume * 1e6, places=6)
        self.assertAlmostEqual(self.muscle.volume / small_demo_volume(), 1, places=2)

    def test_fibers_run_in_the_muscle_and_have_their_lengths(self):
        self.sim.advance({"hip_flexion_r": 10.0})
        fibers, lengths = self.muscle.fibers, self.muscle.fiber_lengths
        self.assertGreater(len(fibers), 10)
        self.assertEqual(lengths.shape, (len(fibers),))
        sums = [np.linalg.norm(np.diff(fiber, axis=0), axis=1).sum() for fiber in fibers]
        np.testing.assert_allclose(lengths, sums, rtol=1e-12)
        self.assertAlmostEqual(self.muscle.mean_fiber_length, np.mean(lengths), places=12)
        low, high = self.muscle.vertices.min(axis=0), self.muscle.vertices.max(axis=0)
        for fiber in fibers:
            self.assertTrue(((fiber > low - 0.005) & (fiber < high + 0.005)).all())

    def test_depths_are_told_per_vertex(self):
        depth = self.muscle.contact_depth
        self.assertEqual((depth.dtype, depth.shape), (np.float32, (len(self.muscle.vertices),)))
        self.assertLess(depth.max(), 0.002)
        self.assertGreaterEqual(depth.min(), np.float32(-0.003))
        self.assertGreater(np.ptp(depth), 0)

    def test_activation_changes_the_shape(self):
        for _ in range(3):
            self.sim.advance()
        relaxed = self.sim.state_hash()
        self.sim.reset()
        self.sim.activations["iliacus_r"] = 0.4
        self.assertEqual(dict(self.sim.activations), {"iliacus_r": 0.4})
        for _ in range(3):
            self.sim.advance()
        self.assertNotEqual(self.sim.state_hash(), relaxed)
        self.sim.reset()
        self.assertEqual(self.sim.activations["iliacus_r"], 0)

    def test_poses_leave_muscles_as_active_as_was_asked_where_the_scene_drives_none(self):
        def hash_after(advance, activation):
            self.sim.reset()
            self.sim.activations["iliacus_r"] = activation
            for pose in small_demo().poses[1:4]:
                advance(pose)
            self.assertEqual(self.sim.activations["iliacus_r"], activation)
            return self.sim.state_hash()

        def by_radians(pose):
            self.sim.advance(radians=dict(zip(small_demo().coordinates, pose.coordinates)), time_step=pose.time_step)

        active = hash_after(self.sim.advance, 0.4)
        self.assertEqual(hash_after(by_radians, 0.4), active)
        self.assertNotEqual(hash_after(self.sim.advance, 0), active)

    def test_poses_bring_the_activations_of_muscles_that_the_scene_drives(self):
        scene = gracilis.Scene(**bar(**bending, activations=[dict(muscle="muscle", value=0.3)]))
        sim = gracilis.Simulation(scene, method="skinning")
        sim.activations["muscle"] = 0.8
        sim.advance(scene.poses[1])
        self.assertEqual(sim.activations["muscle"], 0.3)

    def test_a_time_step_beside_a_pose_takes_the_place_of_its_own(self):
        self.sim.advance(small_demo().poses[1], time_step=0.25)
        self.assertEqual(self.sim.time, 0.25)
        self.assertAlmostEqual(self.sim.degrees["hip_flexion_r"], 1)

    def test_a_pose_of_another_scene_is_refused(self):
        higher = bar(**bending)
        higher["joints"][0]["center"] = [0, 0, 0.06]
        sim = gracilis.Simulation(gracilis.Scene(**bar(**bending)), method="skinning")
        sim.advance(gracilis.Scene(**bar(**bending)).poses[1])  # the same, made again
        for pose in (gracilis.Scene(**higher).poses[1], small_demo().poses[1]):
            with self.assertRaisesRegex(gracilis.InputError, "of another scene"):
                sim.advance(pose)
        with self.assertRaisesRegex(gracilis.InputError, "of another scene"):
            self.sim.advance(demo().poses[1])  # the same joints, other muscles

    def test_wrong_requests_have_messages_and_change_nothing(self):
        pose = small_demo().poses[1]
        for request, kind, message in (
            (lambda: self.sim.advance({"hip_flexion": 3}), gracilis.ConfigurationError, "did you mean 'hip_flexion_r'"),
            (lambda: self.sim.advance({"hip_flexion_r": "far"}), gracilis.InputError, "must be a number"),
            (lambda: self.sim.advance({"hip_flexion_r": np.nan}), gracilis.InputError, "must be finite"),
            (lambda: self.sim.advance([1, 2, 3]), gracilis.InputError, "must be a dict"),
            (lambda: self.sim.advance(time_step=0), gracilis.InputError, "above 0 s"),
            (lambda: self.sim.advance(gracilis.Scene(**bar()).poses[0]), gracilis.InputError, "of another scene"),
            (lambda: self.sim.advance(pose, radians={"hip_flexion_r": 1}), gracilis.InputError, "radians: has no place"),
            (lambda: self.sim.advance(pose, time_step=-1), gracilis.InputError, "above 0 s"),
            (lambda: self.sim.activations["iliacus"], gracilis.ConfigurationError, "did you mean 'iliacus_r'"),
            (lambda: self.sim.activations.update({"iliacus_r": 1.5}), gracilis.InputError, "from 0 to 1"),
            (lambda: gracilis.Simulation(small_demo(), method="xpdb"), gracilis.ConfigurationError, "did you mean 'xpbd'"),
            (lambda: gracilis.Simulation(small_demo(), iterations=0.5), gracilis.ConfigurationError, "an integer"),
        ):
            with self.subTest(message), self.assertRaisesRegex(kind, message):
                request()
        self.assertEqual(self.sim.frame, 0)
        self.assertEqual(self.sim.degrees["hip_flexion_r"], 0)

    def test_every_method_moves_the_scene(self):
        for method in ("skinning", "cylinder", "arap"):
            with self.subTest(method):
                sim = gracilis.Simulation(small_demo(), method=method)
                self.assertEqual(sim.method, method)
                before = sim.state_hash()
                sim.advance({"hip_flexion_r": 5.0})
                self.assertNotEqual(sim.state_hash(), before)


def small_demo_volume():
    vertices, faces = small_demo().muscles["iliacus_r"]
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


class Views(unittest.TestCase):
    def test_they_are_read_only_and_without_a_copy(self):
        muscle = gracilis.Simulation(small_demo()).muscles["iliacus_r"]
        self.assertEqual(muscle.vertices.ctypes.data, muscle.vertices.ctypes.data)
        for array in (muscle.vertices, muscle.faces, muscle.fiber_lengths, muscle.fibers[0], muscle.contact_depth):
            self.assertFalse(array.flags.owndata)
            with self.assertRaises(ValueError):
                array[0] = 0
            with self.assertRaises(ValueError):
                array.flags.writeable = True

    def test_one_that_is_held_shows_its_frame_for_ever(self):
        sim = gracilis.Simulation(small_demo())
        muscle = sim.muscles["iliacus_r"]
        sim.advance({"hip_flexion_r": 3.0})
        view = muscle.vertices
        copy = view.copy()
        sim.advance({"hip_flexion_r": 6.0})
        self.assertFalse(np.array_equal(muscle.vertices, copy))
        np.testing.assert_array_equal(view, copy)
        del sim, muscle
        gc.collect()
        np.testing.assert_array_equal(view, copy)

    def test_a_muscle_keeps_its_simulation(self):
        muscle = gracilis.Simulation(small_demo()).muscles["iliacus_r"]
        gc.collect()
        self.assertEqual(muscle.vertices.shape[1], 3)


class Checkpoints(unittest.TestCase):
    def test_what_follows_has_the_same_bits(self):
        sim = gracilis.Simulation(demo(), iterations=3)
        angles = np.linspace(1, 12, 12)
        for angle in angles:  # contact is looked for anew every few frames: checkpoints in between, too
            sim.advance({"hip_flexion_r": angle})
            if angle == angles[5]:
                checkpoint, there = sim.checkpoint(), sim.state_hash()
        end = sim.state_hash()
        for _ in range(2):
            sim.restore(checkpoint)
            self.assertEqual((sim.frame, sim.state_hash()), (6, there))
            for angle in angles[6:]:
                sim.advance({"hip_flexion_r": angle})
            self.assertEqual(sim.state_hash(), end)

    def test_they_are_of_one_simulation(self):
        sim, other = (gracilis.Simulation(small_demo(), method="skinning") for _ in range(2))
        with self.assertRaisesRegex(gracilis.InputError, "of another simulation"):
            other.restore(sim.checkpoint())


class BesideTheProgram(unittest.TestCase):
    def test_frames_have_the_same_bits(self):
        sim = gracilis.Simulation(demo())
        poses, run = demo().poses, gracilis.Run(demo_run())
        self.assertEqual(len(run), len(poses))
        for number, pose in enumerate(poses):
            if number > 0:
                sim.advance(pose)
            for name, muscle in sim.muscles.items():
                recorded, _ = run.surface(name, number)
                np.testing.assert_array_equal(muscle.vertices, recorded, f"{name} in frame {number}")


class Threads(unittest.TestCase):
    def test_two_simulations_in_two_threads_do_as_one(self):
        alone = gracilis.Simulation(small_demo())
        for angle in range(1, 6):
            alone.advance({"hip_flexion_r": angle})
        hashes = []

        def run():
            sim = gracilis.Simulation(small_demo())
            for angle in range(1, 6):
                sim.advance({"hip_flexion_r": angle})
            hashes.append(sim.state_hash())

        threads = [threading.Thread(target=run) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(hashes, [alone.state_hash()] * 2)

    def test_python_goes_on_while_a_frame_is_made(self):
        sim = gracilis.Simulation(small_demo(), iterations=300)
        ticks, done = [], threading.Event()

        def count():
            while not done.is_set():
                ticks.append(time.monotonic())
                time.sleep(0.001)

        counting = threading.Thread(target=count)
        counting.start()
        began = time.monotonic()
        sim.advance({"hip_flexion_r": 10.0})
        ended = time.monotonic()
        done.set()
        counting.join()
        during = [tick for tick in ticks if began < tick < ended]
        self.assertGreater(ended - began, 0.02)
        self.assertGreater(len(during), 3)

    def test_ctrl_c_ends_the_frame_and_the_simulation_goes_on_from_a_checkpoint(self):
        sim = gracilis.Simulation(small_demo(), iterations=10000)
        checkpoint, before = sim.checkpoint(), sim.state_hash()
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        began = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            sim.advance({"hip_flexion_r": 90.0})
        self.assertLess(time.monotonic() - began, 5)
        timer.join()
        self.assertEqual((sim.frame, sim.state_hash()), (0, before))
        with self.assertRaisesRegex(gracilis.Error, r"stopped within a frame: reset\(\) or restore\(\)"):
            sim.advance()
        sim.restore(checkpoint)
        self.assertEqual(sim.state_hash(), before)
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)


class Memory(unittest.TestCase):
    def test_a_thousand_frames_leave_nothing_behind(self):
        sim = gracilis.Simulation(small_demo(), method="skinning")
        muscle = sim.muscles["iliacus_r"]

        def play(frames):
            for number in range(frames):
                sim.advance({"hip_flexion_r": 10 * np.sin(number / 10)})
                muscle.vertices.sum()
            gc.collect()

        play(200)
        before = memory()
        play(1000)
        frame = muscle.vertices.nbytes
        self.assertLess(memory() - before, 30 * frame)  # of 1,000; steps themselves are kept, some hundred bytes each

    def test_a_simulation_that_nobody_holds_is_gone(self):
        sim = gracilis.Simulation(small_demo(), method="skinning")
        array = sim.muscles["iliacus_r"].vertices
        gone = weakref.ref(array)
        del array, sim
        gc.collect()
        self.assertIsNone(gone())


if __name__ == "__main__":
    unittest.main()
