"""Exact runs with real processes: what entered them enters again, and they do the same to the last bit.

Every tick has a fingerprint of poses, statuses and blackboard; the action of these runs writes a hash of all
that it hears on /scan, /odom and /cmd_vel, and of random numbers, to the blackboard.
"""

from __future__ import annotations

import base64
import random
from typing import TYPE_CHECKING, Any

import pytest
from msgspec import structs

from executor import child_messages, messages
from executor.child_messages import ForWorld, StartApplication
from executor.replay_messages import FINGERPRINT_BYTES, Replay
from executor.run_inputs import input_of
from tests.budget import count
from tests.executor.exact.exact_runs import ExactRun, app_folder, hashing_app, start_message
from tests.executor.exact.test_process import exact, ready
from tests.executor.session_client import ROOT, SessionClient
from tests.executor.test_run_inputs import CHANGE, CHANGE_WORLD
from tests.executor.warm import warm_session
from translator import load, to_app_zip

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.simulation

KINDS = 8


def enter(run: ExactRun, chance: random.Random, folders: list[Path]) -> None:
    """Does one random thing to a run."""
    match chance.randrange(KINDS):
        case 0 | 1:
            run.tell(ForWorld(child_messages.Teleop(chance.uniform(-0.3, 0.3), chance.uniform(-1.0, 1.0))))
        case 2:
            run.pause()
            pose = (chance.uniform(-1, 1), chance.uniform(-1, 1), 0.05, 0.0, 0.0, chance.uniform(-3, 3))
            run.tell(ForWorld(child_messages.MoveBody(id="robot", pose=pose)))
            run.tell(child_messages.SetBlackboard("", "nudge", chance.random()))
        case 3:
            run.tell(child_messages.SetTickRate(tick_hz=chance.choice([7.0, 20.0, 33.0])))
        case 4:
            speed = str(round(chance.uniform(0.1, 0.5), 3))
            port = child_messages.SetPort(node_id="n6", path="Forward::6", port="lin_speed", value=speed)
            run.tell(port)
        case 5:
            twist = {"linear": {"x": chance.uniform(-0.3, 0.3)}, "angular": {"z": 0.5}}
            run.tell(ForWorld(child_messages.PublishTopic("/cmd_vel", "geometry_msgs/msg/Twist", twist)))
        case 6:
            force = messages.Force(5, "Turn::5", status=chance.choice(["SUCCESS", "RUNNING"]), once=True)
            run.tell(child_messages.ForceResult(force=force))
        case 7:
            run.tell(child_messages.ApplyApplication(app_dir=str(chance.choice(folders))))


def again(run: ExactRun, until_s: float | None = None, *, inputs: Any = None) -> ExactRun:
    replay = Replay(run.inputs if inputs is None else inputs, bytes(run.prints), until_s)
    return ExactRun(structs.replace(run.start, replay=replay))


def reached(run: ExactRun) -> Any:
    assert run.said_of(child_messages.Fault) == []
    (there,) = run.said_of(child_messages.WentBack)
    return there


def test_a_run_with_random_inputs_is_made_again_and_runs_on_as_it_did() -> None:
    """Once to the end, once to a moment from which it runs on by itself, and once without one input."""
    for seed in range(count("replayed_runs")):
        chance = random.Random(seed)  # noqa: S311 - a test
        with (
            app_folder() as folder,
            app_folder("        #\n") as other,
        ):
            run = ExactRun(start_message(folder, seed))
            for _ in range(chance.randrange(4, 9)):
                run.run_ticks(chance.randrange(4, 25))
                enter(run, chance, [folder, other])
            run.run_ticks(60)
            run.pause_after_tick()
            state = run.end()
            assert run.said_of(child_messages.Fault) == []
            assert len(run.inputs) >= 4

            whole = again(run)
            assert reached(whole).ticks == len(run.prints) // FINGERPRINT_BYTES
            assert whole.said_of(child_messages.Differs) == []
            assert whole.end() == state

            last = run.inputs[-1]
            before_s = last.step / 240 + 0.5
            branch = again(run, before_s)
            assert branch.said_of(child_messages.Differs) == []
            there = reached(branch)
            assert there.inputs == len(run.inputs)
            assert there.ticks < len(run.prints) // FINGERPRINT_BYTES
            branch.run_ticks(10)
            branch.pause()
            branch.end()
            begin = there.ticks * FINGERPRINT_BYTES
            rest = run.prints[begin : begin + len(branch.prints)]
            assert len(rest) >= 10 * FINGERPRINT_BYTES
            assert bytes(branch.prints[: len(rest)]) == bytes(rest)

            lost = next(at for at, entered in enumerate(run.inputs) if _acts(entered))
            without = again(run, inputs=run.inputs[:lost] + run.inputs[lost + 1 :])
            without.kill()
            assert without.said_of(child_messages.Differs)


