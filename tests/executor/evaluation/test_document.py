"""The format of evaluations: what is right is read, and each wrong line is named."""

import pytest

from executor.evaluation.document import Evaluation
from executor.universes.document import DocumentError, read_yaml
from executor.universes.loader import validate

GOOD = """format: bt-studio/evaluation
version: 1
duration_s: 20
runs: 5
vary:
  robot.pose: {area: start, yaw: [0, 6.283]}
  models.crate.pose.x: [1, 3]
  actors.walker.speed: {normal: [1.0, 0.2], clip: [0.2, 2]}
  ports.MainTree.go.speed: {choice: [0.2, 0.3]}
faults:
  - {kind: sensor_silent, sensor: scan, at_s: [5, 60], for_s: [1, 5], probability: 0.3}
judge:
  success:
    - reach: {area: door, within_s: 20}
    - never: collision
    - never: {closer_than_m: 0.15, to: actors}
    - {visit: [kitchen, hall], in_order: true}
    - tree: SUCCESS
    - {python: judge.py:quality, at_least: {calm: 0.5}}
  measure: [time_to_success_s]
"""


def read(text):
    return validate(read_yaml(text, "e.yaml"), Evaluation, "e.yaml")


def test_the_format_of_the_documentation_is_read():
    found = read(GOOD)
    assert found.most_runs == 5
    assert [item.kind for item in found.judge.success] == [
        "reach",
        "never",
        "never",
        "visit",
        "tree",
        "python",
    ]
    assert found.vary["models.crate.pose.x"].uniform == (1, 3)
    assert found.judge.success[0].deadline_s == 20
    assert found.faults[0].address == "faults.sensor_silent.scan"


@pytest.mark.parametrize(
    ("before", "after", "line", "words"),
    [
        ("runs: 5", "runs: 5\nrun: 6", 5, "run is not known"),
        ("runs: 5", "runs: 5\nuntil: {half_width: 0.1, at_most: 100}", 1, "either `runs: N`"),
        ("runs: 5\n", "", 1, "either `runs: N`"),
        ("runs: 5", "runs: 0", 4, "greater than or equal to 1"),
        ("duration_s: 20", "duration_s: .inf", 3, "duration_s"),
        ("[1, 3]", "[3, 1]", 7, "starts with its lower bound"),
        ("[1, 3]", "{uniform: [1, 3], choice: [1]}", 7, "one of `normal`, `choice` and `area`"),
        ("[1, 3]", "{normal: [1, 3]}", 7, "needs `clip"),
        ("[1, 3]", "{choice: [1], clip: [0, 1]}", 7, "`clip` belongs to `normal`"),
        ("sensor: scan", "topic: /scan", 11, "`topic` has no place in a sensor_silent"),
        ("sensor: scan, ", "", 11, "a sensor_silent needs `sensor`"),
        ("kind: sensor_silent, sensor: scan", "kind: kidnap", 11, "a kidnap needs `area | pose`"),
        ("probability: 0.3", "probability: 1.3", 11, "probability"),
        ("never: collision", "never: {collision: true, to: actors}", 15, "`to` belongs to"),
        ("tree: SUCCESS", "{tree: SUCCESS, reach: {area: door}}", 18, "an item is one of"),
        ("tree: SUCCESS", "{tree: SUCCESS, in_order: true}", 18, "`in_order` belongs to `visit`"),
        (", at_least: {calm: 0.5}", "", 19, "needs thresholds"),
        ("judge.py:quality", "../judge.py:quality", 19, "python"),
        ("[time_to_success_s]", "[time]", 20, "time_to_success_s"),
    ],
)
def test_what_is_wrong_has_a_line(before, after, line, words):
    assert before in GOOD
    with pytest.raises(DocumentError) as caught:
        read(GOOD.replace(before, after, 1))
    problem = caught.value.problems[0]
    assert (problem.line, words in str(problem)) == (line, True), str(problem)
