#!/usr/bin/python3
"""The load cases of `gracilis_tissue_study --export FOLDER` solved by GetFEM: the same energy on the same tetrahedra.

    peer.py FOLDER [--quadratic]

For every case: how far its displacements and forces are from ours, and the time of both. Of the law GetFEM gets the
energy alone and differentiates it itself; volume is held per cell by a pressure that is constant there, whose
elimination gives K/2 (mean J - 1)². Newton's method with MUMPS, the load in as few steps as it takes; the time is that
of these steps, without reading and preparing. --quadratic: also by quadratic tetrahedra, which tells what linear ones
lack; minutes.
"""
import pathlib
import sys
import time

import getfem
import numpy

largest_residual = 1e-9  # N
most_steps = 4
most_seconds = 120  # no further attempt after these
getfem.util_trace_level(0)
getfem.util_warning_level(0)


def read_case(file):
    """A word and a count, then so many lines of numbers."""
    case, lines = {}, iter(file.read_text().splitlines())
    for head in lines:
        word, count = head.split()
        case[word] = numpy.array([[float(number) for number in next(lines).split()] for _ in range(int(count))])
    return case


def check_range(case):
    """The barrier and the ends of the force-length curve are left out of energy_of: no tetrahedron may come there."""
    corners = case["tetrahedra"][:, 1:].astype(int)
    places = (case["nodes"] + case["moved"])[corners]
    rests = case["nodes"][corners]
    edges, rest_edges = ((x[:, 1:] - x[:, :1]).transpose(0, 2, 1) for x in (places, rests))
    gradients = edges @ numpy.linalg.inv(rest_edges)
    if numpy.linalg.det(gradients).min() < 0.3:
        raise RuntimeError("a tetrahedron is where the barrier begins")
    active, optimal = case["law"][0, 5:7]
    direction = case["law"][0, 7:10]
    if not numpy.any(direction):
        return
    stretches = numpy.linalg.norm(gradients @ direction, axis=1)
    if active > 0 and not (0.6 < stretches.min() / optimal and stretches.max() / optimal < 1.4):
        raise RuntimeError("fibers are beyond the middle of the force-length curve")


def mesh_of(nodes, tetrahedra):
    mesh = getfem.Mesh("empty", 3)
    corners = nodes[tetrahedra]  # cells, corners, axes
    mesh.add_convex(getfem.GeoTrans("GT_PK(3,1)"), corners.transpose(2, 1, 0))
    return mesh


def first_degrees(field, nodes):
    """Where each node's first degree of freedom stands in the displacement."""
    at = {tuple(numpy.round(point, 9)): 3 * i for i, point in enumerate(field.basic_dof_nodes().T[::3])}
    return [at[tuple(numpy.round(node, 9))] for node in nodes]


def constant_per_cell(mesh, cells):
    """One value per cell, the same in all its tetrahedra."""
    field = getfem.MeshFem(mesh, 1)
    field.set_fem(getfem.Fem("FEM_PK(3,0)"))
    sizes = numpy.bincount(cells)
    count = len(sizes)
    spread, gather = getfem.Spmat("empty", len(cells), count), getfem.Spmat("empty", count, len(cells))
    for convex, cell in enumerate(cells):
        row = int(field.basic_dof_from_cvid(convex)[0][0])
        spread.add(row, int(cell), 1.0)
        gather.add(int(cell), row, 1.0 / float(sizes[cell]))
    field.reduction_matrices(gather, spread)
    return field


def energy_of(model, law):
    """The potential per volume. The matrix stiffens where |F|² is above 3, as it is everywhere but for what volume shrinks by: next
    to nothing, to the third power. Fibers keep a fifth of their tension where they are slack."""
    names = ["shear", "lame", "bulk", "tension", "stiffness", "active", "optimal"]
    for name, value in zip(names, law[:7]):
        model.add_initialized_data(name, value)
    model.add_initialized_data("stiffening", law[10])
    terms = ["shear/2*(Norm_sqr(F)-3)", "shear*stiffening/6*pow(Norm_sqr(F)-3,3)", "-shear*(Det(F)-1)", "lame/2*sqr(Det(F)-1)"]
    if law[2] > 0:
        terms.append("p*(Det(F)-1)-sqr(p)/(2*bulk)")
    definitions = "Def F:=Id(3)+Grad_u; "
    if numpy.any(law[7:10]):
        model.add_initialized_data("a", law[7:10])
        definitions += "Def L:=Norm((Id(3)+Grad_u)*a); "
        terms.append("tension*(L-1)+stiffness/2*sqr(L-1)")
        if law[4] > 0:
            terms.append("(-stiffness/2*sqr(neg_part(L-1+0.8*tension/stiffness)))")
        if law[5] > 0:
            terms.append("active*(L-4*optimal/3*pow(L/optimal-1,3))")
    return definitions + "(" + "+".join(terms) + ")"


def fixed_degrees(case, field):
    """Of every degree of freedom on a side that is held: how far it is moved, the side and the axis. A side is level and
    moved as a whole."""
    heights, fixed = field.basic_dof_nodes()[2], {}
    for side in numpy.unique(case["fixed"][:, 0]):
        rows = case["fixed"][case["fixed"][:, 0] == side]
        height = case["nodes"][int(rows[0, 1]), 2]
        moved = {int(axis): value for _, _, axis, value in rows}
        for degree in numpy.flatnonzero(abs(heights - height) < 1e-9):
            fixed[int(degree)] = (moved[degree % 3], int(side), int(degree % 3))
    return fixed