def _acts(entered: Any) -> bool:
    """Whether an input surely changes what is seen: a teleoperation is soon replaced by the program's."""
    message = child_messages.decode_to_exact(entered.message)
    command = message.command if isinstance(message, ForWorld) else message
    return isinstance(command, child_messages.MoveBody | child_messages.SetTickRate | child_messages.Teleop)


NOT_EXACT = {
    "time": "        import time\n        self.digest.update(str(time.time()).encode())\n",
    "random": "        import numpy\n        self.digest.update(numpy.random.default_rng().bytes(4))\n",
}


@pytest.mark.parametrize("source", NOT_EXACT)
def test_what_is_not_repeated_is_found_in_its_first_tick(source: str) -> None:
    late = NOT_EXACT[source].replace("        ", "            ")
    more = f"        if self.number >= 9:\n{late}"
    with app_folder(more) as folder:
        run = ExactRun(start_message(folder))
        run.run_ticks(20)
        run.pause()
        run.end()
        copy = again(run)
        (differs,) = copy.said_of(child_messages.Differs)
        assert differs.tick == 9
        reached(copy)
        copy.kill()


def test_a_run_that_died_is_made_again_up_to_its_death() -> None:
    more = "        if self.number == 30:\n            import ctypes; ctypes.string_at(0)\n"
    with app_folder(more) as folder:
        run = ExactRun(start_message(folder))
        run.resume()
        assert run.process.wait(60) < 0
        run.kill()
        known = len(run.prints) // FINGERPRINT_BYTES
        copy = again(run)
        assert reached(copy).ticks == known
        assert known < 30
        copy.kill()


def test_what_enters_while_the_debugger_holds_enters_at_the_same_stop() -> None:
    stop = messages.SetBreakpoints([messages.Breakpoint("MainTree", "n6")])
    with app_folder() as folder:
        start: StartApplication = start_message(folder, breakpoints=stop)
        run = ExactRun(start)
        run.resume()
        for number in range(5):
            run.until(lambda m: isinstance(m, child_messages.Held))
            run.tell(child_messages.SetBlackboard("", "nudge", number))
            run.tell(child_messages.Continue(off=number == 4, request=f"c{number}"))
        run.run_ticks(20)
        run.pause_after_tick()
        state = run.end()
        assert {entered.hook for entered in run.inputs} == {0}
        copy = again(run)
        assert reached(copy).inputs == 10
        assert copy.said_of(child_messages.Differs) == []
        assert copy.end() == state


def test_each_kind_of_change_by_hand_is_made_again_at_its_place() -> None:
    twist = {"linear": {"x": 0.1}, "angular": {"z": 0.5}}
    stop = messages.SetBreakpoints([messages.Breakpoint("MainTree", "n6")])
    with app_folder() as folder, app_folder("        #\n") as other:
        for_world: list[Any] = [
            child_messages.Teleop(0.2, 0.7),
            child_messages.MoveBody(id="robot", pose=(0.4, -0.3, 0.05, 0.0, 0.0, 1.2)),
            child_messages.PublishTopic("/cmd_vel", "geometry_msgs/msg/Twist", twist),
            child_messages.StopRobot(),
            child_messages.Reset(),
        ]
        for_tree: list[Any] = [
            child_messages.SetTickRate(tick_hz=33.0),
            child_messages.SetPort(node_id="n6", path="Forward::6", port="lin_speed", value="0.2"),
            child_messages.SetBlackboard("", "nudge", 0.5),
            child_messages.ForceResult(force=messages.Force(5, "Turn::5", status="RUNNING")),
            child_messages.ReleaseForced(),
            child_messages.ApplyApplication(app_dir=str(other)),
            child_messages.SetBreakpoints(wanted=stop),
        ]
        run = ExactRun(start_message(folder))
        for message in [*map(ForWorld, for_world), *for_tree]:
            run.run_ticks(5)
            run.pause()
            run.tell(message)
        run.resume()
        run.until(lambda m: isinstance(m, child_messages.Held))
        run.tell(child_messages.SetBlackboard("", "nudge", 0.7))
        run.tell(child_messages.Continue(off=True))
        run.run_ticks(10)
        run.pause_after_tick()
        state = run.end()
        refused = [m.error for m in run.said_of(child_messages.Answer) if m.error is not None]
        assert refused == []
        kinds = {type(input_of(child_messages.decode_to_exact(each.message))) for each in run.inputs}
        assert kinds == {type(command) for command in [*CHANGE, *CHANGE_WORLD]}, "no kind is left out"
        copy = again(run)
        assert copy.said_of(child_messages.Differs) == []
        assert reached(copy).inputs == len(run.inputs)
        assert copy.end() == state


