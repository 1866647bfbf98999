"""The Blender add-on's own reader of surfaces, which needs no Blender."""

import importlib.util
import unittest

import numpy as np
from scenes import demo_run, sources

import gracilis

spec = importlib.util.spec_from_file_location("vtp", sources / "packaging/blender/gracilis_run/vtp.py")
vtp = importlib.util.module_from_spec(spec)
spec.loader.exec_module(vtp)


class BlenderReader(unittest.TestCase):
    def test_surfaces_have_the_bits_of_the_run(self):
        run = gracilis.Run(demo_run())
        for name, arrays in (("iliacus_r", 1), ("femur_r", 0)):
            vertices, faces = run.surface(name, 5)
            points, triangles, _ = vtp.read_surface(demo_run() / "frames" / f"{name}_0005.vtp")
            np.testing.assert_array_equal(points, vertices)
            np.testing.assert_array_equal(triangles, faces)
            # Muscles are known by what frame 0 tells of their vertices.
            self.assertEqual(len(vtp.read_surface(demo_run() / "frames" / f"{name}_0000.vtp")[2]), arrays)

    def test_copies_may_run_into_what_they_write(self):
        self.assertEqual(vtp.unpack_lz4(bytes([0x14, ord("a"), 1, 0, 0x10, ord("b")]), 10), b"aaaaaaaaab")

    def test_what_is_cut_off_is_refused(self):
        for packed in (bytes([0x14, ord("a"), 2, 0]), bytes([0x10, ord("a")])):
            with self.assertRaises(ValueError):
                vtp.unpack_lz4(packed, 9)


if __name__ == "__main__":
    unittest.main()
