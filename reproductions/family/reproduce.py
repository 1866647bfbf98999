#!/usr/bin/env python3
"""reproduce.py GRACILIS HERE OUT DATA [--thin] [--set KEY=VALUE ...]: runs what HERE/steps.toml lists, draws what HERE/pictures.toml lists,
and writes the page that HERE/make.py fills. Exit code 1: a full pass has left something out that the page has to have."""
import os
import sys

import pictures
import publication
import steps


def main(gracilis, here, out, data, *options):
    thin = "--thin" in options
    todo = steps.Steps(gracilis, here, out, data, [word for word in options if word != "--thin"], thin)
    todo.make()
    if not thin:
        pictures.main(gracilis, out, here)
    sys.path.insert(0, here)
    import make
    page = publication.WordedPage(out, here, data)
    make.make(page)
    page.pictures(here)
    print(os.path.join(out, "index.html"))
    page.write(complete=not thin and not todo.lacks)


if __name__ == "__main__":
    main(*sys.argv[1:])
