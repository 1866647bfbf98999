"""Tables of a run, and what goes on the page."""
import csv
import math
import os


def read(path):
    """Rows of a .csv, numbers as such; an empty cell is None. No rows where there is no file."""
    if not os.path.exists(path):
        return []
    with open(path, newline="") as file:
        return [{key: value_of(cell) for key, cell in row.items()} for row in csv.DictReader(file)]


def value_of(cell):
    if cell == "":
        return None
    try:
        return float(cell)
    except ValueError:
        return cell


def groups(rows, *keys):
    """Rows by the values of these columns, in the order of their first row."""
    found = {}
    for row in rows:
        found.setdefault(row[keys[0]] if len(keys) == 1 else tuple(row[key] for key in keys), []).append(row)
    return found


def log(value):
    return math.log10(max(value, 1e-30))


class Results:
    """The page, the values beside the published ones, by their keys, and the tables of the study."""

    def __init__(self, out, page, published):
        self.out, self.page, self.published = out, page, published
        self.ours, self.remarks = {}, {}

    def table(self, name):
        return read(f"{self.out}/tables/{name}.csv")

    def told(self, key):
        return next(row["published"] for row in self.published if row["key"] == key)

    def put(self, key, value, remark=""):
        self.ours[key] = value
        if remark:
            self.remarks[key] = remark

    def add(self, source, quantity, unit, value, remark=""):
        """A row without a published value."""
        self.page.rows.append({"source": source, "quantity": quantity, "unit": unit, "published": "", "ours": f"{value:.4g}",
                               "ratio": "", "remark": remark})
