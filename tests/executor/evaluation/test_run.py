"""Whole runs of small evaluations: outcomes, measures, and what is drawn."""

import pytest
from mcap.reader import make_reader

from executor.evaluation import run
from tests.executor.evaluation.one_by_one import Cells
from tests.executor.evaluation.projects import DRIVE, write

pytestmark = [pytest.mark.simulation, pytest.mark.timeout(300)]
RAISES = DRIVE.replace("twist = Twist()", "raise ValueError('no way')")
ENDS = DRIVE.replace("Status.RUNNING", "Status.SUCCESS")
WAITS = DRIVE.replace("self.publisher = ", "self.node = node\n        self.publisher = ").replace(
    "        twist = Twist()",
    """        import rclpy
        rclpy.spin_until_future_complete(self.node, rclpy.task.Future())
        twist = Twist()""",
)
JUDGE = """def far(truth):
    last = truth.samples[-1]
    return {"x": last.x, "bumps": len(truth.bumps), "walker": last.actors["walker"][0]}


def broken(truth):
    return {"x": truth.nothing}
"""
HEAD = "duration_s: 6\nruns: 2\n"


@pytest.fixture(scope="module")
def cells():
    with Cells() as found:
        yield found


def judged(tmp_path, success, rest="", **options):
    return write(tmp_path, f"{HEAD}judge: {{success: [{success}]{rest}}}\n", **options)


def test_a_goal_ends_the_run_and_its_measures_are_taken_then(tmp_path, cells):
    measures = ", measure: [time_to_success_s, path_length_m, smallest_clearance_m, mean_speed_m_s, energy_j]"
    folder = judged(tmp_path, "{reach: {area: ahead, within_s: 5}}, {never: collision}", measures)
    found = cells(folder)
    assert (found.outcome, found.why) == ("success", "all items hold")
    assert 2 < found.end_s < 4
    assert found.measures["time_to_success_s"] == found.end_s
    assert 0.98 < found.measures["path_length_m"] < 1.05
    assert found.measures["mean_speed_m_s"] == pytest.approx(
        found.measures["path_length_m"] / found.end_s, abs=1e-5
    )
    assert (
        1.6 < found.measures["smallest_clearance_m"] < 1.8
    )  # the wall begins at 2.9 m, the robot ends at 1.18 m
    assert found.measures["energy_j"] > 0
    assert [item["holds"] for item in found.items] == [True, True]
    assert found.items[0]["margin"] == pytest.approx(5 - found.end_s)
    assert found.path[0] == [0, 0, 0]
    assert found.path[-1][1] == pytest.approx(1, abs=0.05)
    assert found.seen == {"go": "R"}
    assert cells(folder, to_the_end=True).outcome == "success"
    assert cells(folder, to_the_end=True).path[-1][1] > 2


def test_a_collision_is_a_failure_at_its_time_and_place(tmp_path, cells):
    source = DRIVE.replace("default=0.5", "default=1.0")
    found = cells(judged(tmp_path, "{never: collision}", action=source))
    assert found.outcome == "failure"
    [(at_s, x, _, body)] = found.bumps
    assert (body, at_s) == (
        "wall",
        found.end_s if at_s == found.end_s else pytest.approx(found.end_s, abs=1e-3),
    )
    assert 2.6 < x < 2.8
    assert found.items[0]["margin"] == pytest.approx(found.end_s - 6, abs=1e-5)


def test_closeness_is_a_failure_before_a_collision(tmp_path, cells):
    found = cells(judged(tmp_path, "{never: {closer_than_m: 1, to: models}}"))
    assert found.outcome == "failure"
    assert found.bumps == []
    assert found.path[-1][1] == pytest.approx(2.9 - 1 - 0.18, abs=0.05)


def test_a_finished_root_ends_ticking_and_not_the_run(tmp_path, cells):
    found = cells(judged(tmp_path, "{reach: {area: behind}}, {tree: SUCCESS}", action=ENDS))
    assert (found.outcome, found.end_s, found.why) == ("failure", 6, "reach behind")
    assert [item["holds"] for item in found.items] == [False, True]
    assert found.items[0]["margin"] == pytest.approx(-1.5, abs=0.1)
    assert found.seen == {"go": "S"}
    assert cells(judged(tmp_path, "{tree: SUCCESS}", action=ENDS)).outcome == "success"


