"""Robots move by wheels and contact alone: all callers that can set the pose of a body are listed here."""

import ast
from pathlib import Path

import executor

ROOT = Path(executor.__file__).parent
FORBIDDEN = {
    "resetBasePositionAndOrientation",
    "resetBaseVelocity",
    "resetJointState",
    "resetJointStateMultiDof",
    "resetJointStatesMultiDof",
    "createConstraint",
    "changeConstraint",
    "applyExternalForce",
    "applyExternalTorque",
}
# The renderer's physics server simulates nothing; `placement` serves all others.
PLACERS = {
    ("world/physics/assembly.py", "_follow"),  # a gear between two joints of one model of the universe
    ("world/physics/robot.py", "push"),  # a fault of an evaluation
    ("world/physics/placement.py", "put"),
    ("world/physics/placement.py", "put_at_rest"),
    ("render/tiny.py", "_shoot"),
}
# Dragging by hand, and actors, which are moved by design.
CALLERS = {
    ("world/physics/bullet.py", "move_body"),
    ("world/physics/assembly.py", "move_body"),
    ("world/physics/actor.py", "_carry"),
    ("world/physics/placement.py", "put_at_rest"),
}


def uses(source: str, names: set[str]) -> set[str]:
    """Returns the functions of a source that contain one of `names`, as an attribute, a name or a text."""
    found: set[str] = set()

    def visit(node: ast.AST, function: str) -> None:
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            function = node.name
        named = (
            (isinstance(node, ast.Attribute) and node.attr in names)
            or (isinstance(node, ast.Name) and node.id in names)
            or (isinstance(node, ast.Constant) and node.value in names)
        )
        if named:
            found.add(function)
        for child in ast.iter_child_nodes(node):
            visit(child, function)

    visit(ast.parse(source), "")
    return found


def all_uses(names: set[str]) -> set[tuple[str, str]]:
    return {
        (str(path.relative_to(ROOT)), function)
        for path in ROOT.rglob("*.py")
        for function in uses(path.read_text(encoding="utf-8"), names)
    }


def test_only_placement_puts_bodies_somewhere() -> None:
    assert all_uses(FORBIDDEN) == PLACERS


def test_only_drags_and_actors_call_placement() -> None:
    uses_in_the_world = {use for use in all_uses({"put", "put_at_rest"}) if use[0].startswith("world/")}
    assert uses_in_the_world == CALLERS


def test_the_rule_finds_offenders() -> None:
    bad = "def control(self):\n    getattr(self.bullet, 'resetBaseVelocity')(self.uid, (1, 0, 0))\n"
    assert uses(bad, FORBIDDEN) == {"control"}
    assert uses("def control(self):\n    self.bullet.setJointMotorControl2(0)\n", FORBIDDEN) == set()
