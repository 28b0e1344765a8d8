"""Mutated documents: no crash, no hang, and no diagnostic without a place. The seed is printed on failure."""

from __future__ import annotations

import json
import random
import time

import pytest

from tests.budget import count
from tests.fakes.react_diagrams import chain
from tests.translator.conftest import EXAMPLES, example_files
from translator import TranslatorError, check, from_xml, load, self_contained, to_xml
from translator.jderobot.graph import GraphOptions, read_graph
from translator.jderobot.self_contained import is_old_form, read_old_form, write_old_form

LONGEST_S = 20.0  # far longer than any of these small documents needs: only a hang exceeds it
SPICE = [
    "",
    "{",
    "}",
    "{}",
    "{=}",
    "{@a}",
    "\x00",
    "\ud800",
    "\ufffe",
    "]]>",
    "&lt;",
    "<",
    '"',
    "'",
    "../../etc/passwd",
    "NaN",
    "1e999",
    "9" * 400,
    "x" * 5000,
    "_bts_id",
    "SubTree",
    "MainTree",
    "Sequence",
    "true",
    "a := 1",
    "((((",
    "名前",
]
VALUES = [None, True, -1, 1e308, 10**30, [], {}, [[]], {"a": {"b": []}}, *SPICE]


def random_spot(value, chance):
    """Returns a container somewhere inside a JSON value, and one of its keys."""
    while True:
        keys = list(value) if isinstance(value, dict) else list(range(len(value)))
        key = chance.choice(keys)
        inner = value[key]
        if not isinstance(inner, dict | list) or not inner or chance.random() < 0.3:
            return value, key
        value = inner


def mutate_json(raw: bytes, chance: random.Random) -> bytes:
    document = json.loads(raw)
    for _ in range(chance.randint(1, 4)):
        if not document:
            break
        holder, key = random_spot(document, chance)
        action = chance.randrange(4)
        if action == 0:
            holder[key] = chance.choice(VALUES)
        elif action == 1:
            del holder[key]
        elif action == 2:
            other, place = random_spot(document, chance) if document else (holder, key)
            holder[key] = json.loads(json.dumps(other[place]))
        elif isinstance(holder, dict):
            holder[chance.choice(SPICE)] = chance.choice(VALUES)
    raw = json.dumps(document).encode()
    return mutate_bytes(raw, chance) if chance.random() < 0.2 else raw


def mutate_bytes(raw: bytes, chance: random.Random) -> bytes:
    data = bytearray(raw)
    for _ in range(chance.randint(1, 6)):
        at = chance.randrange(len(data) + 1)
        action = chance.randrange(4)
        if action == 0:
            del data[at : at + chance.randint(1, 20)]
        elif action == 1:
            data[at:at] = chance.choice(SPICE).encode("utf-8", "surrogatepass")
        elif action == 2 and data:
            data[at - 1] = chance.randrange(256)
        else:
            start = chance.randrange(len(data) + 1)
            data[at:at] = data[start : start + chance.randint(1, 80)]
    return bytes(data)


def judge(diagnostics) -> None:
    for item in diagnostics:
        assert item.place.file, str(item)
        assert item.message, item.code
        str(item).encode("utf-8", "replace")
        json.dumps(item.to_json())


def exercise(work) -> None:
    started = time.process_time()
    try:
        project = work()
        judge(check(project))
        to_xml(project)
        self_contained(project)
    except TranslatorError as error:
        judge(error.diagnostics or pytest.fail("refused without a reason"))
    assert time.process_time() - started < LONGEST_S


SEEDS = range(4)


@pytest.mark.parametrize("seed", SEEDS)
def test_mutated_diagrams(seed):
    chance = random.Random(seed)  # noqa: S311 - a seed that can be given again
    examples = [example_files(name) for name in EXAMPLES]
    for number in range(count("translator_fuzz") // 2 // len(SEEDS)):
        files = dict(chance.choice(examples))
        path = chance.choice(["trees/MainTree.json", "trees/MainTree.json", "project.json"])
        files[path] = mutate_json(files[path], chance)
        if chance.random() < 0.1:
            graph = mutate_json(chain("Sequence", "Forward").to_bytes(), chance)
            judge(read_graph(graph, GraphOptions("MainTree", "graph.json", True, {}))[1])
        try:
            exercise(lambda files=files: load(files))
        except Exception as error:
            error.add_note(f"seed {seed}, document {number}: {files[path]!r}")
            raise


def xml_corpus() -> list[bytes]:
    corpus = []
    for name in EXAMPLES:
        project = load(example_files(name))
        corpus += [
            to_xml(project).encode(),
            self_contained(project).encode(),
            write_old_form(project).encode(),
        ]
    corpus.append(
        b'<root main_tree_to_execute="M"><BehaviorTree ID="M"><SequenceStar><SubTreePlus ID="S" a="{b}"/>'
        b'<BlackboardCheckInt value_A="{x}" value_B="1"><Action ID="Foo" a="1"/></BlackboardCheckInt>'
        b'</SequenceStar></BehaviorTree><BehaviorTree ID="S"><Foo b="{=}"/></BehaviorTree>'
        b'<include path="x.xml"/><TreeNodesModel><SubTree ID="S"><input_port name="a" default="3"/></SubTree>'
        b"</TreeNodesModel></root>"
    )
    return corpus


@pytest.mark.parametrize("seed", SEEDS)
def test_mutated_xml(seed):
    chance = random.Random(seed)  # noqa: S311 - a seed that can be given again
    corpus = xml_corpus()
    for number in range(count("translator_fuzz") // 2 // len(SEEDS)):
        raw = mutate_bytes(chance.choice(corpus), chance)
        try:
            exercise(lambda raw=raw: (read_old_form if is_old_form(raw) else from_xml)(raw))
        except Exception as error:
            error.add_note(f"seed {seed}, document {number}: {raw!r}")
            raise
