"""Answers to requests, without sockets."""

from __future__ import annotations

import json
import struct

import msgpack
import pytest

from tests.tree_gardener.trees import subtree
from tree_gardener import Tree
from tree_gardener.groot.answers import Answers
from tree_gardener.groot.hooks import Hooks
from tree_gardener.groot.mirror import Mirror
from tree_gardener.groot.protocol import LONGEST_REQUEST, RequestType

HOOK = {"enabled": True, "uid": 1, "mode": 1, "once": False, "desired_status": "FAILURE", "position": 0}


@pytest.fixture
def answers() -> Answers:
    tree = Tree.from_xml(f"<root>{subtree('Main', '<AlwaysSuccess/>')}</root>")
    tree.blackboard.set("text", "é")
    mirror = Mirror(tree, msgpack.packb)
    mirror.read()
    return Answers(tree, mirror, Hooks(tree, lambda uid: None, lambda: None), msgpack.packb)


def header(kind: str) -> bytes:
    return struct.pack("<BBI", 2, ord(kind), 77)


def test_a_reply_repeats_the_header_and_names_the_tree(answers: Answers) -> None:
    first, content = answers.answer([header("S")])
    assert first[:6] == header("S")
    assert first[6:] == answers.id
    assert len(answers.id) == 16
    assert content == b"\x01\x00\x00"


def test_every_type_is_answered(answers: Answers) -> None:
    assert b"<BehaviorTree" in answers.answer([header("T")])[1]
    assert msgpack.unpackb(answers.answer([header("B"), b"Main;Other"])[1]) == {"Main": {"text": "é"}}
    assert len(answers.answer([header("I"), json.dumps(HOOK).encode()])) == 1
    assert json.loads(answers.answer([header("D")])[1]) == [HOOK]
    assert len(answers.answer([header("X")])) == 1
    assert json.loads(answers.answer([header("D")])[1]) == [HOOK | {"enabled": False}]
    unlock = {"uid": 1, "position": 0, "desired_status": "SKIPPED", "remove_when_done": False}
    assert len(answers.answer([header("U"), json.dumps(unlock).encode()])) == 1
    assert len(answers.answer([header("R"), json.dumps({"uid": 1, "position": 0}).encode()])) == 1
    assert len(answers.answer([header("A")])) == 1
    assert int(answers.answer([header("r"), b"start"])[1]) > 0
    assert answers.answer([header("t")])[1:] == [b""]
    assert len(answers.answer([header("r"), b"stop"])) == 1


@pytest.mark.parametrize(
    ("parts", "text"),
    [
        ([header("N")], b"not recognized"),
        ([header("B")], b"2 parts"),
        ([header("I"), b"{}", b""], b"2 parts"),
        ([header("r"), b"pause"], b"'start' or 'stop'"),
        ([header("I"), bytes(LONGEST_REQUEST + 1)], b"are the most"),
    ],
)
def test_a_wrong_request_is_answered_with_an_error(answers: Answers, parts: list[bytes], text: bytes) -> None:
    error, why = answers.answer(parts)
    assert error == b"error"
    assert text in why


CONTENTS = {
    "I": json.dumps(HOOK).encode(),
    "R": b'{"uid": 1, "position": 0}',
    "U": b'{"uid": 1, "position": 0, "desired_status": "SKIPPED", "remove_when_done": false}',
    "B": b"Main",
    "r": b"start",
}


@pytest.mark.parametrize("kind", [each.value for each in RequestType if each is not RequestType.REACHED])
def test_wrong_lengths_and_unknown_ids_of_each_type_are_refused_and_change_nothing(
    answers: Answers, kind: str
) -> None:
    answers.answer([header("I"), CONTENTS["I"]])
    before = answers.answer([header("D")])[1:]
    content = CONTENTS.get(kind)
    whole = header(kind)
    wrong: list[list[bytes]] = [[whole[:length], *([content] if content else [])] for length in range(6)]
    wrong += [[whole + b"x"], [b"\x01" + whole[1:]]]
    if content is not None:
        wrong += [[whole], [whole, content, content], [whole, bytes(LONGEST_REQUEST + 1)]]
    if kind in {"I", "R", "U"}:
        wrong += [[whole, content[:length]] for length in range(len(content or b""))]
        wrong += [
            [whole, json.dumps(json.loads(content or b"") | change).encode()]
            for change in ({"uid": 2}, {"uid": 0}, {"uid": -1}, {"uid": 1 << 40}, {"position": 7})
        ]
        wrong += [[whole, b"[" * 5000], [whole, b"\xff"], [whole, b"null"]]
    for parts in wrong:
        reply = answers.answer(parts)
        assert reply[0] == b"error", parts
        assert len(reply) == 2
        assert reply[1]
    assert answers.answer([header("D")])[1:] == before


def test_a_board_that_is_unknown_is_left_out(answers: Answers) -> None:
    for names in (b"Other", b"main", b"\xff", b"Main/" * 1000):
        assert msgpack.unpackb(answers.answer([header("B"), names])[1]) == {}
