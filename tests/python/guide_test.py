"""What docs/guide/python.md tells people to write, run as it stands there.

A comment above a block, which no reader sees, puts words in the place of others, as in the other pages
(tests/view/guide_blocks.hpp): `<!-- walk: gracilis.demo() -> small_demo() -->`.
"""

import contextlib
import io
import os
import re
import shutil
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np
from scenes import box, demo_run, small_demo, sources

import gracilis

page = sources / "docs" / "guide" / "python.md"
model = sources / "tests" / "opensim" / "reference" / "arm26_right.osim"


def blocks(text):
    """Every block of Python of a page: its line, and what stands in it once its words are put in place."""
    for match in re.finditer(r"(?:<!-- walk: (.*?) -->\n\n)?```python\n(.*?)```", text, re.DOTALL):
        code = match[2]
        for mark in (match[1] or "").split("; "):
            from_words, arrow, to_words = mark.partition(" -> ")
            if arrow and from_words not in code:
                raise AssertionError(f"{from_words} is not in the block")
            code = code.replace(from_words, to_words) if arrow else code
        yield text.count("\n", 0, match.start(2)) + 1, code


def given():
    """Names that the page takes for granted: surfaces of a forearm, what holds its muscle, poses."""
    vertices, faces = box((-0.01, -0.01, 0.0), (0.01, 0.01, 0.1), 8)
    return dict(
        np=np,
        small_demo=small_demo,
        humerus=box((-0.02, -0.02, -0.02), (0.02, 0.02, -0.001)),
        ulna=box((-0.02, -0.02, 0.101), (0.02, 0.02, 0.12)),
        brachialis=(vertices, faces),
        held_by_the_humerus=np.flatnonzero(vertices[:, 2] < 0.001),
        held_by_the_ulna=np.flatnonzero(vertices[:, 2] > 0.099),
        vertices=vertices,
        faces=faces,
        poses=[{"hip_flexion_r": 2.0}],
    )


class Guide(unittest.TestCase):
    def test_every_block_of_the_page_runs(self):
        names, walked = given(), 0
        with contextlib.ExitStack() as stack:
            folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
            stack.callback(os.chdir, os.getcwd())
            os.chdir(folder)
            shutil.copytree(demo_run(), "runs/other")
            shutil.copy(model, "arm26.osim")
            gracilis.write_sto("motion.mot", {"time": np.linspace(0, 0.5, 6), "r_elbow_flex": np.linspace(0, 0.2, 6),
                                              "r_shoulder_elev": np.zeros(6)})  # fmt: skip
            stack.enter_context(warnings.catch_warnings())
            warnings.simplefilter("ignore", gracilis.SceneWarning)
            for line, code in blocks(page.read_text()):
                with contextlib.redirect_stdout(io.StringIO()):
                    exec(compile("\n" * (line - 1) + code, str(page), "exec"), names)
                walked += 1
        self.assertEqual(walked, page.read_text().count("```python"))

    def test_a_block_is_found_with_its_words_put_in_place(self):
        found = list(blocks("text\n\n<!-- walk: a -> b; 1 -> 22 -->\n\n```python\na = 1\n```\n\n```python\nc\n```\n"))
        self.assertEqual(found, [(6, "b = 22\n"), (10, "c\n")])

    def test_words_that_are_not_there_are_told(self):
        with self.assertRaisesRegex(AssertionError, "x is not in the block"):
            list(blocks("<!-- walk: x -> y -->\n\n```python\na = 1\n```\n"))


if __name__ == "__main__":
    unittest.main()
