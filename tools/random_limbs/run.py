#!/usr/bin/env python3
"""Makes limbs from seeds, runs them, and tells which muscles miss a gate.

    tools/random_limbs/run.py [--seeds FIRST:LAST] [--kinds KIND,...] [--crowded] [--method NAME] [--out FOLDER]
                              [--program FILE] [--make-only]

No data are asked for: bones and muscles are swept tubes and sheets (limbs.py), with other shapes, sizes, resolutions,
bumps and flat triangles for every seed. --crowded: more and thicker muscles, which lie up to centimetres in each other at
rest. With gracilis_contact_check beside the program, exact intersections (CGAL) are counted, too: triangles of two muscles
or of one that cut each other beyond rest, and edges that cross a bone. Exit code 5 where a gate is missed.
Needs a release build and python3-numpy.
"""

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np

import limbs

PROGRAM = Path(__file__).resolve().parents[2] / "build" / "release" / "bin" / "gracilis"
PATIENCE = 600  # s, with a run that stands still
MILLIMETRES = 1000


def write_ply(path, vertices, faces):
    with open(path, "w") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\nproperty float x\nproperty float y\n"
                   f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
        np.savetxt(file, vertices, fmt="%.7f")
        np.savetxt(file, np.concatenate([np.full((len(faces), 1), 3), faces], 1), fmt="%d")


def numbers(values):
    return "[" + ", ".join(f"{value:.6g}" for value in values) + "]"


def attachment(end, name, body, points, reach):
    places = ", ".join(numbers(MILLIMETRES * point) for point in points)
    return (f'[[muscles.attachments]]\nname = "{name}"\nend = "{end}"\nbody = "{body}"\npoints_mm = [{places}]\n'
            f"landmark_distance_mm = {MILLIMETRES * reach:.1f}\n")


def write_scene(limb, name, folder):
    """Surfaces and scene.toml. Returns the number of the muscles' vertices."""
    folder.mkdir(parents=True, exist_ok=True)
    rng = limb.rng
    edge, jitter, slivers = rng.uniform(0.0025, 0.005), rng.uniform(0, 0.8), int(rng.integers(0, 30))
    bumps = rng.uniform(0, 0.03)
    parts = [f'schema = 1\nname = "{name}"\nanterior = [1, 0, 0]\nsuperior = [0, 0, 1]\n']
    for bone, body, tube in limb.bones:
        write_ply(folder / f"{bone}.ply", *tube.mesh(0.003, rng, bumps=bumps))
        parts.append(f'[[bones]]\nname = "{bone}"\nbody = "{body}"\nfile = "{bone}.ply"\n')
    for joint, parent, child, center, axes in limb.joints:
        parts.append(f'[[joints]]\nname = "{joint}"\nparent = "{parent}"\nchild = "{child}"\ncenter = {numbers(center)}\n')
        parts += [f'[[joints.axes]]\ncoordinate = "{coordinate}"\naxis = {numbers(axis)}\n' for coordinate, axis in axes]
    count = 0
    for muscle, shape, origin, insertion in limb.muscles:
        vertices, faces = shape.mesh(edge, rng, bumps=0.02, jitter=jitter, slivers=slivers)
        count += len(vertices)
        write_ply(folder / f"{muscle}.ply", vertices, faces)
        parts.append(f'[[muscles]]\nname = "{muscle}"\nfile = "{muscle}.ply"\n')
        parts += [attachment("origin", "first", *origin), attachment("insertion", "last", *insertion)]
    coordinates, poses, step = limb.motion
    parts.append(f"[motion]\ncoordinates = {json.dumps(coordinates)}\nkey_poses_deg = {poses}\nstep_deg = {step}\n")
    (folder / "scene.toml").write_text("\n".join(parts))
    return count


def run(program, scene, out, method):
    """What the program says of the run, as read from its JSON; None where it failed."""
    words = [program, "run", scene, "--out", out, "--force", "--no-pictures", "--no-fibers", "--json",
             "--set", f"method={method}"]
    done = subprocess.run(words, capture_output=True, text=True, timeout=PATIENCE)
    if done.returncode == 0:
        return json.loads(done.stdout)
    print(done.stderr.strip(), file=sys.stderr)
    return None


def intersections(check, out):
    """Pairs of triangles of two muscles and of one, and edges in bones, at most, beyond rest."""
    if not check.exists():
        return "not counted"
    text = subprocess.run([check, out, "--every", "8"], capture_output=True, text=True, timeout=PATIENCE).stdout
    found = [re.search(rf"{what} beyond rest\s+(\d+)", text) for what in ("face pairs", "self pairs", "bone edges")]
    return " ".join(match.group(1) if match else "?" for match in found)


def judged(kind, seed, arguments):
    """Makes and runs one limb; prints a line for it and one for each muscle that misses a gate. True where none does."""
    name = f"{kind}_{seed}" + ("_crowded" if arguments.crowded else "")
    limb = limbs.Limb(np.random.default_rng([seed, list(limbs.KINDS).index(kind)]), arguments.crowded)
    limbs.KINDS[kind](limb)
    folder = arguments.out / name
    vertices = write_scene(limb, name, folder)
    line = f"{name:20} {len(limb.muscles):3} muscles {vertices:6} vertices"
    if arguments.make_only:
        print(line, flush=True)
        return True
    report = run(arguments.program, folder / "scene.toml", folder / "run", arguments.method)
    if report is None:
        print(line, "  failed", flush=True)
        return False
    cuts = intersections(arguments.program.with_name("gracilis_contact_check"), folder / "run")
    print(f"{line} {report['frames']:3} frames {report['seconds']:6.1f} s  cuts: {cuts}", flush=True)
    for missed in report["gates"].get("missed_by", []):
        print(f"    {missed['muscle']} in {missed['frames']} frames, first in {missed['first_frame']}: {missed['reason']}",
              flush=True)
    return report["gates"]["met"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", default="0:3", help="FIRST:LAST, the last left out")
    parser.add_argument("--kinds", default=",".join(limbs.KINDS), help="of limbs, separated by commas")
    parser.add_argument("--crowded", action="store_true")
    parser.add_argument("--method", default="xpbd")
    parser.add_argument("--out", type=Path, default=Path("runs/random_limbs"))
    parser.add_argument("--program", type=Path, default=PROGRAM)
    parser.add_argument("--make-only", action="store_true", help="write scenes, run none")
    arguments = parser.parse_args()
    kinds = arguments.kinds.split(",")
    if unknown := [kind for kind in kinds if kind not in limbs.KINDS]:
        parser.error(f"--kinds: there is no {unknown[0]} (there are {', '.join(limbs.KINDS)})")
    if not (seeds := re.fullmatch(r"(\d+):(\d+)", arguments.seeds)):
        parser.error("--seeds: two whole numbers with a colon between them, as 0:3")
    results = [judged(kind, seed, arguments) for seed in range(int(seeds[1]), int(seeds[2])) for kind in kinds]
    print(f"{sum(results)} of {len(results)} limbs keep every gate" if not arguments.make_only else f"{len(results)} limbs made")
    return 0 if all(results) else 5


if __name__ == "__main__":
    sys.exit(main())
