"""What Simulation.advance costs in Python beyond the solver, which tells its own time: both by one clock in one run.

    PYTHONPATH=build/release/python python3 benchmarks/python_overhead.py
"""

import statistics
import time

import gracilis

FRAMES = 180


def overhead(simulation):
    """Seconds per frame beyond the solver's, and the solver's."""
    beyond, solver = [], []
    for frame in range(FRAMES):
        began = time.perf_counter()
        simulation.advance({"hip_flexion_r": 2.0 * (frame % 45)})
        whole = time.perf_counter() - began
        solver.append(simulation.solver_seconds)
        beyond.append(whole - simulation.solver_seconds)
    return beyond, solver


print("| scene | solver, ms | Python adds, µs | share of all frames |")
print("| --- | --- | --- | --- |")
for name, simulation in (
    ("demo, six muscles by xpbd", gracilis.Simulation(gracilis.demo())),
    ("one muscle by skinning", gracilis.Simulation(gracilis.demo(only=["iliacus_r"]), method="skinning")),
):
    beyond, solver = overhead(simulation)
    print(f"| {name} | {1e3 * statistics.median(solver):.3f} | {1e6 * statistics.median(beyond):.1f} "
          f"| {100 * sum(beyond) / sum(solver):.2f} % |")
