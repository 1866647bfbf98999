import functools
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from scenes import sources

examples = sources / "python" / "examples"


@functools.cache
def output_of(name, *arguments):
    done = subprocess.run([sys.executable, "-W", "ignore", str(examples / name), *map(str, arguments)],
                          check=True, capture_output=True, text=True)  # fmt: skip
    return done.stdout


class Examples(unittest.TestCase):
    def test_moment_arms(self):
        said = output_of("moment_arms.py")
        rows = {line.split()[0]: [float(each) for each in line.split()[1:5]] for line in said.splitlines()}
        self.assertEqual(rows["degrees"], [0, 10, 20, 30])
        self.assertTrue(all(10 < arm < 80 for arm in rows["iliacus_r"]), said)  # mm: it flexes
        self.assertTrue(all(-120 < arm < -10 for arm in rows["gluteus_maximus_r"]), said)  # it extends

    def test_own_muscle(self):
        found = re.findall(r"(\d+) degrees: volume ([\d.]+), fibers ([\d.]+) mm", output_of("own_muscle.py"))
        self.assertEqual([int(angle) for angle, _, _ in found], [5, 10, 15, 20, 25, 30])
        for _, volume, _ in found:
            self.assertAlmostEqual(float(volume), 1, delta=0.01)
        lengths = [float(length) for _, _, length in found]
        self.assertEqual(lengths, sorted(lengths, reverse=lengths[0] > lengths[-1]))
        self.assertGreater(abs(lengths[-1] - lengths[0]), 5)

    def test_sensitivity(self):
        rows = [[float(each) for each in line.split()] for line in output_of("sensitivity.py").splitlines()[1:]]
        self.assertEqual([row[0] for row in rows], [0, 1e-6, 1e-5, 1e-4])
        at_the_end = [row[2] for row in rows]
        self.assertEqual(at_the_end, sorted(at_the_end, reverse=True))
        self.assertAlmostEqual(at_the_end[0], 1, delta=0.0002)
        self.assertLess(at_the_end[-1], at_the_end[0] - 0.001)
        self.assertGreater(at_the_end[-1], 0.95)

    def test_import(self):
        with tempfile.TemporaryDirectory() as folder:
            model = sources / "tests" / "opensim" / "reference" / "arm26_right.osim"
            said = output_of("import_osim.py", model, Path(folder) / "scene")
        self.assertIn("3 muscles", said)
        arms = [float(each) for each in re.search(r"BIClong +(.*) mm", said).group(1).split()]
        self.assertTrue(all(5 < arm < 60 for arm in arms), said)


if __name__ == "__main__":
    unittest.main()
