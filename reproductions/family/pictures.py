#!/usr/bin/env python3
"""pictures.py GRACILIS OUT HERE: draws what HERE/pictures.toml lists, of runs that are complete in OUT, into OUT/pictures.

An entry has a name, a title, a remark, and either a run (below OUT) with options of `gracilis render` (in which OUT/ is that
folder), or a file (below OUT) that another command has drawn, with that command. `needs` tells what it would need where it cannot be drawn."""
import os
import shlex
import subprocess
import sys

import files


def listed(here):
    """Entries of HERE/pictures.toml; none where there is no such file."""
    return files.read(os.path.join(here, "pictures.toml")).get("pictures", [])


def picture_of(out, entry):
    return os.path.join(out, entry["file"]) if "file" in entry else os.path.join(out, "pictures", entry["name"] + ".png")


def command_of(entry):
    """What draws it, as people type it."""
    return entry["command"] if "command" in entry else f"gracilis render OUT/{entry['run']} {entry['options']} --out {entry['name']}.png"


def is_complete(run):
    try:
        with open(os.path.join(run, "run.json")) as file:
            return '"status": "complete"' in file.read(400)
    except OSError:
        return False


def draw(gracilis, out, entry):
    run, picture = os.path.join(out, entry["run"]), picture_of(out, entry)
    if os.path.exists(picture) or not is_complete(run):
        return
    words = [os.path.join(out, word[4:]) if word.startswith("OUT/") else word for word in shlex.split(entry["options"])]
    with open(os.path.join(out, "pictures", entry["name"] + ".txt"), "w") as log:
        done = subprocess.run([gracilis, "render", run, *words, "--out", picture], stdout=log, stderr=log)
    if done.returncode:
        sys.exit(f"failed, see {log.name}: {command_of(entry)}")


def main(gracilis, out, here):
    os.makedirs(os.path.join(out, "pictures"), exist_ok=True)
    for entry in listed(here):
        if "run" in entry:
            draw(gracilis, out, entry)


if __name__ == "__main__":
    main(*sys.argv[1:4])
