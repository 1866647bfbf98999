"""Gracilis: bones, muscle surfaces and a motion become muscles that deform.

    scene = gracilis.demo()
    sim = gracilis.Simulation(scene)
    sim.advance({"hip_flexion_r": 30.0})
    sim.muscles["iliacus_r"].vertices      # (n, 3) float64, m

A scene is constant, a simulation is what changes. Lengths are metres; coordinates are degrees (mm for translations)
where they are written by hand, and radians (m) where a name says so.
"""

from .errors import ConfigurationError, Error, InputError, QualityError, SceneWarning
from .arms import MomentArms
from .tables import Table
from ._core import (
    Activations,
    Bone,
    Checkpoint,
    Muscle,
    Pose,
    Run,
    Scene,
    Simulation,
    __version__,
    demo,
    import_model,
    limit_threads,
    load,
    moment_arms,
    paths,
    prepare,
    read_sto,
    rom,
    run,
    static_optimization,
    write_sto,
)

for _each in (Activations, Bone, Checkpoint, Muscle, Pose, Run, Scene, Simulation, demo, import_model, limit_threads, load,
              moment_arms, paths, prepare, read_sto, rom, run, static_optimization, write_sto):  # fmt: skip
    _each.__module__ = "gracilis"
del _each

from .sweeps import Sweep, sweep
from .notebooks import run_as_html as _run_as_html

Run._repr_html_ = _run_as_html
