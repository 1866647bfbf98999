#!/usr/bin/env python3
"""Tells how many small errors in the numerical core the tests would notice.

    tools/mutation.py [--count N] [--seed S] [--module MODULE]... [--then PROGRAM]... [--before WORDS] [--again]

Changes one sign, comparison, logical word or constant of src/gracilis/{dynamics,geometry,anatomy} at a time (a mutant),
runs the module's tests until one fails (killed), then those of its neighbors and of every --then (such as methods_tests).
Which mutants is a matter of the seed alone; the numbers of which the built-in bones and muscles are made
(anatomy/builtin) are data and left alone. It stands on a release build with its tests (cmake --preset release), whose
files it leaves as they are: a mutant is compiled alone and linked before the library, and the linker takes the first of
two functions of one name. What survives so meets the tests once more with the assertions of Eigen, of the standard
library and of the mutant's own file, as in the builds debug and asan. Results are kept in build/mutation/seed_S.jsonl;
called again, it goes on behind them.
--before: words before each compiler call, such as "nice". --again: those that survived are judged anew, by tests that
have come since; --tests says which (as --gtest_filter does), where all of them take too long.
"""

import argparse
import json
import random
import re
import resource
import shlex
import signal
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "release"
WORK = ROOT / "build" / "mutation"
MODULES = ["dynamics", "geometry", "anatomy"]
MEMORY = 6 * 2**30  # a mutant that asks for more is killed by it
ASSERTIONS = ["-UNDEBUG", "-D_GLIBCXX_ASSERTIONS"]
BY_ASSERTIONS = " with assertions"
PATIENCE = 3600  # s, with tests that stand still, and with those of no mutant

WORDS = {
    " + ": " - ", " - ": " + ", " += ": " -= ", " -= ": " += ", " * ": " / ", " / ": " * ",
    " < ": " <= ", " <= ": " < ", " > ": " >= ", " >= ": " > ", " == ": " != ", " != ": " == ",
    " && ": " || ", " || ": " && ", "std::min(": "std::max(", "std::max(": "std::min(",
}
WORD = re.compile("|".join(re.escape(word) for word in sorted(WORDS, key=len, reverse=True)))
CONSTANT = re.compile(r"(?<![\w.])(\d+\.\d+(?:e-?\d+)?|\d+)(?![\w.\"'])")
# Lines that compute nothing.
IDLE = re.compile(r"^\s*(//|#|\*|static_assert|assert|using |template|namespace|throw )|\"|operator")


def other_constant(text):
    return repr(float(text) * 1.5) if "." in text or "e" in text else str(int(text) + 1)


def mutants_of(path):
    """All of a file: (path, line, column, old, new)."""
    found = []
    text = path.read_text()
    if "foreach_target" in text:  # includes itself again, by its path
        return found
    for number, line in enumerate(text.splitlines(), 1):
        if IDLE.search(line):
            continue
        code = line.split("//")[0]
        name = str(path.relative_to(ROOT))
        found += [(name, number, m.start(), m.group(), WORDS[m.group()]) for m in WORD.finditer(code)]
        found += [(name, number, m.start(), m.group(), other_constant(m.group())) for m in CONSTANT.finditer(code)]
    return found


def drawn(modules, seed):
    """All mutants in the order of the seed, the modules in turn."""
    chance = random.Random(seed)
    piles = []
    for module in modules:
        sources = sorted((ROOT / "src/gracilis" / module).rglob("*.cpp"))
        pile = [mutant for path in sources if "builtin" not in path.parts for mutant in mutants_of(path)]
        chance.shuffle(pile)
        piles.append(pile)
    while any(piles):
        for pile in piles:
            if pile:
                yield pile.pop()


class Build:
    """What the release build did, to be done again with one source changed."""

    def __init__(self, before):
        commands = json.loads((BUILD / "compile_commands.json").read_text())
        self.before = shlex.split(before)
        self.of_source = {}
        for entry in commands:
            file = Path(entry["file"])
            if "gracilis_core.dir" not in entry["command"]:
                continue
            batch = re.findall(r'#include "(/.*?)"', file.read_text()) if "/Unity/" in str(file) else [str(file)]
            for source in batch:
                self.of_source[source] = entry["command"]
        self.links = {}

    def compile(self, source, text, made, asserting=False):
        """Whether the source with this text compiles. Code that is linked from elsewhere, too, must not be inlined: it
        is not, since what is independent of its position calls what others may replace."""
        WORK.joinpath(source.name).write_text(text)
        words = shlex.split(self.of_source[str(source)])
        words[words.index("-o") + 1], words[-1] = str(made), str(WORK / source.name)
        words = [word for word in words if word != "-Werror" and not word.endswith("ccache")]
        words += ASSERTIONS if asserting else []
        call = [*self.before, *words, "-w", "-iquote", str(source.parent)]
        return subprocess.run(call, cwd=BUILD, capture_output=True).returncode == 0

    def mutant(self, mutant, asserting=False):
        """Its object, or None where it does not compile."""
        name, number, column, old, new = mutant
        lines = (ROOT / name).read_text().split("\n")
        line = lines[number - 1]
        lines[number - 1] = line[:column] + new + line[column + len(old):]
        made = WORK / "mutant.o"
        return made if self.compile(ROOT / name, "\n".join(lines), made, asserting) else None

    def original(self, mutant, asserting=False):
        """The object of its file without it."""
        made = WORK / "original.o"
        self.compile(ROOT / mutant[0], (ROOT / mutant[0]).read_text(), made, asserting)
        return made

    def link(self, program, made):
        """The test program with the mutant in it."""
        if program not in self.links:
            every = subprocess.run(["ninja", "-t", "commands", "-s", f"bin/{program}"], cwd=BUILD, check=True,
                                   capture_output=True, text=True).stdout
            # What CMake does after linking (it lists tests) is not wanted.
            self.links[program] = next(part for part in every.split(" && ") if f"-o bin/{program}" in part)
        words = shlex.split(self.links[program])
        words[words.index("-o") + 1] = str(WORK / program)
        library = next(i for i, word in enumerate(words) if word.endswith(".a"))
        words[library:library] = [str(made), "-Wl,-z,muldefs"]
        subprocess.run(words, cwd=BUILD, check=True)
        return WORK / program


