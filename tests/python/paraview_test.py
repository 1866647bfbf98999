import json
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

import gracilis

# What ParaView makes of a run's own script: each bone's bounds at each time.
BOUNDS = """
import json, sys
__file__ = sys.argv[1]
exec(compile(open(__file__).read(), __file__, "exec"))
told = []
for time in muscles.TimestepValues:
    told.append({})
    for bone in bones:
        moved = FindSource(bone)
        moved.UpdatePipeline(time)
        told[-1][bone] = moved.GetDataInformation().GetBounds()
print(json.dumps(told))
"""


class ParaView(unittest.TestCase):
    def test_bones_of_a_compact_run_move_with_its_muscles(self):
        if shutil.which("pvbatch") is None:
            self.skipTest("ParaView is not here")
        display = ["xvfb-run", "-a"] if shutil.which("xvfb-run") else []
        scene = gracilis.demo(flexion=3, only=["iliacus_r"], iterations=1)
        with tempfile.TemporaryDirectory() as folder:
            run = gracilis.run(scene, Path(folder) / "run", layout="compact")
            (Path(folder) / "bounds.py").write_text(BOUNDS)
            command = [*display, "pvbatch", str(Path(folder) / "bounds.py"), str(run.folder / "paraview.py")]
            told = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
            self.assertEqual(len(told), len(run))
            for frame, bounds in enumerate(told):
                for bone, bound in bounds.items():
                    vertices = run.surface(bone, frame)[0]
                    wanted = np.column_stack((vertices.min(axis=0), vertices.max(axis=0))).ravel()
                    np.testing.assert_allclose(bound, wanted, atol=1e-6, err_msg=f"{bone} in frame {frame}")


if __name__ == "__main__":
    unittest.main()
