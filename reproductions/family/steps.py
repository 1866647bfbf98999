"""What HERE/steps.toml lists, in its order: commands, each with what it makes below OUT.

A table `words` says what stands for {NAME}; where that is a list and NAME is in `makes`, there is a step for each of its entries. {makes} is what
the step makes. `thin` has words that take their place with --thin, `without_data` those where the data lack a folder of its `of`. A step has what it
`makes`; the `command`, in which OUT, DATA, HERE and ROOT (the project) are folders, or a `template` beside the list, which is copied with these filled in; `tells`,
where the command's answer is what it makes; `data`, folders without which there is no such step; and `full`, where --thin leaves it out."""
import glob
import itertools
import os
import re
import shlex
import shutil
import subprocess
import sys
import time

from files import read

FIELD = re.compile(r"\{(\w+)\}")
ENDED_WELL = ("exit code 0", "exit code 5")  # 5: the run is there, and has missed a gate


def filled(text, words):
    """{NAME} replaced, inner ones first."""
    while FIELD.search(text):
        text = FIELD.sub(lambda field: str(words[field[1]]), text)
    return text


def each_of(step, words):
    """The step's words for every combination of the lists that `makes` names."""
    lists = [name for name in dict.fromkeys(FIELD.findall(step["makes"])) if isinstance(words[name], list)]
    for values in itertools.product(*(words[name] for name in lists)):
        yield {**words, **dict(zip(lists, values))}


class Steps:
    def __init__(self, gracilis, here, out, data, thin, sets=(), lists=None):
        """`sets`: KEY=VALUE for every run; `lists`: words in place of those in the file."""
        self.gracilis, self.out, self.thin = gracilis, out, thin
        self.options = [word for each in sets for word in ("--set", each)]
        self.folders = {"OUT": out, "DATA": data, "HERE": here, "ROOT": os.path.dirname(os.path.dirname(here))}
        self.here = here
        self.lacks = set()  # folders that the data lack
        listed = read(os.path.join(here, "steps.toml"))
        self.steps, self.words = listed["steps"], listed.get("words", {})
        if not self.has(listed.get("without_data", {}).get("of", [])):
            self.words.update(listed["without_data"])
        if thin:
            self.words.update(listed.get("thin", {}))
        self.words.update(lists or {})

    def has(self, folders):
        lacks = [name for name in folders if not os.path.isdir(os.path.join(self.folders["DATA"], name))]
        for name in sorted(set(lacks) - self.lacks):
            print(f"skipped: there is no {self.folders['DATA']}/{name}", file=sys.stderr)
        self.lacks |= set(lacks)
        return not lacks

    def placed(self, text):
        return re.sub(r"\b(OUT|DATA|HERE|ROOT)\b", lambda found: self.folders[found[1]], text)

    def listed(self):
        """(what it makes, its step, its words) of every step of this pass."""
        for step in self.steps:
            if not (self.thin and step.get("full")) and self.has(step.get("data", [])):
                for words in each_of(step, self.words):
                    makes = filled(step["makes"], words)
                    yield makes, step, {**words, "makes": makes}

    def argv(self, command):
        words = [path for word in shlex.split(command) for path in (sorted(glob.glob(self.placed(word))) if "*" in word else [self.placed(word)])]
        if words[0].startswith("gracilis"):
            words[0] = os.path.join(os.path.dirname(self.gracilis), words[0]) if words[0] != "gracilis" else self.gracilis
        return words + (self.options if words[1:2] in (["run"], ["demo"], ["rom"]) else [])

    def make(self):
        for makes, step, words in self.listed():
            path = os.path.join(self.out, makes)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            if "template" in step:
                self.copy(step["template"], path)
            else:
                self.run(filled(step["command"], words), path, step.get("tells", False))

    def copy(self, template, path):
        with open(os.path.join(self.here, template)) as source, open(path, "w") as file:
            file.write(self.placed(source.read()))

    def run(self, command, path, tells):
        """Once: the log has the command in its first line, and in its last how it ended."""
        if os.path.exists(path) and ended_well(f"{path}.txt", command):
            return
        shutil.rmtree(path, ignore_errors=True)
        begun = time.monotonic()
        with open(f"{path}.txt", "w") as log:
            print(command, file=log, flush=True)
            with open(path if tells else os.devnull, "w") as told:
                code = subprocess.run(self.argv(command), stdout=told if tells else log, stderr=log).returncode
            print(f"exit code {code} after {time.monotonic() - begun:.3f} s", file=log)
        if not ended_well(f"{path}.txt", command):
            sys.exit(f"failed with exit code {code}, see {path}.txt: {command}")


def lines_of(log):
    if not os.path.exists(log):
        return [""]
    with open(log, errors="replace") as file:
        return file.read().splitlines() or [""]


def ended_well(log, command):
    lines = lines_of(log)
    return lines[0] == command and lines[-1].startswith(ENDED_WELL)


def seconds(path):
    """How long the command took that made this."""
    return float(lines_of(f"{path}.txt")[-1].split()[-2])
