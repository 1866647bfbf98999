"""What runs leave behind."""
import csv
import math
import os
import re


def value_of(cell):
    """A number where it is one, nothing where it is empty."""
    try:
        return float(cell)
    except ValueError:
        return cell or None


def rows(path):
    """Rows of a .csv; none where there is no file."""
    if not os.path.exists(path):
        return []
    with open(path, newline="") as file:
        return [{key: value_of(cell) for key, cell in row.items()} for row in csv.DictReader(file)]


def groups(table, *keys):
    """Rows by the values of these columns, in the order of their first row."""
    found = {}
    for row in table:
        found.setdefault(row[keys[0]] if len(keys) == 1 else tuple(row[key] for key in keys), []).append(row)
    return found


def table(page, name):
    """Rows of a table that a program has left in OUT/tables."""
    return rows(f"{page.out}/tables/{name}.csv")


def log(value):
    return math.log10(max(value, 1e-30))


def measures(folder):
    """A row for each frame and muscle of a run."""
    return rows(f"{folder}/measures.csv")


def last(folder):
    """The measures of a run's last frame, a row for each muscle."""
    table = measures(folder)
    return [row for row in table if row["frame"] == table[-1]["frame"]]


def over(folder, column, x="frame", of=float):
    """{muscle: [(x, value)]}."""
    return {muscle: [(row[x], of(row[column])) for row in table] for muscle, table in groups(measures(folder), "muscle").items()}


def frame_times(folder):
    """Milliseconds of each frame but the first, all muscles together."""
    return [sum(row["milliseconds"] for row in table) for frame, table in sorted(groups(measures(folder), "frame").items()) if frame > 0]


def sto(path):
    """Columns and rows of a .sto file."""
    with open(path) as file:
        lines = file.read().split("endheader\n", 1)[1].splitlines()
    return lines[0].split("\t"), [[float(cell) for cell in line.split("\t")] for line in lines[1:]]


def fibers(folder):
    """Of each muscle its fibers' lengths, mm, over the first coordinate, degrees, or over frames: {muscle: [(x, [length, ...])]}."""
    columns, table = sto(f"{folder}/fiber_lengths.sto")
    found = {}
    for name, values in zip(columns, zip(*table)):
        muscle, _, fiber = name.rpartition("_f")
        if muscle and fiber.isdigit():
            found.setdefault(muscle, []).append([1000 * value for value in values])
    return {muscle: list(zip((row[1] for row in table), zip(*lengths))) for muscle, lengths in found.items()}


def matching(folder, pattern):
    """[(groups of the pattern, path)] of what has such a name there, in order; the last group, where it is a number, as such."""
    found = []
    for name in os.listdir(folder):
        match = re.fullmatch(pattern, name)
        if match:
            *words, last_word = match.groups()
            found.append(((*words, value_of(last_word)), f"{folder}/{name}"))
    return sorted(found)


def named(folder, pattern):
    """The same of runs."""
    return [(groups, run) for groups, run in matching(folder, pattern) if os.path.exists(f"{run}/measures.csv")]


def over_runs(folder, pattern, value):
    """{WHAT: [(N, value of the last frame's rows)]} of runs whose names have groups WHAT and N."""
    found = {}
    for (what, n), run in named(folder, pattern):
        found.setdefault(what, []).append((n, value(last(run))))
    return found


def muscles_over_runs(folder, pattern, column, factor=1):
    """{muscle: [(N, value in the last frame)]} of runs whose names have a group N."""
    found = {}
    for (n,), run in named(folder, pattern):
        for row in last(run):
            found.setdefault(row["muscle"], []).append((n, factor * row[column]))
    return found
