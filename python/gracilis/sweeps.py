"""Many poses or settings at once, over processes."""

import concurrent.futures
import multiprocessing
import os
from typing import NamedTuple

import numpy as np

from ._core import Simulation, limit_threads


class Sweep(NamedTuple):
    """Muscles in many poses, each reached from the capture pose. With a list of settings, all arrays begin with its axis."""

    muscles: list  #: names, in the order of the axis m
    vertices: dict  #: muscle -> (p, n, 3) float64, m
    volumes: np.ndarray  #: (p, m) float64, m³
    fiber_lengths: np.ndarray  #: (p, m) float64, mean, m; nan where fibers were not asked for


def sweep(scene, poses, *, settings=None, method="", settle=0, fibers=True, processes=None):
    """Moves a scene to many poses, in as many processes as the machine has processors, and returns a Sweep.

    poses: list of dicts, degrees (mm for translations) by coordinates' names. Each is reached from the capture pose in
    one frame, `settle` more of which follow there; results do not depend on the order or on the processes.
    settings: a dict, or a list of dicts to try each of. method: as of Simulation. fibers: follow them, too, which takes
    seconds more in each process. Processes make the scene again, from its files or arrays.

    A script that calls this needs the usual ``if __name__ == "__main__":``. An error in any pose is raised.
    """
    poses = [dict(pose) for pose in poses]
    tried = [dict(each) for each in settings] if isinstance(settings, (list, tuple)) else [dict(settings or {})]
    processes = processes or os.cpu_count() or 1
    parts = [part for part in np.array_split(np.arange(len(poses)), -(-processes // len(tried)) if tried else 1) if len(part)]
    if not parts or not tried:
        raise ValueError("a sweep needs at least one pose and one dict of settings")
    tasks = [(method, each, [poses[i] for i in part], settle, fibers) for each in tried for part in parts]
    processes = min(processes, len(tasks))
    threads = max(1, (os.cpu_count() or 1) // processes)
    with concurrent.futures.ProcessPoolExecutor(
        processes, multiprocessing.get_context("spawn"), _begin, (scene, threads)
    ) as pool:
        done = list(pool.map(_go, tasks))
    rows = [sum(done[first : first + len(parts)], []) for first in range(0, len(done), len(parts))]
    if not isinstance(settings, (list, tuple)):
        rows = rows[0]
    return _stacked(list(scene.muscles), rows)


_scene = None  # of a process that this module started


def _begin(scene, threads):
    global _scene
    _scene = scene
    limit_threads(threads)


def _go(task):
    """What the muscles are in each of some poses: (vertices per muscle, volumes, lengths)."""
    method, settings, poses, settle, fibers = task
    simulation = Simulation(_scene, method=method, **settings)
    rows = []
    for pose in poses:
        simulation.reset()
        for _ in range(1 + settle):
            simulation.advance(pose)
        muscles = simulation.muscles.values()
        lengths = [muscle.mean_fiber_length if fibers else np.nan for muscle in muscles]
        rows.append(([np.array(muscle.vertices) for muscle in muscles], [muscle.volume for muscle in muscles], lengths))
    return rows


def _stacked(names, rows):
    """Rows, or lists of as many rows, as arrays."""

    def of(pick):
        return np.array([[pick(row) for row in each] if isinstance(each, list) else pick(each) for each in rows])

    vertices = {name: of(lambda row, i=i: row[0][i]) for i, name in enumerate(names)}
    return Sweep(names, vertices, of(lambda row: row[1]), of(lambda row: row[2]))
