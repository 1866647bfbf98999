import ast
import unittest
from pathlib import Path

import gracilis

tree = ast.parse((Path(gracilis.__file__).parent / "__init__.pyi").read_text())
public = {name for name in vars(gracilis) if not name.startswith("_")} - {"arms", "errors", "notebooks", "recipes", "sweeps", "tables"}


def names_in(body):
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            yield node.name
        elif isinstance(node, ast.AnnAssign):
            yield node.target.id
        elif isinstance(node, ast.ImportFrom) and node.level == 1:
            yield from (each.name for each in node.names)


class Stubs(unittest.TestCase):
    def test_they_name_what_the_package_has(self):
        stubbed = {name for name in names_in(tree.body) if not name.startswith("_")}
        self.assertEqual(stubbed, public)

    def test_classes_have_what_they_say(self):
        for node in tree.body:
            if not isinstance(node, ast.ClassDef):
                continue
            cls = getattr(gracilis, node.name)
            stubbed = {name for name in names_in(node.body) if not name.startswith("__")}
            has = {name for name in vars(cls) if not name.startswith("_")}
            if issubclass(cls, tuple):
                has &= set(cls._fields)
            with self.subTest(node.name):
                self.assertEqual({name for name in stubbed if not name.startswith("_")}, has)
                for name in stubbed:
                    self.assertTrue(hasattr(cls, name), name)

    def test_everything_is_explained(self):
        for name in public:
            with self.subTest(name):
                self.assertGreater(len(getattr(gracilis, name).__doc__ or ""), 20)


if __name__ == "__main__":
    unittest.main()
