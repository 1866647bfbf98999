"""Gracilis: bones, muscle surfaces and a motion become muscles that deform.

    scene = gracilis.demo()
    sim = gracilis.Simulation(scene)
    sim.advance({"hip_flexion_r": 30.0})
    sim.muscles["iliacus_r"].vertices      # (n, 3) float64, m

A scene is constant, a simulation is what changes. Lengths are metres; coordinates are degrees (mm for translations)
where they are written by hand, and radians (m) where a name says so.
"""

_cure = "install Debian's python3-numpy, or by pip 'numpy<2'"
try:
    from numpy import __version__ as _numpy
except ImportError as _error:
    raise ImportError(f"gracilis needs NumPy 1, and there is none for this Python: {_cure}") from _error
if int(_numpy.split(".")[0]) >= 2:
    raise ImportError(f"gracilis is built for NumPy 1, and this Python has {_numpy}: {_cure}")
del _cure, _numpy

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
    report,
    rom,
    run,
    static_optimization,
    write_sto,
)

for _each in (Activations, Bone, Checkpoint, Muscle, Pose, Run, Scene, Simulation, demo, import_model, limit_threads, load,
              moment_arms, paths, prepare, read_sto, report, rom, run, static_optimization, write_sto):  # fmt: skip
    _each.__module__ = "gracilis"
del _each

from .sweeps import Sweep, sweep
from .notebooks import run_as_html as _run_as_html

Run._repr_html_ = _run_as_html
