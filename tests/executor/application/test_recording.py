"""A tree that is recorded over a link."""

from __future__ import annotations

import secrets

import pytest

from executor.application.recording import MOST_TICKS, RESET_S, ApplicationRecorder
from executor.recorder.link import BATCH_S, Mark, Record, Until
from executor.recorder.sources import listen, take_source
from tree_gardener import Tree

XML = """<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main">
<Sequence><Script code="a := 1"/><AlwaysSuccess/></Sequence></BehaviorTree></root>"""


def test_each_run_begins_with_the_tree_and_its_state():
    address = f"bt-studio-test-{secrets.token_hex(8)}"
    with listen(address) as listener:
        tree = Tree.from_xml(XML)
        recorder = ApplicationRecorder(tree, lambda: 2.0, address)
        recorder.begin("a1")
        source = take_source(listener)
        assert source is not None
        tree.tick_exactly_once()
        recorder.begin("b2")
        tree.tick_exactly_once()
        recorder.close()
        messages = list(source.messages())
        source.connection.close()
    marks = [(m.run if isinstance(m, Mark) else m.name) for m in messages if isinstance(m, Mark | Record)]
    assert marks[:5] == ["a1", "Tree", "Keyframe", "Blackboard", "Tick"]
    assert marks[marks.index("b2") :][:3] == ["b2", "Tree", "Keyframe"]
    generations = [m.fields["generation"] for m in messages if isinstance(m, Record) and m.name == "Tree"]
    assert generations == [1, 2]
    assert {m.fields["stamp"] for m in messages if isinstance(m, Record)} == {2_000_000_000}


def test_a_port_with_another_text_is_recorded_from_then_on():
    address = f"bt-studio-test-{secrets.token_hex(8)}"
    with listen(address) as listener:
        tree = Tree.from_xml(XML)
        recorder = ApplicationRecorder(tree, lambda: 2.0, address)
        recorder.changed()  # nothing is recorded yet
        recorder.begin("a1")
        source = take_source(listener)
        assert source is not None
        tree.tick_exactly_once()
        script = next(node for node in tree.nodes if node.type == "Script")
        script.ports = {"code": "a := 2"}
        recorder.changed()
        tree.tick_exactly_once()
        recorder.close()
        messages = [message for message in source.messages() if isinstance(message, Record)]
        source.connection.close()
    trees = [message.fields for message in messages if message.name == "Tree"]
    place = script.uid - 1
    assert [fields["generation"] for fields in trees] == [1, 2]
    assert ["2" in fields["ports_json"][place] for fields in trees] == [False, True]
    names = [message.name for message in messages]
    assert names.index("Tick") < names.index("Tree", 1)  # what was before precedes it
    ticks = [message.fields["generation"] for message in messages if message.name == "Tick"]
    assert ticks == [1, 2]


def test_without_a_recorder_the_tree_is_not_observed():
    tree = Tree.from_xml(XML)
    recorder = ApplicationRecorder(tree, lambda: 0.0, "")
    recorder.begin("a1")
    recorder.pump()
    tree.tick_exactly_once()
    recorder.close()
    assert recorder._recorder is None


def test_after_a_reset_a_run_begins_when_the_time_has_gone_back():
    address = f"bt-studio-test-{secrets.token_hex(8)}"
    now = [30.0]
    with listen(address) as listener:
        tree = Tree.from_xml(XML)
        recorder = ApplicationRecorder(tree, lambda: now[0], address)
        recorder.begin("a1", resets=True)
        recorder.pump()
        with pytest.raises(BlockingIOError):
            listener.accept()
        now[0] = 0.1
        recorder.pump()
        source = take_source(listener)
        assert source is not None
        messages = list(source.messages())
        source.connection.close()
        recorder.close()
    assert messages[0] == Mark("a1")
    assert {m.fields["stamp"] for m in messages if isinstance(m, Record)} == {100_000_000}


def test_where_time_never_goes_back_a_run_begins_after_a_while():
    address = f"bt-studio-test-{secrets.token_hex(8)}"
    real = [0.0]
    with listen(address) as listener:
        recorder = ApplicationRecorder(Tree.from_xml(XML), lambda: 0.0, address, lambda: real[0])
        recorder.begin("a1", resets=True)
        recorder.pump()
        with pytest.raises(BlockingIOError):
            listener.accept()
        real[0] = RESET_S
        recorder.pump()
        source = take_source(listener)
        assert source is not None
        assert next(source.messages()) == Mark("a1")
        source.connection.close()
        recorder.close()


def test_ticks_are_written_with_a_batch_or_when_many_wait():
    address = f"bt-studio-test-{secrets.token_hex(8)}"
    with listen(address) as listener:
        tree = Tree.from_xml(XML)
        real = [100.0]
        recorder = ApplicationRecorder(tree, lambda: 2.0, address, lambda: real[0])
        recorder.begin("a1")
        source = take_source(listener)
        assert source is not None
        recorder.pump()
        list(source.messages())
        for _ in range(MOST_TICKS + 1):
            tree.tick_exactly_once()
            recorder.pump()
        assert list(source.messages()) == []
        real[0] += BATCH_S
        recorder.pump()
        messages = list(source.messages())
        source.connection.close()
        recorder.close()
    numbers = [m.fields["number"] for m in messages if isinstance(m, Record) and m.name == "Tick"]
    assert numbers == list(range(1, MOST_TICKS + 2))
    assert messages[-1] == Until(2_000_000_000)
