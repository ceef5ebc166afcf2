"""Writes endowire.pyi from the module: PYTHONPATH=build/check/python python3 python/write_stub.py > python/endowire.pyi

Every docstring begins with the signature of what it belongs to, or with its type.
"""
import inspect
import sys

import endowire

HEAD = '''# Written by python/write_stub.py; a test holds it against the module.
from __future__ import annotations

import os
from collections.abc import Sequence

import numpy
from numpy.typing import ArrayLike

'''


def documentation(text, indent):
    """A docstring of the stub; nothing when there is no text."""
    lines = text.strip().split("\n")
    if lines == [""]:
        return ""
    lines[1:] = [indent + line if line else "" for line in lines[1:]]
    end = "" if len(lines) == 1 else "\n" + indent
    return f'{indent}"""' + "\n".join(lines) + f'{end}"""\n'


def function(name, text, indent):
    signature, _, rest = text.partition("\n")
    if not signature.startswith(name + "("):
        raise SystemExit(f"{name}: its docstring does not begin with its signature, but with: {signature}")
    body = documentation(rest, indent + "    ")
    return f"{indent}def {signature}:" + ("\n" + body if body else " ...\n")


def attribute(name, text, indent):
    if not text:
        raise SystemExit(f"{name}: no docstring, so no type")
    kind, _, rest = text.partition(": ")
    body = documentation(rest, indent + "    ")
    return f"{indent}@property\n{indent}def {name}(self) -> {kind}:" + ("\n" + body if body else " ...\n")


def members(cls):
    """What the class has itself, in the order it was defined."""
    for name, value in vars(cls).items():
        if name in ("__init__", "__len__") or not name.startswith("_"):
            yield name, value


def class_text(cls):
    base = "" if cls.__bases__[0].__module__ != "builtins" or cls.__bases__[0] is object else cls.__bases__[0].__name__
    text = f"class {cls.__name__}" + (f"({base})" if base else "") + ":\n"
    text += documentation(cls.__doc__ or "", "    ")
    for name, value in members(cls):
        if name == "__init__" and not (value.__doc__ or "").startswith("__init__("):
            continue  # not made by hand
        make = attribute if isinstance(value, property) else function
        text += make(name, inspect.getdoc(value) or "", "    ")
    return text


def stub():
    text = documentation(endowire.__doc__, "") + HEAD
    text += "__version__: str\n\n"
    public = [(n, v) for n, v in vars(endowire).items() if not n.startswith("_")]
    for name, value in public:
        if not inspect.isclass(value):
            raise SystemExit(f"{name} is no class: write_stub.py has to learn how it is written down")
    return text + "\n".join(class_text(value) for _, value in public)


if __name__ == "__main__":
    sys.stdout.write(stub())
