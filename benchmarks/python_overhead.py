"""What Simulation.advance costs in Python beyond the solver, which tells its own time: both by one clock in one run; and
what the first look at a muscle's vertices costs after a frame, beyond that at any property. (A frame of the solver empties
the caches: there the clock alone takes microseconds, and so does whatever Python does first.)

    PYTHONPATH=build/release/python python3 benchmarks/python_overhead.py
"""

import statistics
import time

import gracilis

FRAMES = 180


def overhead(simulation):
    """Seconds per frame beyond the solver's, the solver's, and those of a first look beyond any property's."""
    muscle = simulation.muscles["iliacus_r"]
    beyond, solver, looks, others = [], [], [], []
    for frame in range(FRAMES):
        began = time.perf_counter()
        simulation.advance({"hip_flexion_r": 2.0 * (frame % 45)})
        whole = time.perf_counter() - began
        solver.append(simulation.solver_seconds)
        beyond.append(whole - simulation.solver_seconds)
        began = time.perf_counter()
        if frame % 2:
            muscle.vertices
            looks.append(time.perf_counter() - began)
        else:
            simulation.frame
            others.append(time.perf_counter() - began)
    return beyond, solver, statistics.median(looks) - statistics.median(others)


print("| scene | solver, ms | Python adds, µs | share of all frames | a view adds, µs |")
print("| --- | --- | --- | --- | --- |")
for name, simulation in (
    ("demo, six muscles by xpbd", gracilis.Simulation(gracilis.demo())),
    ("one muscle by skinning", gracilis.Simulation(gracilis.demo(only=["iliacus_r"]), method="skinning")),
):
    beyond, solver, first_look = overhead(simulation)
    print(f"| {name} | {1e3 * statistics.median(solver):.3f} | {1e6 * statistics.median(beyond):.1f} "
          f"| {100 * sum(beyond) / sum(solver):.2f} % | {1e6 * first_look:.2f} |")
