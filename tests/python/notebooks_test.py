import json
import re
import sys
import tempfile
import unittest
from pathlib import Path

from examples_test import output_of
from scenes import sources

sys.path.insert(0, str(sources / "tools"))
import notebooks  # noqa: E402

number = re.compile(r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def stored(name):
    return json.loads((notebooks.examples / f"{name}.ipynb").read_text())


def code_cells(cells):
    return [cell for cell in cells if cell["cell_type"] == "code"]


def printed(cells):
    outputs = [output for cell in code_cells(cells) for output in cell["outputs"]]
    return "".join("".join(output["text"]) for output in outputs if output["output_type"] == "stream")


def last_place(text):
    """What one counts for in the last digit of a number."""
    digits, _, power = text.partition("e")
    return 10.0 ** (int(power or 0) - len(digits.partition(".")[2]))


class Notebooks(unittest.TestCase):
    def assert_alike(self, stored, made):
        """The same words, and numbers within two units of their last place or 0.2 %: other processors round otherwise."""
        self.assertEqual(number.sub("#", stored).split(), number.sub("#", made).split())
        for one, other in zip(number.findall(stored), number.findall(made)):
            delta = max(2.01 * max(last_place(one), last_place(other)), 0.002 * abs(float(other)))
            self.assertAlmostEqual(float(one), float(other), delta=delta)

    def test_each_example_has_one_with_its_code(self):
        names = {each.stem for each in notebooks.examples.glob("*.py")}
        self.assertEqual({each.stem for each in notebooks.examples.glob("*.ipynb")}, names)
        self.assertGreaterEqual(len(names), 4)
        for name in names:
            with self.subTest(name):
                sources_in = [notebooks.code_of(cell) for cell in stored(name)["cells"]]
                self.assertEqual(sources_in, [notebooks.code_of(cell) for cell in notebooks.cells_of(name)])

    def test_all_code_of_a_script_is_in_its_cells(self):
        for script in notebooks.examples.glob("*.py"):
            with self.subTest(script.stem):
                cells = "\n".join(notebooks.code_of(cell) for cell in stored(script.stem)["cells"]).splitlines()
                said, _ = notebooks.parts_of(script.read_text())
                code = script.read_text().replace(f'"""{said}"""', "", 1).splitlines()
                wanted = [line for line in code if line.strip() and not line.startswith("# %%")]
                self.assertEqual([line for line in wanted if line not in cells], [])

    def test_they_hold_what_the_scripts_print(self):
        for name in ("moment_arms", "own_muscle", "sensitivity"):
            with self.subTest(name):
                self.assert_alike(printed(stored(name)["cells"]), output_of(f"{name}.py"))
        with tempfile.TemporaryDirectory() as folder:
            model = sources / "tests" / "opensim" / "reference" / "arm26_right.osim"
            self.assert_alike(printed(stored("import_osim")["cells"]), output_of("import_osim.py", model, Path(folder) / "scene"))

    def test_made_anew_one_shows_the_same_chart(self):
        cells = notebooks.made("moment_arms")
        self.assert_alike(printed(stored("moment_arms")["cells"]), printed(cells))
        before, after = (code_cells(each)[-1]["outputs"][-1]["data"] for each in (stored("moment_arms")["cells"], cells))
        self.assertEqual(set(before), set(after))
        self.assert_alike("".join(before["image/svg+xml"]), "".join(after["image/svg+xml"]))
        self.assertIn("gluteus maximus r", "".join(after["image/svg+xml"]))

    def test_every_cell_was_run_in_order_and_files_are_small(self):
        for file in notebooks.examples.glob("*.ipynb"):
            notebook = json.loads(file.read_text())
            self.assertEqual((notebook["nbformat"], notebook["metadata"]["kernelspec"]["name"]), (4, "python3"))
            counts = [cell["execution_count"] for cell in code_cells(notebook["cells"])]
            self.assertEqual(counts, list(range(1, len(counts) + 1)), file.name)
            self.assertTrue(printed(notebook["cells"]), file.name)
            self.assertLess(file.stat().st_size, 30000, file.name)

    def test_numbers_that_differ_are_noticed(self):
        self.assert_alike("volume 0.9997", "volume  0.9998")
        for made in ("volume 0.9970", "surface 0.9997", "volume 0.9997 0.9997"):
            with self.assertRaises(AssertionError):
                self.assert_alike("volume 0.9997", made)


if __name__ == "__main__":
    unittest.main()
