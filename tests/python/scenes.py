"""Scenes that tests share; each is made once."""

import atexit
import functools
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

import gracilis

program = os.environ["GRACILIS_PROGRAM"]
sources = Path(__file__).resolve().parent.parent.parent


@functools.cache
def demo():
    """The built-in hip, flexed by 10 degrees; contact and strings as users have them."""
    return gracilis.demo(flexion=10)


@functools.cache
def small_demo():
    """One muscle of it, by few iterations."""
    return gracilis.demo(flexion=10, only=["iliacus_r"], iterations=5)


@functools.cache
def demo_run():
    """Folder of the program's run of the same as demo()."""
    outer = tempfile.mkdtemp(prefix="gracilis_python_")
    atexit.register(shutil.rmtree, outer)
    folder = Path(outer) / "run"
    subprocess.run([program, "demo", "--flexion", "10", "--no-fibers", "--metrics", "none", "--out", str(folder)],
                   check=True, capture_output=True)  # fmt: skip
    return folder


def box(low, high, cells=4):
    """A closed box of triangles, outwards: float64 (n, 3), int32 (m, 3)."""
    low, high = np.asarray(low, float), np.asarray(high, float)
    numbers, faces = {}, []

    def vertex(point):
        return numbers.setdefault(tuple(point), len(numbers))

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, cells):
            for i in range(cells):
                for j in range(cells):
                    corners = []
                    for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        point = [0, 0, 0]
                        point[axis], point[u], point[v] = side, i + di, j + dj
                        corners.append(vertex(point))
                    if side == 0:
                        corners.reverse()
                    faces += [corners[:3], [corners[0], corners[2], corners[3]]]
    grid = np.array(list(numbers)) / cells
    return low + grid * (high - low), np.array(faces, np.int32)


def bar(**changes):
    """Keywords of a scene: a bar of muscle between two blocks of bone that turn against each other."""
    vertices, faces = box((-0.01, -0.01, 0.0), (0.01, 0.01, 0.1), 8)
    keywords = dict(
        name="bar",
        bones=[
            dict(name="lower", surface=box((-0.02, -0.02, -0.02), (0.02, 0.02, -0.001))),
            dict(name="upper", surface=box((-0.02, -0.02, 0.101), (0.02, 0.02, 0.12))),
        ],
        joints=[
            dict(name="hinge", parent="lower", child="upper", center=[0, 0, 0.05],
                 axes=[dict(coordinate="bend", axis=[1, 0, 0], range_deg=[-60, 60])]),
        ],
        muscles=[
            dict(name="muscle", surface=(vertices, faces), attachments=[
                dict(name="low", end="origin", body="lower", vertices=np.flatnonzero(vertices[:, 2] < 0.001)),
                dict(name="high", end="insertion", body="upper", vertices=np.flatnonzero(vertices[:, 2] > 0.099)),
            ]),
        ],
    )  # fmt: skip
    keywords.update(changes)
    return keywords
