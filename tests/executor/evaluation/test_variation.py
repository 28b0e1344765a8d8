"""Addresses, the values that they name, and what is drawn for them."""

import json
from pathlib import Path

import pytest

from executor.evaluation.plan import make_plan
from executor.evaluation.variation import InvalidRunError, draw_world, port_text
from executor.universes.document import DocumentError
from tests.executor.evaluation.projects import WORLD, project
from translator.archive import read_folder

ROOT = Path(__file__).resolve().parents[3]
REST = """duration_s: 5
runs: 2
judge: {success: [{never: collision}]}
vary:
"""
ENTRIES = {
    "models.crate.mass": "[1, 2]",
    "robot.pose": "{area: start, yaw: [0, 3]}",
    "robots.rob.pose.z": "[0, 0.001]",
    "actors.walker.speed": "{normal: [1, 0.3], clip: [0.5, 1.5]}",
    "ports.MainTree.go.speed": "[0.1, 0.5]",
    "ports.MainTree.a.count": "[1, 9]",
    "sensors.scan.noise_m": "[0, 0.05]",
    "ground.friction": "[0.5, 1]",
}


def plan_of(entries, **others):
    return make_plan(project(REST + "".join(f"  {k}: {v}\n" for k, v in entries.items()), **others), "main")


def free(*_):
    return False


def drawn(plan, seed, overlaps=free):
    return draw_world(plan.evaluation, plan.targets, plan.universe, seed, overlaps)


def test_no_entry_changes_the_values_of_another():
    entries = {k: v for k, v in ENTRIES.items() if k != "robots.rob.pose.z"}
    all_of_them = drawn(plan_of(entries), 5).values
    backwards = drawn(plan_of(dict(reversed(entries.items()))), 5).values
    assert backwards == all_of_them
    for left_out in entries:
        rest = {k: v for k, v in entries.items() if k != left_out}
        assert drawn(plan_of(rest), 5).values == {k: v for k, v in all_of_them.items() if k != left_out}
    assert drawn(plan_of(entries), 6).values != all_of_them


def test_each_value_gets_to_its_place():
    plan = plan_of(ENTRIES)
    found = drawn(plan, 1)
    universe, values = found.universe, found.values
    assert list(values) == list(ENTRIES)
    assert universe.models[1].mass == values["models.crate.mass"]
    assert universe.robots[0].pose[:2] == tuple(values["robot.pose"][:2])
    assert universe.robots[0].pose[2] == values["robots.rob.pose.z"]
    assert universe.actors[0].speed == values["actors.walker.speed"]
    assert universe.ground.friction == values["ground.friction"]
    assert found.configured(plan.configs[0]).lidars[0].noise_m == values["sensors.scan.noise_m"]
    ports = found.edited(plan.project).trees["MainTree"].nodes["a"].ports
    assert float(ports["speed"]) == values["ports.MainTree.go.speed"]
    assert ports["count"] == str(values["ports.MainTree.a.count"])
    assert (port_text(True), port_text("slow"), port_text(0.1)) == ("true", "slow", "0.1")


def test_a_whole_number_for_a_real_port_stays_real():
    """A port of a called tree becomes an entry, whose type the text decides."""
    called = read_folder(ROOT / "backend" / "catalog" / "behaviours")
    tree = {
        "format": "bt-studio/diagram", "version": 1, "id": "MainTree", "root": "go", "drafts": [],
        "nodes": {"go": {"type": "SubTree", "tree": "GoTo", "ports": {"x": "1.0"}}},
    }  # fmt: skip
    files = {"trees/MainTree.json": json.dumps(tree)}
    files |= {path: called[path].decode() for path in ("trees/GoTo.json", "actions/GoToPoint.py")}
    plan = make_plan(project(REST + "  ports.MainTree.go.x: {choice: [2]}\n", **files), "main")
    assert drawn(plan, 1).edited(plan.project).trees["MainTree"].nodes["go"].ports["x"] == "2.0"
    assert (port_text(2, real=True), port_text(2), port_text(True, real=True)) == ("2.0", "2", "true")


def test_random_of_the_universe_is_drawn_first_and_vary_wins():
    world = WORLD + "random:\n  crate.mass: [5, 6]\n  walker.speed: [0.1, 0.2]\n"
    plan = make_plan(
        project(REST + "  models.crate.mass: [1, 2]\n", **{"universes/yard.yaml": world}), "main"
    )
    found = drawn(plan, 3).universe
    assert 1 <= found.models[1].mass <= 2
    assert 0.1 <= found.actors[0].speed <= 0.2
    assert found.random == {}


def test_a_place_is_drawn_until_it_is_free_and_the_entry_is_named_if_none_is():
    plan = plan_of({"robot.pose": "{area: start}", "models.crate.pose.x": "[-2, 2]"})
    asked = []

    def overlaps(universe, id_, ignored):
        asked.append((id_, sorted(ignored)))
        return len(asked) < 4

    drawn(plan, 1, overlaps)
    assert asked == [("rob", ["crate"])] * 4 + [("crate", [])]
    with pytest.raises(InvalidRunError, match=r"robot\.pose: no free place in 200 attempts"):
        drawn(plan, 1, lambda *_: True)


@pytest.mark.parametrize(
    ("address", "draw", "words"),
    [
        ("models.crat.mass", "[1, 2]", "names nothing (did you mean models.crate.mass"),
        ("crate.mass", "[1, 2]", "names nothing"),
        ("models.crate.speed", "[1, 2]", "names nothing"),
        ("actors.walker.pose.x", "[1, 2]", "names nothing"),
        ("sensors.scan.topic", "[1, 2]", "names nothing"),
        ("ports.MainTree.go.sped", "[1, 2]", "did you mean ports.MainTree.go.speed"),
        ("robot.pose", "[1, 2]", "a pose is drawn from an `area`"),
        ("robot.pose.x", "{area: start}", "this is no pose"),
        ("robot.pose", "{area: nowhere}", "no area 'nowhere'; it has: start, ahead, behind"),
        ("actors.walker.speed", "[0, 9]", "9.0 is out of its bounds"),
        ("ground.friction", "{choice: [slow]}", "the value is a number"),
        ("sensors.scan.noise_m", "[-1, 0]", "-1.0 is out of its bounds"),
        ("ports.MainTree.go.speed", "{choice: [fast]}", "fast cannot be its value"),
    ],
)
def test_a_wrong_entry_is_refused_at_its_line(address, draw, words):
    with pytest.raises(DocumentError) as caught:
        plan_of(
            {"ground.friction": "[0.5, 1]", address: draw}
            if address != "ground.friction"
            else {address: draw}
        )
    problem = caught.value.problems[0]
    assert words in str(problem)
    assert problem.line == (7 if address == "ground.friction" else 8)


def test_two_entries_for_one_value_and_two_nodes_for_one_name_are_refused():
    with pytest.raises(DocumentError, match="names the same value as robot"):
        plan_of({"robot.pose.x": "[0, 1]", "robots.rob.pose.x": "[0, 1]"})
    nodes = (
        '{"r": {"type": "Sequence", "children": ["a", "b"]}, "a": {"type": "Drive"}, "b": {"type": "Drive"}}'
    )
    tree = f'{{"format": "bt-studio/diagram", "version": 1, "id": "MainTree", "root": "r", "nodes": {nodes}}}'
    entry = REST + "  ports.MainTree.Drive.speed: [0, 1]\n"
    with pytest.raises(
        DocumentError, match=r"several nodes \(use an id: ports\.MainTree\.a\.speed, ports\.MainTree\.b"
    ):
        make_plan(project(entry, **{"trees/MainTree.json": tree}), "main")