def code_in(made):
    """All sections of an object and what the linker fills in, without the file's name."""
    said = subprocess.run(["objdump", "--full-contents", "--reloc", str(made)], capture_output=True, check=True).stdout
    return said.split(b"\n", 3)[-1]


def processor_seconds():
    """Of all programs that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def fails(program, seconds, tests="*"):
    """Why its tests fail, or an empty text. They end after so many seconds of processor time, so that nothing else that
    runs beside them decides."""
    def limited():
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CPU, (int(seconds), int(seconds)))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    call = [str(program), "--gtest_brief=1", "--gtest_fail_fast", "--gtest_filter=" + tests]
    try:
        done = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, timeout=PATIENCE, preexec_fn=limited,
                              errors="replace")
    except subprocess.TimeoutExpired:
        return "stands still"
    if done.returncode == 0:
        return ""
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return "does not end"
    failed = re.search(r"\[  FAILED  \] (\S+)", done.stdout)
    return failed.group(1).rstrip(",") if failed else f"ends with {done.returncode}"


def judge(build, mutant, programs, seconds, tests="*"):
    made = build.mutant(mutant)
    if made is None:
        return "no change", ""

    def failing(made, program):
        return fails(build.link(program, made), 4 * seconds[program] + 30, tests)

    for program in programs:
        if why := failing(made, program):
            return "killed", f"{program}: {why}"
    if code_in(made) == code_in(build.original(mutant)):
        return "no change", ""
    # What reads beyond an array is seen where the mutant's file has its assertions, unless it has others that fail.
    made = build.mutant(mutant, asserting=True)
    for program in programs:
        if (why := failing(made, program)) and not failing(build.original(mutant, asserting=True), program):
            return "killed", f"{program}{BY_ASSERTIONS}: {why}"
    return "survived", ""


def told(mutant):
    name, number, _, old, new = mutant
    return f"{name}:{number}: '{old.strip()}' as '{new.strip()}'"


def judge_again(build, results, seconds, tests):
    for r in results:
        if r["result"] != "survived":
            continue
        own = r["file"].split("/")[2] + "_tests"
        programs = [own] + [program for program in seconds if program != own]
        mutant = (r["file"], r["line"], r["column"], r["old"], r["new"])
        r["result"], r["why"] = judge(build, mutant, programs, seconds, tests)
        print(f"{told(mutant)}: {r['result']} {r['why']}", flush=True)


def report(results):
    judged = [r for r in results if r["result"] != "no change"]
    killed = sum(r["result"] == "killed" for r in judged)
    for r in judged:
        if r["result"] == "survived":
            print(f"survived: {told((r['file'], r['line'], r['column'], r['old'], r['new']))}")
    asserted = sum(BY_ASSERTIONS in r["why"] for r in judged)
    share = f" ({100 * killed / len(judged):.0f} %)" if judged else ""
    print(f"{killed} of {len(judged)} mutants killed{share}, {asserted} of them{BY_ASSERTIONS} alone")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=100, help="how many mutants are judged (100)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--module", action="append", choices=MODULES, help="default: all three")
    parser.add_argument("--then", action="append", default=[], metavar="PROGRAM", help="tests that survivors also meet")
    parser.add_argument("--before", default="", metavar="WORDS", help="words before each compiler call")
    parser.add_argument("--again", action="store_true", help="judge those anew that survived, and no others")
    parser.add_argument("--tests", default="*", metavar="FILTER", help="with --again: the tests that they meet")
    options = parser.parse_args()
    if not (BUILD / "compile_commands.json").exists():
        sys.exit("there is no build/release: cmake --preset release && cmake --build --preset release")
    WORK.mkdir(parents=True, exist_ok=True)
    modules = options.module or MODULES
    kept = WORK / f"seed_{options.seed}_{'_'.join(modules)}.jsonl"
    results = [json.loads(line) for line in kept.read_text().splitlines()] if kept.exists() else []
    known = {(r["file"], r["line"], r["column"], r["old"]) for r in results}
    build = Build(options.before)
    seconds = {}
    for program in [f"{module}_tests" for module in MODULES] + options.then:
        began = processor_seconds()
        if why := fails(BUILD / "bin" / program, PATIENCE, options.tests):
            sys.exit(f"{program} fails without any mutant: {why}")
        seconds[program] = processor_seconds() - began
    if options.again:
        judge_again(build, results, seconds, options.tests)
        kept.write_text("".join(json.dumps(r) + "\n" for r in results))
        report(results)
        return
    for mutant in drawn(modules, options.seed):
        if sum(r["result"] != "no change" for r in results) >= options.count:
            break
        name, number, column, old, new = mutant
        if (name, number, column, old) in known or str(ROOT / name) not in build.of_source:
            continue
        own = name.split("/")[2] + "_tests"
        programs = [own] + [program for program in seconds if program != own]
        result, why = judge(build, mutant, programs, seconds)
        results.append(dict(file=name, line=number, column=column, old=old, new=new, result=result, why=why))
        with kept.open("a") as file:
            file.write(json.dumps(results[-1]) + "\n")
        print(f"{told(mutant)}: {result} {why}", flush=True)
    report(results)


if __name__ == "__main__":
    main()
