"""A project whose names and texts would break C++ if they were written as they are."""

from __future__ import annotations

import json
from typing import Final

from translator import Project, load

HEAD: Final = """
import py_trees

from tree_gardener import ControlNode, DecoratorNode, Port, Status


class Pose:
    pass


"""
END: Final = "\n    def update(self):\n        return py_trees.common.Status.SUCCESS\n"
LONG: Final = END.replace("SUCCESS", "RUNNING")
DOC: Final = r'''    r"""Ends the comment */ int injected; /* "quotes" ??/ \

    #include <nothing>  %} {{ x }} \
    """
'''
PORTS: Final = r"""
    INPUT_PORTS = {
        "int": Port(int, default=3, description='Quotes " and \\ and */ and ??/ and\nlines {{ x }}.'),
        "count": Port(int, description="No default."),
        "speed": Port(float, default=0.5),
        "flag": Port(bool, default=False, description="A text would be true."),
        "text": Port(str, default='"); system("x"); //\\ ?? ñ \u202e {{ x }}', description="Hostile."),
        "color": Port("Color", default="A__B", description="An enumeration."),
        "pose": Port(Pose, description="An object."),
        "anything": Port(description="Of any type."),
        "ints": Port(list[int], default=[1, 2]),
        "reals": Port(list[float]),
        "words": Port(list[str], default="a;b"),
        "truths": Port(list[bool]),
        "a-b": Port(int, default="{a}"),
        "a_b": Port(int),
        "aключ": Port(int),
        "a.b": Port(int),
    }
    OUTPUT_PORTS = {
        "result": Port(float, default="{=}", description="Where it goes."),
        "this": Port(Pose),
        "loose": Port(int, default="5"),
        "either": Port(),
    }
    INOUT_PORTS = {"both": Port(bool, default="{both}"), "default": Port(str, default="")}
"""
BEHAVIOUR: Final = "(py_trees.behaviour.Behaviour):\n"
SOURCES: Final = {
    "switch": f"{HEAD}class switch{BEHAVIOUR}{DOC}{PORTS}{END}",
    "Café": f"{HEAD}class Café{BEHAVIOUR}{LONG}",
    "Cafe": f"{HEAD}class Cafe{BEHAVIOUR}{LONG}",
    "FooBar": f"{HEAD}class FooBar{BEHAVIOUR}{END}",
    "Foo_Bar": f"{HEAD}class Foo_Bar{BEHAVIOUR}{END}",
    "tick": f"{HEAD}class tick{BEHAVIOUR}{END}",
    "Робот": f'{HEAD}class Робот{BEHAVIOUR}    NODE_KIND = "Condition"\n{END}',
    "Both": f"{HEAD}class Both(ControlNode):\n    MIN_CHILDREN = 2\n{END}",
    "Once": f'{HEAD}class Once(DecoratorNode):\n    INPUT_PORTS = {{"n": Port(int, default=1)}}\n{END}',
}
ENUMS: Final = {
    "Color": {"A__B": -(2**31), "A_B": 1, "EOF": 2, "class": 3},
    "switch": {"ON": 1},
    "Empty": {},
}
NODES: Final = {
    "r": {"type": "Both", "children": ["a", "b", "c"]},
    "a": {"type": "switch", "ports": {"count": "1", "color": "EOF", "pose": "{p}", "this": "{p}"}},
    "b": {"type": "Once", "children": ["d"]},
    "c": {"type": "Café"},
    "d": {"type": "Робот"},
}


def hostile_project(name: str = 'A "robot" */ \\ {{ x }}') -> Project:
    """Returns the project."""
    tree = {"format": "bt-studio/diagram", "version": 1, "id": "MainTree", "root": "r", "nodes": NODES}
    settings = {"format": "bt-studio/project", "version": 1, "name": name, "description": name}
    enums = {"format": "bt-studio/enums", "version": 1, "enums": ENUMS}
    files = {"project.json": settings, "trees/MainTree.json": tree, "enums.json": enums}
    return load(
        {path: json.dumps(text).encode() for path, text in files.items()}
        | {f"actions/{path}.py": text.encode() for path, text in SOURCES.items()}
    )