async def test_a_session_goes_back_runs_on_and_returns_to_where_it_was() -> None:
    async with warm_session() as (_, client):
        assert await client.ask("subscribe", {"stream": "poses"}) == "ack"
        at = await ready(client, exact(hashing_app()))
        assert await client.ask("set_speed", {"speed": 5.0}) == "ack"
        assert await client.ask("go_back", {"t": -1.0}) != "ack"
        first = await stepped(client, at, 60)
        assert await client.ask("teleop", {"linear": 0.2, "angular": 0.8}) == "ack"
        assert await client.ask("resume") == "ack"
        end = await stepped(client, len(client.events), 120)
        run = client.named("segment")[-1]["run"]

        at = len(client.events)
        assert await client.ask("go_back", {"t": 2.0}) == "ack"
        assert client.state == "paused"
        assert client.named("tick", at)[-1]["n"] == 41
        branch = client.named("branch", at)[-1]
        assert (branch["parent"], branch["from_t"]) == (run, 2.0)
        at = len(client.events)
        assert await client.ask("set_speed", {"speed": 0.3}) == "ack"
        assert await client.ask("resume") == "ack"
        second = await stepped(client, at, 43, max(first))
        assert first.items() <= second.items()

        at = len(client.events)
        assert await client.ask("go_back", {"run": run}) == "ack"
        assert hashes(client, at)[max(end)] == end[max(end)]
        assert (await client.ask("go_back", {"run": "ffffffffffff"}))["code"] == "unknown_run"

        at = len(client.events)
        for bad in ({}, {"run": 1}, {"run": ""}, {"run": "a" * 65}, {"run": "a", "more": 1}):
            assert (await client.ask("drop_branch", bad))["code"] == "bad_data"
        assert (await client.ask("name_branch", {"run": "a", "name": "b" * 81}))["code"] == "bad_data"
        assert await client.ask("drop_branch", {"run": branch["run"]}) == "ack"
        await client.event("segment", lambda d: (d["run"], d["bytes"]) == (branch["run"], 0), after=at)
        assert await client.ask("disconnect") == "ack"


async def test_the_touch_of_a_crate_is_undone_by_a_changed_tree_from_before() -> None:
    async with warm_session() as (_, client):
        near = exact(bump_and_go("0.3"))
        near["universe"]["speed"] = 0.0
        at = await ready(client, near)
        log = await client.event("log", lambda d: "bumped into" in d["text"], after=at)
        touched_s = log["data"]["time"]
        assert await client.ask("pause") == "ack"

        at = len(client.events)
        assert await client.ask("go_back", {"t": touched_s - 3.0}) == "ack"
        before = client.named("tick", at)[-1]
        for bad in ("", "eA==", "@", near["application"]["app_zip_base64"][:-40]):
            refused = await client.ask("run_on", {"app_zip_base64": bad, "more": 1})
            assert refused["code"] == "bad_data"
            if bad:
                refused = await client.ask("run_on", {"app_zip_base64": bad})
                assert refused["code"] in ("bad_archive", "not_applied")
            assert client.state == "paused"
        at = len(client.events)
        far = bump_and_go("1.2")
        assert await client.ask("apply", {"app_zip_base64": far, "dry": True}) == "ack"
        plan = client.named("applied", at)[-1]
        assert (plan["dry"], plan["added"], plan["removed"], plan["halted"]) == (True, [], [], [])
        assert await client.ask("run_on", {"app_zip_base64": far}) == "ack"
        assert client.state == "application_running"
        await client.event("tick", lambda d: d["n"] > before["n"] + 300, after=at)
        assert not [d for d in client.named("log", at) if "bumped into" in d["text"]]

        # The branch has the changed tree from its moment on: it can be taken back, too.
        assert await client.ask("go_back", {"t": touched_s + 2.0}) == "ack"
        assert client.named("differs", at) == []
        assert await client.ask("disconnect") == "ack"


def bump_and_go(distance: str) -> str:
    """Returns the app of *Laser bump and go* that turns at a distance in m."""
    folder = ROOT / "examples/laser_bump_and_go"
    files = {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*.*")}
    files = {name: data for name, data in files.items() if "__pycache__" not in name}
    tree = files["trees/MainTree.json"].decode()
    assert '"obs_dist": "1.0"' in tree
    files["trees/MainTree.json"] = tree.replace('"obs_dist": "1.0"', f'"obs_dist": "{distance}"').encode()
    return base64.b64encode(to_app_zip(load(files))).decode()


async def stepped(client: SessionClient, after: int, ticks: int, last: int = 0) -> dict[int, str]:
    """Pauses after so many ticks, steps three times, or up to a count, and returns what was written."""
    await client.event("tick", lambda d: d["n"] > ticks, after=after)
    assert await client.ask("pause") == "ack"
    at = len(client.events)
    while len(found := hashes(client, at)) < 3 or max(found) < last:
        assert await client.ask("step") == "ack"
    return found


def hashes(client: SessionClient, after: int) -> dict[int, str]:
    """Returns what the action wrote, by its count."""
    found = {}
    for data in client.named("blackboard", after):
        for entry in data["entries"]:
            if entry["key"] == "hash" and entry["value"]:
                number, _, digest = entry["value"].partition(" ")
                found[int(number)] = digest
    return found