def load_up(model, brick, values, steps):
    """Newton's iterations in all; none where one of the steps does not converge."""
    sum_of_steps = 0
    for step in range(1, steps + 1):
        model.set_private_rhs(brick, values * step / steps)
        count, converged = model.solve("max_iter", 20, "max_res", largest_residual, "lsolver", "mumps")
        if not converged or not numpy.all(numpy.isfinite(model.variable("u"))):
            return 0
        sum_of_steps += count
    return sum_of_steps


def solve(case, order):
    """Displacements of the nodes, forces on the sides, seconds, iterations and steps by tetrahedra of this order."""
    nodes = case["nodes"]
    tetrahedra = case["tetrahedra"].astype(int)
    law = case["law"][0]
    mesh = mesh_of(nodes, tetrahedra[:, 1:])
    displacement = getfem.MeshFem(mesh, 3)
    displacement.set_fem(getfem.Fem(f"FEM_PK(3,{order})"))
    integration = getfem.MeshIm(mesh, getfem.Integ("IM_TETRAHEDRON(1)" if order == 1 else "IM_TETRAHEDRON(5)"))
    model = getfem.Model("real")
    model.add_fem_variable("u", displacement)
    if law[2] > 0:
        model.add_fem_variable("p", constant_per_cell(mesh, tetrahedra[:, 0]))
    model.add_nonlinear_term(integration, energy_of(model, law), -1, True, False)
    if "bone" in case:
        below = mesh.outer_faces_with_direction([0.0, 0.0, -1.0], 0.01)
        mesh.set_region(1, below)
        model.add_initialized_data("contact", case["bone"][0, 0])
        on_faces = getfem.MeshIm(mesh, getfem.Integ("IM_TETRAHEDRON(5)"))
        model.add_nonlinear_term(on_faces, "contact/2*sqr(neg_part(X(3)+u(3)))", 1, True, False)
    fixed = fixed_degrees(case, displacement)
    chosen = getfem.Spmat("empty", len(fixed), displacement.nbdof())
    for row, dof in enumerate(fixed):
        chosen.add(row, dof, 1.0)
    values = numpy.array([value for value, _, _ in fixed.values()])
    model.add_variable("held", len(fixed))
    brick = model.add_constraint_with_multipliers("u", "held", chosen, 0 * values)
    start = model.from_variables()
    iterations, steps, first = 0, 1, time.perf_counter()
    while not iterations:
        if steps > most_steps or time.perf_counter() - first > most_seconds:
            raise RuntimeError(f"not solved in {time.perf_counter() - first:.0f} s")
        model.to_variables(start)
        begin = time.perf_counter()
        iterations = load_up(model, brick, values, steps)
        seconds = time.perf_counter() - begin
        steps *= 2
    moved = model.variable("u")
    forces = numpy.zeros((len(case["forces"]), 3))
    for force, (_, side, axis) in zip(model.variable("held"), fixed.values()):
        forces[side, axis] -= force
    if "bone" in case:
        pressed = getfem.asm_generic(on_faces, 0, "contact*neg_part(X(3)+u(3))", 1, model)
        forces[0, 2] = pressed
    return numpy.array([moved[d:d + 3] for d in first_degrees(displacement, nodes)]), forces, seconds, iterations, steps // 2


def main(folder, with_quadratic):
    titles = ["case", "tetrahedra", "force, ours, N", "peer, N", "apart", "largest displacement, mm", "apart at most",
              "ours, s (iterations)", "peer, s (iterations, steps)"]
    if with_quadratic:
        titles += ["peer with quadratic tetrahedra, N", "ours against that"]
    print("| " + " | ".join(titles) + " |\n" + "| --- " * len(titles) + "|")
    for file in sorted(folder.glob("*.txt")):
        case = read_case(file)
        check_range(case)
        moved, forces, seconds, iterations, steps = solve(case, 1)
        ours = case["forces"][:, 1:]
        side = int(numpy.argmax(numpy.linalg.norm(ours, axis=1)))
        size = numpy.linalg.norm(ours[side])
        most = numpy.linalg.norm(moved, axis=1).max()
        apart = numpy.linalg.norm(moved - case["moved"], axis=1).max()
        our_seconds, our_iterations, _ = case["solved"][0]
        cells = [file.stem, len(case["tetrahedra"]), f"{size:.6g}", f"{numpy.linalg.norm(forces[side]):.6g}",
                 f"{100 * numpy.linalg.norm(forces[side] - ours[side]) / size:.3f} %", f"{1000 * most:.3f}",
                 f"{100 * apart / most:.3f} %", f"{our_seconds:.2f} ({our_iterations:.0f})",
                 f"{seconds:.2f} ({iterations}, {steps})"]
        if with_quadratic:
            try:
                finer = numpy.linalg.norm(solve(case, 2)[1][side])
                cells += [f"{finer:.6g}", f"{100 * (size / finer - 1):+.2f} %"]
            except RuntimeError as error:
                cells += [str(error), ""]
        print("| " + " | ".join(str(cell) for cell in cells) + " |", flush=True)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), "--quadratic" in sys.argv[2:])
