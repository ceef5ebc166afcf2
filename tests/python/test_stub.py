"""python/endowire.pyi says what the module has."""
import ast
import os
import pathlib
import sys
import unittest

import endowire
from support import CACHE, SCENE, simulation

SOURCE = pathlib.Path(os.environ["ENDOWIRE_SOURCE_DIR"])
sys.path.insert(0, str(SOURCE / "python"))
import write_stub  # noqa: E402


class Stub(unittest.TestCase):
    def test_is_the_kept_one(self):
        kept = (SOURCE / "python/endowire.pyi").read_text()
        self.maxDiff = None
        self.assertEqual(write_stub.stub(), kept, "a change that is meant is kept by\n"
                         "PYTHONPATH=build/check/python python3 python/write_stub.py > python/endowire.pyi")

    def test_holds_every_public_name(self):
        tree = ast.parse(write_stub.stub())
        classes = {node.name: {n.name for n in node.body if isinstance(n, ast.FunctionDef)}
                   for node in tree.body if isinstance(node, ast.ClassDef)}
        self.assertEqual(set(classes), {name for name in dir(endowire) if not name.startswith("_")})
        self.assertIn("step", classes["Simulation"])
        for name, members in classes.items():
            if name == "InputError":
                continue
            public = {n for n in vars(getattr(endowire, name)) if not n.startswith("_")}
            self.assertEqual({n for n in members if not n.startswith("_")}, public, name)

    def test_every_argument_is_one_of_the_module(self):
        wire = simulation()
        objects = {"Command": endowire.Command(), "Simulation": wire, "Batch": endowire.Batch([wire])}
        values = {"advance_mm": 0.0, "torque_rad": 0.0, "scene": SCENE, "cache_folder": CACHE, "seed": None,
                  "command": None, "state": wire.save(), "commands": [endowire.Command()], "simulations": [wire],
                  "threads": 1, "index": 0}
        called = 0
        for node in ast.parse(write_stub.stub()).body:
            if not isinstance(node, ast.ClassDef) or node.name not in objects:
                continue
            for method in node.body:
                if not isinstance(method, ast.FunctionDef) or method.decorator_list:
                    continue
                names = [a.arg for a in method.args.args[1:] + method.args.kwonlyargs]
                required = names[:len(method.args.args) - 1 - len(method.args.defaults)]
                target = getattr(endowire, node.name) if method.name == "__init__" else getattr(
                    objects[node.name], method.name)
                for given in (required, names):  # the others have defaults
                    target(**{name: values[name] for name in given})
                    called += 1
        self.assertGreater(called, 20)


if __name__ == "__main__":
    unittest.main()
