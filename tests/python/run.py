"""Runs all tests of the Python package in one process, and tells test.sh what became of each (GTEST_OUTPUT)."""

import os
import sys
import time
import unittest
from pathlib import Path
from xml.sax.saxutils import quoteattr


class Result(unittest.TextTestResult):
    def __init__(self, *arguments, **keywords):
        super().__init__(*arguments, **keywords)
        self.told = {}

    def startTest(self, test):
        super().startTest(test)
        self.began = time.monotonic()
        self.told[test.id()] = ["completed", False, 0]

    def stopTest(self, test):
        self.told[test.id()][2] = time.monotonic() - self.began
        super().stopTest(test)

    def addSkip(self, test, reason):
        super().addSkip(test, reason)
        self.told.setdefault(test.id(), ["", False, 0])[0] = "skipped"

    def addFailure(self, test, error):
        super().addFailure(test, error)
        self.told.setdefault(test.id(), ["", False, 0])[1] = True

    def addError(self, test, error):
        super().addError(test, error)
        self.told.setdefault(test.id(), ["completed", False, 0])[1] = True

    def addSubTest(self, test, subtest, error):
        super().addSubTest(test, subtest, error)
        if error:
            self.told[test.id()][1] = True


def write(path, told):
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', "<testsuites>"]
    for name, (result, failed, seconds) in told.items():
        begin = f'<testcase name={quoteattr(name)} result="{result}" time="{seconds:.3f}"'
        lines += [begin + ">", '<failure message=""/>', "</testcase>"] if failed else [begin + "/>"]
    Path(path).write_text("\n".join(lines + ["</testsuites>"]) + "\n")


def main():
    here = Path(__file__).parent
    loader = unittest.TestLoader()
    if len(sys.argv) > 1:
        loader.testNamePatterns = [f"*{pattern}*" for pattern in sys.argv[1:]]
    suite = loader.discover(str(here), pattern="*_test.py")
    result = unittest.TextTestRunner(verbosity=2, resultclass=Result).run(suite)
    output = os.environ.get("GTEST_OUTPUT", "")
    if output.startswith("xml:"):
        Path(output[4:]).parent.mkdir(parents=True, exist_ok=True)
        write(output[4:], result.told)
    sys.exit(0 if result.wasSuccessful() and result.testsRun > 0 else 1)


if __name__ == "__main__":
    main()
