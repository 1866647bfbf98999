"""What run folders tell."""
import csv
import json
import tomllib

import publication


def settings(folder):
    """What a run's first muscle had, by the keys of published.csv; of a vector its length."""
    with open(f"{folder}/run.json") as file:
        text = tomllib.loads(json.load(file)["settings"])
    muscle = text["muscles"][0]
    found = {f"{part}.{key}": value for part in ("settings", "contraction", "fibers") for key, value in muscle[part].items()}
    found.update({f"{part}.{key}": value for part in ("contact", "distance_field") for key, value in text[part].items()})
    return {key: sum(each**2 for each in value) ** 0.5 if isinstance(value, list) else value for key, value in found.items()}


def fibers(folder):
    """Of each muscle its fibers' lengths, m, over the first coordinate, degrees: {muscle: [(angle, [length, ...])]}."""
    columns, rows = publication.sto_rows(f"{folder}/fiber_lengths.sto")
    found = {}
    for row in rows:
        by_muscle = {}
        for name, value in zip(columns, row):
            if name.rsplit("_f", 1)[-1].isdigit() and "_f" in name:
                by_muscle.setdefault(name.rsplit("_f", 1)[0], []).append(value)
        for muscle, lengths in by_muscle.items():
            found.setdefault(muscle, []).append((row[1], lengths))
    return found


def mean(values):
    return sum(values) / len(values)


def measures(folder, column, coordinate="hip_flexion_r"):
    """{muscle: [(coordinate, value)]}, the coordinate in degrees."""
    found = {}
    with open(f"{folder}/measures.csv", newline="") as file:
        for row in csv.DictReader(file):
            found.setdefault(row["muscle"], []).append((float(row[f"{coordinate}_deg"]), float(row[column])))
    return found


def poses(folder, coordinates):
    """The joint's angles of each frame, degrees."""
    with open(f"{folder}/measures.csv", newline="") as file:
        rows = {row["frame"]: tuple(float(row[f"{name}_deg"]) for name in coordinates) for row in csv.DictReader(file)}
    return list(rows.values())


def worst(folder, column):
    """[(flexion, value)] of the muscle whose value is farthest from 1 there."""
    rows = {}
    for number, row in enumerate(zip(*measures(folder, column).values())):
        rows[number] = max(row, key=lambda point: abs(point[1] - 1))
    return list(rows.values())


def exploded(folder, limit):
    """Muscles whose edges are in the mean `limit` times as long as at rest or more in some frame, with the first such flexion."""
    over = {}
    for muscle, rows in measures(folder, "edge_ratio_mean").items():
        found = [flexion for flexion, value in rows if not value < limit]
        if found:
            over[muscle] = found[0]
    return over
