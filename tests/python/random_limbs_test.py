"""Limbs from seeds (tools/random_limbs) are sound, and muscles keep every gate on them."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from collections import Counter
from pathlib import Path

import numpy as np

TOOL = Path(__file__).resolve().parents[2] / "tools" / "random_limbs"
sys.path.insert(0, str(TOOL))
import limbs  # noqa: E402


def made(kind, seed, crowded=False):
    limb = limbs.Limb(np.random.default_rng([seed, 0]), crowded)
    limbs.KINDS[kind](limb)
    return limb


class RandomLimbs(unittest.TestCase):
    def test_surfaces_are_closed_and_their_triangles_agree_on_what_is_outside(self):
        for kind in ("spine", "gluteal", "ankle", "trunk"):  # of strands, of sheets, of both
            limb = made(kind, 1)
            shapes = [tube for _, _, tube in limb.bones] + [shape for _, shape, _, _ in limb.muscles]
            self.assertGreaterEqual(len(limb.muscles), 3, kind)
            for shape in shapes:
                vertices, faces = shape.mesh(0.006, limb.rng, bumps=0.02, jitter=0.5)
                sides = Counter((int(a), int(b)) for face in faces for a, b in zip(face, np.roll(face, -1)))
                self.assertEqual(set(sides.values()), {1}, kind)
                self.assertTrue(all((b, a) in sides for a, b in sides), kind)
                corners = vertices[faces]
                self.assertGreater(np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])), 0, kind)

    def test_a_seed_gives_the_same_limb_twice_and_another_one_another(self):
        lines = [np.concatenate([shape.line for _, shape, _, _ in made("forearm", seed).muscles]) for seed in (3, 3, 4)]
        np.testing.assert_array_equal(lines[0], lines[1])
        self.assertFalse(lines[0].shape == lines[2].shape and np.allclose(lines[0], lines[2]))

    def test_muscles_begin_and_end_on_their_bones_and_keep_out_of_them(self):
        limb = made("hinge", 2)
        bones = {body: tube for _, body, tube in limb.bones}
        for name, shape, origin, insertion in limb.muscles:
            for body, points, reach in (origin, insertion):
                self.assertLess(abs(bones[body].distance(points)[0]).max(), reach, name)
            for tube in bones.values():
                self.assertGreater(tube.distance(shape.line[5:-5])[0].min(), -0.002, name)

    def test_a_forearm_and_a_spine_keep_every_gate(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(
                [sys.executable, TOOL / "run.py", "--seeds", "0:1", "--kinds", "forearm,spine", "--out", folder,
                 "--program", os.environ["GRACILIS_PROGRAM"]], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertIn("2 of 2 limbs keep every gate", done.stdout)
            manifest = json.loads((Path(folder) / "forearm_0" / "run" / "run.json").read_text())
            self.assertEqual(manifest["status"], "complete")


if __name__ == "__main__":
    unittest.main()
