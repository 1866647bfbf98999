import subprocess
import sys
import unittest


def said(begin):
    """What a Python says that imports gracilis after these statements."""
    done = subprocess.run([sys.executable, "-c", begin + "; import gracilis"], capture_output=True, text=True)
    return done.stderr.strip().splitlines()[-1]


class WithoutNumPy(unittest.TestCase):
    def test_it_says_what_to_install(self):
        missing = said("import sys; sys.modules['numpy'] = None")
        self.assertRegex(missing, "^ImportError: gracilis needs NumPy 1, and there is none.*python3-numpy")

    def test_it_refuses_numpy_2(self):
        later = said("import sys, types; sys.modules['numpy'] = types.ModuleType('numpy')\n"
                     "sys.modules['numpy'].__version__ = '2.1.0'; None")  # fmt: skip
        self.assertRegex(later, "^ImportError: gracilis is built for NumPy 1, and this Python has 2.1.0.*python3-numpy")


if __name__ == "__main__":
    unittest.main()
