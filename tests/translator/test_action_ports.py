"""The ports that the class of an action declares, or uses by name."""

from __future__ import annotations

import ast

import pytest

from translator.action_ports import Declarations, declared_ports, ports_used

SOURCE = """
class Base:
    INPUT_PORTS = {"speed": Port(float, default=0.5, description="in m/s"), "count": Port(int)}

class Go(Base):
    OUTPUT_PORTS = {"result": Port(list[float])}
    INOUT_PORTS = {"state": Port(State)}
"""
USING = """
class Go:
    def update(self):
        set_output(self, "near", get_input(self, "far"))
"""


def classes(source: str) -> list[ast.ClassDef]:
    return [node for node in ast.parse(source).body if isinstance(node, ast.ClassDef)]


def refuse(*found: object, **more: object) -> None:
    pytest.fail(f"{found} {more}")


def test_ports_of_a_class_and_its_bases_have_types_and_defaults() -> None:
    base, derived = classes(SOURCE)
    found = declared_ports(Declarations.collect([derived, base]), refuse)
    ports = {port.name: (port.direction, port.type, port.default, port.description) for port in found}
    assert ports["speed"] == ("input", "double", "0.5", "in m/s")
    assert ports["count"][:3] == ("input", "int", None)
    assert ports["result"][:2] == ("output", "list[double]")
    assert ports["state"][:2] == ("inout", "any")


def test_a_class_that_declares_none_has_the_ports_that_its_code_names() -> None:
    [cls] = classes(USING)
    assert not Declarations.collect([cls]).any
    assert {port.name: port.direction for port in ports_used(cls)} == {"near": "output", "far": "input"}
