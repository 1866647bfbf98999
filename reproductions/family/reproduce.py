#!/usr/bin/env python3
"""reproduce.py GRACILIS HERE OUT DATA [--thin] [--set KEY=VALUE ...] [--words NAME=A,B ...]: runs what HERE/steps.toml lists, draws what HERE/pictures.toml lists,
and writes the page that HERE/make.py fills. Exit code 1: a full pass has left something out that the page has to have."""
import argparse
import os
import sys

import pictures
import publication
import steps


def main():
    parser = argparse.ArgumentParser()
    for name in ("gracilis", "here", "out", "data"):
        parser.add_argument(name)
    parser.add_argument("--thin", action="store_true")
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--words", action="append", default=[])
    told = parser.parse_args()
    lists = {name: words.split(",") for name, words in (each.split("=") for each in told.words)}
    todo = steps.Steps(told.gracilis, told.here, told.out, told.data, told.thin, told.set, lists)
    todo.make()
    if not told.thin:
        pictures.main(told.gracilis, told.out, told.here)
    sys.path.insert(0, told.here)
    import make
    page = publication.WordedPage(told.out, told.here, told.data)
    make.make(page)
    page.pictures(told.here)
    print(os.path.join(told.out, "index.html"))
    page.write(complete=not told.thin and not todo.lacks)


if __name__ == "__main__":
    main()