def test_an_exception_is_an_error_with_its_line(tmp_path, cells):
    found = cells(judged(tmp_path, "{never: collision}", action=RAISES))
    assert found.outcome == "error"
    assert found.why == "actions/Drive.py:13:1: go: ValueError: no way"
    found = cells(judged(tmp_path, "{never: collision}", action="__import__('nothing_here')\n" + DRIVE))
    assert found.outcome == "error"
    assert "nothing_here" in found.why


def test_a_run_ends_also_while_an_action_waits(tmp_path, cells):
    found = cells(judged(tmp_path, "{never: collision}", action=WAITS))
    assert (found.outcome, found.end_s) == ("success", 6)


def test_a_function_of_the_project_judges(tmp_path, cells):
    judge = {"evaluations/judge.py": JUDGE}
    folder = judged(tmp_path, "{python: 'judge.py:far', at_least: {x: 2}, at_most: {walker: 0.1}}", **judge)
    found = cells(folder)
    assert found.outcome == "success"
    assert found.measures["x"] == pytest.approx(2.7, abs=0.2)
    assert found.measures["bumps"] == 1
    folder = judged(tmp_path, "{python: 'judge.py:far', at_least: {x: 4}}", **judge)
    assert cells(folder).outcome == "failure"
    folder = judged(tmp_path, "{python: 'judge.py:broken', at_least: {x: 2}}", **judge)
    found = cells(folder)
    assert (found.outcome, found.why[:50]) == (
        "error",
        "evaluations/judge.py:7:1: AttributeError: 'Truth' "[:50],
    )
    folder = judged(tmp_path, "{python: 'judge.py:nobody', at_least: {x: 2}}", **judge)
    assert cells(folder).why == "evaluations/judge.py:1:1: there is no function 'nobody'"


def test_what_is_drawn_is_what_runs_and_equal_seeds_are_equal(tmp_path, cells):
    vary = "vary: {robot.pose: {area: start, yaw: [0, 6.283]}, ports.MainTree.go.speed: [0.1, 0.5]}\n"
    folder = write(tmp_path, f"{HEAD}{vary}judge: {{success: [{{never: {{closer_than_m: 0.01}}}}]}}\n")
    first, second = cells(folder, 1), cells(folder, 2)
    assert first.path[0][1:] == [round(value, 3) for value in first.drawn["robot.pose"][:2]]
    assert first.drawn != second.drawn
    for found in (first, second):
        speed = found.drawn["ports.MainTree.go.speed"]
        assert found.measures["path_length_m"] == pytest.approx(speed * found.end_s, abs=0.1)
    assert cells(folder, 1).to_line() == first.to_line()


def test_a_world_without_a_free_place_is_invalid(tmp_path, cells):
    vary = "vary: {models.crate.pose.x: {choice: [0.1]}, models.crate.pose.y: {choice: [0]}}\n"
    found = cells(write(tmp_path, f"{HEAD}{vary}judge: {{success: [{{never: collision}}]}}\n"))
    assert (found.outcome, found.why) == ("invalid", "models.crate.pose.y: no free place in 200 attempts")


def test_a_run_can_be_recorded(tmp_path, cells):
    folder = judged(tmp_path / "p", "{reach: {area: ahead}}")
    target = tmp_path / "run.mcap"
    recorded = cells(folder, recording=str(target))
    assert target.stat().st_size > 1000
    assert recorded.to_line() == cells(folder).to_line()
    with target.open("rb") as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    assert summary.statistics is not None
    # The tree is halted at the end of a recording: the moment of the decision lies before it.
    after_s = summary.statistics.message_end_time / 1e9 - recorded.end_s
    assert after_s == pytest.approx(run.AFTER_S, abs=0.1)


def test_what_happens_after_the_decision_of_a_recorded_run_changes_nothing(tmp_path, cells):
    """The robot reaches its goal; what its action would raise a little later is not of the outcome."""
    faults = "faults: [{kind: action_raises, node: go, at_s: 2.6}]\n"
    text = f"{HEAD}{faults}judge: {{success: [{{reach: {{area: ahead}}}}, {{never: collision}}]}}\n"
    folder = write(tmp_path / "p", text)
    plain = cells(folder)
    assert plain.outcome == "success"
    assert plain.end_s < 2.6 < plain.end_s + run.AFTER_S
    assert cells(folder, recording=str(tmp_path / "run.mcap")).to_line() == plain.to_line()
