import os
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

from scenes import sources


class Wheel(unittest.TestCase):
    def test_it_is_built_without_network_and_serves_alone(self):
        build = os.environ["GRACILIS_BUILD_DIR"]
        with tempfile.TemporaryDirectory() as folder:
            nowhere = dict(os.environ, http_proxy="http://127.0.0.1:1", https_proxy="http://127.0.0.1:1", PYTHONPATH="")
            subprocess.run(
                [sys.executable, "-m", "pip", "wheel", ".", "--no-index", "--wheel-dir", folder,
                 "--config-settings", f"build-dir={build}"],
                cwd=sources, env=nowhere, check=True, capture_output=True)  # fmt: skip
            (wheel,) = Path(folder).glob("gracilis-*.whl")
            with zipfile.ZipFile(wheel) as archive:
                self.assertIsNone(archive.testzip())
                archive.extractall(Path(folder) / "installed")
            self.assertEqual([file.name for file in Path(folder).glob("*.whl")], [wheel.name])
            done = subprocess.run(
                [sys.executable, "-c", "import gracilis; print(gracilis.__file__, gracilis.__version__)"],
                cwd=folder, env=dict(nowhere, PYTHONPATH=str(Path(folder) / "installed")), check=True,
                capture_output=True, text=True)  # fmt: skip
            where, version = done.stdout.split()
            self.assertTrue(where.startswith(folder))
            self.assertIn(version, wheel.name)


if __name__ == "__main__":
    unittest.main()
