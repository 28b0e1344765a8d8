"""A tree in a recording: nodes, ticks, writes and keyframes."""

from __future__ import annotations

import json

from py_trees.blackboard import Blackboard

from executor.recorder.tree_recorder import TreeRecorder
from executor.recorder.values import NO_WRITE
from tree_gardener import Status, TickError, Tree
from tree_gardener.debugging import Force
from tree_gardener.debugging.debugger import Debugger

XML = """<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main">
<Sequence name="both">
<Script code="a := 1; b := 'x'"/><Script code="a := 2"/><AlwaysFailure/>
</Sequence></BehaviorTree></root>"""
ONE = '<root BTCPP_format="4"><BehaviorTree ID="M"><AlwaysSuccess/></BehaviorTree></root>'


def recorded(xml=XML):
    said: list = []
    tree = Tree.from_xml(xml)
    recorder = TreeRecorder(
        tree, lambda topic, name, fields: said.append((topic, name, fields)), lambda: 5, lambda _: "?"
    )
    tree.observe(lambda _: recorder.flush())
    return tree, recorder, said


def of(said, topic):
    return [fields for found, _, fields in said if found == topic]


def test_the_nodes_come_first():
    tree, _, said = recorded()
    topic, name, fields = said[0]
    assert (topic, name, fields["stamp"], fields["generation"]) == ("/bt/tree", "Tree", 5, 1)
    assert fields["path"] == [node.path for node in tree.nodes]
    assert fields["parent"][:2] == [0, 1]
    assert json.loads(fields["ports_json"][1]) == {"code": "a := 1; b := 'x'"}


def test_every_write_is_recorded_in_order_with_its_writer():
    tree, _, said = recorded()
    tree.tick_once()
    (written,) = of(said, "/bt/blackboard")
    first, second = (node.uid for node in tree.nodes if node.type == "Script")
    rows = list(zip(written["key"], written["value_json"], written["writer_uid"], strict=True))
    assert rows == [("a", "1", first), ("b", '"x"', first), ("a", "2", second)]
    assert written["tick"] == 1


def test_a_tick_tells_results_that_are_gone_afterwards():
    tree, _, said = recorded()
    tree.tick_once()
    (tick,) = of(said, "/bt/tick")
    names = {node.uid: node.type for node in tree.nodes}
    flashed = {
        names[uid]: status for uid, status in zip(tick["flashed_uid"], tick["flashed_status"], strict=True)
    }
    assert flashed == {"Script": 2, "AlwaysFailure": 3, "Sequence": 3}
    assert tick["changed_uid"] == []  # the root was reset after its FAILURE
    assert tick["number"] == 1


def test_equal_runs_have_equal_fingerprints():
    prints = []
    for _ in range(2):
        tree, _, said = recorded()
        for _ in range(3):
            tree.tick_once()
        prints.append([tick["fingerprint"] for tick in of(said, "/bt/tick")])
    assert prints[0] == prints[1]
    assert len(set(prints[0])) == 3


def test_a_list_that_changes_in_place_is_seen_at_the_next_tick():
    tree, _, said = recorded()
    path = [1]
    tree.blackboard["path"] = path
    tree.tick_once()
    path.append(2)
    tree.tick_once()
    first, second = of(said, "/bt/blackboard")
    assert (first["key"][0], first["value_json"][0], first["writer_uid"][0]) == ("path", "[1]", 0)
    assert (second["key"][-1], second["value_json"][-1], second["writer_uid"][-1]) == (
        "path",
        "[1,2]",
        NO_WRITE,
    )


def test_a_removed_entry_is_recorded():
    tree, _, said = recorded()
    tree.blackboard["gone"] = [1]
    del tree.blackboard["gone"]
    tree.tick_once()
    (written,) = of(said, "/bt/blackboard")
    assert written["removed"][:2] == [False, True]


def test_a_keyframe_holds_all_statuses_and_entries():
    tree, recorder, said = recorded(XML.replace("<AlwaysFailure/>", '<Sleep msec="1000"/>'))
    tree.tick_once()
    recorder.keyframe(240, b"world")
    _, frame = of(said, "/bt/keyframe")
    assert (frame["step"], frame["tick"], frame["world"]) == (240, 1, b"world")
    assert frame["status"] == bytes([1, 2, 2, 1])
    values = {key: value for _, key, _, value in json.loads(frame["blackboard_json"])}
    assert values == {"a": 2, "b": "x"}


def test_faults_and_lines_name_their_node():
    tree, recorder, said = recorded()
    node = tree.nodes[1]
    recorder.says("info", "here", node.path)
    recorder.says("info", "nowhere")
    error = TickError(node, "broken")
    recorder.raised(error)
    assert [line["uid"] for line in of(said, "/bt/log")] == [node.uid, 0]
    (fault,) = of(said, "/bt/fault")
    assert (fault["uid"], "broken" in fault["message"]) == (node.uid, True)


def test_ticks_are_written_after_they_ended_with_their_own_times():
    said: list = []
    now = [1]
    tree = Tree.from_xml(XML)
    recorder = TreeRecorder(tree, lambda *message: said.append(message), lambda: now[0], str)
    for now[0] in (2, 3):
        tree.tick_once()
    now[0] = 9
    assert of(said, "/bt/tick") == []
    assert recorder.waiting == 2
    recorder.says("info", "afterwards")
    assert [fields["stamp"] for _, _, fields in said[2:]] == [2, 2, 3, 3, 9]
    assert [topic for topic, _, _ in said[2:]] == ["/bt/blackboard", "/bt/tick"] * 2 + ["/bt/log"]


def test_a_hold_of_the_debugger_is_left_out_of_the_duration_of_its_tick():
    said: list = []
    tree = Tree.from_xml(XML)
    recorder = TreeRecorder(tree, lambda *message: said.append(message), lambda: 1, str)
    recorder.leave_out(3600.0)
    tree.tick_once()
    tree.tick_once()
    recorder.flush()
    held, after = (tick["duration_ms"] for tick in of(said, "/bt/tick"))
    assert held == 0.0
    assert after > 0.0


def test_keys_of_py_trees_are_in_ticks_and_keyframes_without_a_writer():
    Blackboard.clear()
    try:
        Blackboard.set("/robot/speed", 0.5)
        tree, recorder, said = recorded(ONE)
        tree.tick_once()
        Blackboard.set("/robot/speed", object())
        tree.tick_once()
        recorder.keyframe(1, b"")
    finally:
        Blackboard.clear()
    rows = [
        (fields["tick"], *(fields[name][0] for name in ("scope", "key", "type", "value_json", "writer_uid")))
        for fields in of(said, "/bt/blackboard")
    ]
    scope, key = "py_trees:/robot/", "speed"
    assert rows == [
        (1, scope, key, "double", "0.5", NO_WRITE),
        (2, scope, key, "object", '{"preview":"?"}', NO_WRITE),
    ]
    kept = json.loads(of(said, "/bt/keyframe")[-1]["blackboard_json"])
    assert kept == [[scope, key, "object", {"preview": "?"}]]


def test_what_was_forced_is_recorded_before_its_tick():
    tree, _, said = recorded()
    debugger = Debugger(lambda _: None)
    tree.debug(debugger)
    script = next(node for node in tree.nodes if node.type == "AlwaysFailure")
    debugger.force(Force(script.uid, Status.SUCCESS, once=True))
    tree.tick_once()
    tree.tick_once()
    (forced,) = of(said, "/bt/forced")
    assert (forced["tick"], forced["uid"]) == (1, [script.uid])
    topics = [topic for topic, _, _ in said]
    assert topics.index("/bt/forced") < topics.index("/bt/tick")
