"""Files of tables: .toml, .json and .csv."""
import csv
import json
import os
import tomllib


def read(path):
    """What such a file has; nothing where there is none. Of a .csv, which must be there, its rows."""
    if path.endswith(".csv"):
        with open(path, newline="") as file:
            return list(csv.DictReader(file))
    if not os.path.exists(path):
        return {}
    with open(path, "rb") as file:
        return tomllib.load(file) if path.endswith(".toml") else json.load(file)
