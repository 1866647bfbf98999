"""A muscle of one's own, made of arrays: a tube between two blocks that a hinge bends."""

import numpy as np

import gracilis

# %% Surfaces


def tube(radius, length, around=16, along=24):
    """A closed tube along z: vertices (n, 3) in m, faces (m, 3), seen from outside."""
    angle = np.arange(around) * 2 * np.pi / around
    ring = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    # Slanted a little: of a muscle that is quite symmetric, rounding would choose among fibers that are equally good.
    rows = [np.column_stack([ring, z + 0.05 * ring[:, 1]]) for z in np.linspace(0, length, along + 1)]
    vertices = np.vstack(rows + [[[0, 0, 0], [0, 0, length]]])
    faces, low, high = [], len(vertices) - 2, len(vertices) - 1
    for i in range(around):
        j = (i + 1) % around
        for row in range(along):
            a, b = row * around, (row + 1) * around
            faces += [[a + i, a + j, b + j], [a + i, b + j, b + i]]
        faces += [[low, j, i], [high, along * around + i, along * around + j]]
    return vertices, np.array(faces, np.int32)


def block(low, high):
    """A closed box."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
             [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]  # fmt: skip
    return np.asarray(low) + corners * (np.asarray(high) - np.asarray(low)), np.array(faces, np.int32)


# %% A scene of them
vertices, faces = tube(0.015, 0.16)
vertices[:, 0] += 0.04  # beside the bones
scene = gracilis.Scene(
    name="tube",
    bones=[
        dict(name="upper", surface=block((-0.02, -0.02, 0.085), (0.02, 0.02, 0.16))),
        dict(name="lower", surface=block((-0.02, -0.02, 0.0), (0.02, 0.02, 0.075))),
    ],
    joints=[dict(name="hinge", parent="upper", child="lower", center=[0, 0, 0.08],
                 axes=[dict(coordinate="bend", axis=[0, 1, 0], range_deg=[-90, 90])])],
    muscles=[dict(name="muscle", surface=(vertices, faces), attachments=[
        dict(name="top", end="origin", body="upper", vertices=np.flatnonzero(vertices[:, 2] > 0.155)),
        dict(name="bottom", end="insertion", body="lower", vertices=np.flatnonzero(vertices[:, 2] < 0.005)),
    ])],
    iterations=20,
)  # fmt: skip

# %% It bends
sim = gracilis.Simulation(scene)
muscle = sim.muscles["muscle"]
rest = muscle.volume
for angle in range(5, 31, 5):
    sim.advance({"bend": angle})
    print(f"{angle:3d} degrees: volume {muscle.volume / rest:.3f}, fibers {1000 * muscle.mean_fiber_length:.1f} mm")
