"""Files of tables: .toml and .json."""
import json
import os
import tomllib


def read(path):
    """What such a file has; nothing where there is none."""
    if not os.path.exists(path):
        return {}
    with open(path, "rb") as file:
        return tomllib.load(file) if path.endswith(".toml") else json.load(file)
