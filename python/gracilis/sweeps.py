"""Many poses or settings at once, over processes."""

import concurrent.futures
import math
import multiprocessing
import numbers
import os
from typing import NamedTuple

import numpy as np

from ._core import Pose, Simulation, limit_threads
from .errors import InputError


class Sweep(NamedTuple):
    """Muscles in many poses, each reached from the capture pose. With a list of settings, all arrays begin with its axis."""

    muscles: list  #: names, in the order of the axis m
    vertices: dict  #: muscle -> (p, n, 3) float64, m
    volumes: np.ndarray  #: (p, m) float64, m³
    fiber_lengths: np.ndarray  #: (p, m) float64, mean, m; nan where fibers were not asked for


def sweep(scene, poses, *, settings=None, method="", step_deg=2, settle=0, fibers=True, processes=None, progress=None):
    """Moves a scene to many poses, in as many processes as the machine has processors, and returns a Sweep.

    poses: list of dicts, degrees (mm for translations) by coordinates' names, or of poses of Scene.poses, which bring how
    active muscles are, too. Each is reached from the capture pose in equal steps, of step_deg degrees (mm) at most (None:
    in one); `settle` more frames follow there. Results do not depend on the order or on the processes.
    settings: a dict, or a list of dicts to try each of. method: as of Simulation. fibers: follow them, too, which takes
    seconds more in each process. progress: called as progress(done, all) as poses are reached, of all settings
    together. Processes make the scene again, from its files or arrays.

    A script that calls this needs the usual ``if __name__ == "__main__":``. An error in any pose is raised.
    """
    if step_deg is not None and not step_deg > 0:
        raise ValueError("step_deg must be above 0, or None")
    goals = [_goal(scene, pose) for pose in poses]
    tried = [dict(each) for each in settings] if isinstance(settings, (list, tuple)) else [dict(settings or {})]
    processes = processes or os.cpu_count() or 1
    parts = [part for part in np.array_split(np.arange(len(goals)), -(-processes // len(tried)) if tried else 1) if len(part)]
    if not parts or not tried:
        raise ValueError("a sweep needs at least one pose and one dict of settings")
    tasks = [(method, each, [goals[i] for i in part], step_deg, settle, fibers) for each in tried for part in parts]
    done = _done(scene, tasks, min(processes, len(tasks)), progress or (lambda reached, total: None))
    rows = [sum(done[first : first + len(parts)], []) for first in range(0, len(done), len(parts))]
    if not isinstance(settings, (list, tuple)):
        rows = rows[0]
    return _stacked(list(scene.muscles), rows)


def _goal(scene, pose):
    """Of a pose: degrees (mm) by coordinates' names, and how active muscles are."""
    if not isinstance(pose, Pose):
        return dict(pose), {}
    if list(pose.degrees) != scene.coordinates or len(pose.activations) != len(scene.muscles):
        raise InputError("pose: is of another scene: take one of this scene's poses", 3)
    return pose.degrees, dict(zip(scene.muscles, pose.activations.tolist()))


def _done(scene, tasks, processes, progress):
    """What processes make of the tasks, in their order."""
    context = multiprocessing.get_context("spawn")
    ticks, threads = context.SimpleQueue(), max(1, (os.cpu_count() or 1) // processes)
    with concurrent.futures.ProcessPoolExecutor(processes, context, _begin, (scene, threads, ticks)) as pool:
        futures = [pool.submit(_go, task) for task in tasks]
        reached, pending = 0, futures
        while pending:
            pending = concurrent.futures.wait(pending, timeout=0.1).not_done
            while not ticks.empty():
                ticks.get()
                reached += 1
                progress(reached, sum(len(goals) for _, _, goals, *_ in tasks))
        return [future.result() for future in futures]


_scene = _ticks = None  # of a process that this module started


def _begin(scene, threads, ticks):
    global _scene, _ticks
    _scene, _ticks = scene, ticks
    limit_threads(threads)


def _go(task):
    """What the muscles are in each of some poses: (vertices per muscle, volumes, lengths)."""
    method, settings, goals, step_deg, settle, fibers = task
    simulation = Simulation(_scene, method=method, **settings)
    rows = []
    for goal, activations in goals:
        simulation.reset()
        _walk(simulation, goal, activations, step_deg)
        for _ in range(settle):
            simulation.advance(goal)
        muscles = simulation.muscles.values()
        lengths = [muscle.mean_fiber_length if fibers else np.nan for muscle in muscles]
        rows.append(([np.array(muscle.vertices) for muscle in muscles], [muscle.volume for muscle in muscles], lengths))
        _ticks.put(None)
    return rows


def _walk(simulation, goal, activations, step_deg):
    """In equal steps from the capture pose to the goal, which is met exactly."""
    begin = simulation.degrees
    known = {name: value for name, value in goal.items()
             if name in begin and isinstance(value, numbers.Real) and math.isfinite(value)}  # fmt: skip
    farthest = max((abs(value - begin[name]) for name, value in known.items()), default=0)
    steps = max(1, math.ceil(farthest / step_deg - 1e-9)) if step_deg else 1
    for step in range(1, steps):
        share = step / steps
        simulation.activations.update({name: share * value for name, value in activations.items()})
        simulation.advance({name: begin[name] + share * (value - begin[name]) for name, value in known.items()})
    simulation.activations.update(activations)
    simulation.advance(goal)  # which also says what is wrong with a name or a number


def _stacked(names, rows):
    """Rows, or lists of as many rows, as arrays."""

    def of(pick):
        return np.array([[pick(row) for row in each] if isinstance(each, list) else pick(each) for each in rows])

    vertices = {name: of(lambda row, i=i: row[0][i]) for i, name in enumerate(names)}
    return Sweep(names, vertices, of(lambda row: row[1]), of(lambda row: row[2]))
