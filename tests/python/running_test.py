import filecmp
import json
import os
import signal
import tempfile
import unittest
from pathlib import Path

from scenes import demo, demo_run, small_demo

import gracilis


def quick(out, **keywords):
    return gracilis.run(small_demo(), out, fibers=False, metrics="none", **keywords)


class Running(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name) / "run"

    def test_frames_have_the_bits_of_the_program(self):
        run = gracilis.run(demo(), self.folder, fibers=False, metrics="none")
        frames = sorted(file.name for file in (demo_run() / "frames").iterdir())
        self.assertEqual(len(run), 11)
        same, different, missing = filecmp.cmpfiles(demo_run() / "frames", run.folder / "frames", frames, shallow=False)
        self.assertEqual((different, missing), ([], []))
        self.assertEqual(len(same), len(frames))

    def test_progress_is_told_each_frame_and_options_arrive(self):
        told = []
        run = quick(self.folder, every=5, layout="compact", progress=lambda done, last: told.append((done, last)))
        self.assertEqual(told, [(0, 2), (1, 2), (2, 2)])
        self.assertEqual(len(run), 3)
        manifest = json.loads((self.folder / "run.json").read_text())
        self.assertEqual((manifest["status"], manifest["every"]), ("complete", 5))
        self.assertTrue((self.folder / "shapes").is_dir())

    def test_what_a_callback_raises_and_ctrl_c_end_the_run_which_can_go_on(self):
        def fail(done, last):
            if done == 3:
                raise ZeroDivisionError("enough")

        with self.assertRaisesRegex(ZeroDivisionError, "enough"):
            quick(self.folder, progress=fail)
        with self.assertRaisesRegex(gracilis.Error, "resume"):
            quick(self.folder)  # there is a run already
        with self.assertRaises(KeyboardInterrupt):
            quick(self.folder, resume=True, progress=lambda done, last: done == 6 and os.kill(os.getpid(), signal.SIGINT))
        seen = []
        run = quick(self.folder, resume=True, progress=lambda done, last: seen.append(done))
        self.assertEqual(len(run), 11)
        self.assertGreater(seen[0], 3)
        self.assertEqual(run.manifest["status"], "complete")
        again = gracilis.run(small_demo(), self.folder.parent / "whole", fibers=False, metrics="none")
        for name in ("iliacus_r_0010.vtp", "iliacus_r_0005.vtp"):
            self.assertEqual((run.folder / "frames" / name).read_bytes(), (again.folder / "frames" / name).read_bytes())

    def test_wrong_options_are_refused(self):
        for keywords in ({"metrics": "ful"}, {"layout": "x"}, {"every": 0}, {"resume": True, "force": True}):
            with self.subTest(keywords), self.assertRaises(gracilis.Error):
                gracilis.run(small_demo(), self.folder, **keywords)
        self.assertFalse(self.folder.exists())
