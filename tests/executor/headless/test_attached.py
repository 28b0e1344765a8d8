"""A recording of a tree of another program can be read like any other, also after a full disk."""

from __future__ import annotations

import resource
from typing import TYPE_CHECKING, Any

import pytest
from mcap.reader import make_reader

from executor.headless.attached import AttachedFile
from executor.headless.errors import HeadlessError
from executor.recorder.cdr import decode
from tests.tree_gardener.debugging.hooked import free_port
from tests.tree_gardener.groot.cpp_program import XML
from tree_gardener import Tree
from tree_gardener.groot import Groot2Publisher
from tree_gardener.groot.client import Groot2Client

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


def messages_of(path: Path) -> list[tuple[str, dict[str, Any]]]:
    with path.open("rb") as file:
        return [
            (channel.topic, decode(schema.name, message.data))
            for schema, channel, message in make_reader(file).iter_messages()
            if schema is not None
        ]


@pytest.fixture
def client() -> Iterator[Groot2Client]:
    port = free_port()
    tree = Tree.from_xml(XML)
    with Groot2Publisher(tree, port), Groot2Client("127.0.0.1", port, 60.0) as client:
        client.ticked = tree.tick_exactly_once  # type: ignore[attr-defined]
        yield client


def test_two_trees_and_their_changes_are_recorded(tmp_path: Path, client: Any) -> None:
    path, now_s = tmp_path / "seen.mcap", [100.0]
    file = AttachedFile(path, "robot:1667", lambda: now_s[0])
    tree = client.tree()
    file.tree(tree, client)
    for _ in range(3):
        now_s[0] += 1.0
        client.ticked()
        file.look(client, client.blackboards(tree.scopes))
    file.tree(tree, client)  # the program was started again
    file.resume(client)
    file.close()
    found = messages_of(path)
    trees = [fields for topic, fields in found if topic == "/bt/tree"]
    assert [each["generation"] for each in trees] == [1, 2]
    assert trees[0]["path"][:3] == ["top", "Script", "mine"]
    ticks = [fields for topic, fields in found if topic == "/bt/tick"]
    assert 1 in ticks[0]["changed_uid"]
    assert ticks[0]["stamp"] <= ticks[-1]["stamp"] <= 3_000_000_000
    written = {key for topic, each in found if topic == "/bt/blackboard" for key in each["key"]}
    assert {"a", "b"} <= written
    with path.open("rb") as opened:
        reader = make_reader(opened)
        assert [each.name for each in reader.iter_attachments()] == ["tree_1.xml", "tree_2.xml"]
        (about,) = (each.metadata for each in reader.iter_metadata())
    assert about["attached"] == "robot:1667"


def test_a_full_disk_stops_the_recording_alone(
    tmp_path: Path, client: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "seen.mcap"
    file = AttachedFile(path, "robot")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (path.stat().st_size + 10, before[1]))
    try:
        file.tree(client.tree(), client)
        client.ticked()
        file.look(client, {})
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    file.look(client, {})
    file.close()
    assert "the recording stops here" in capsys.readouterr().err


def test_a_file_that_cannot_be_written_is_said(tmp_path: Path) -> None:
    with pytest.raises(HeadlessError, match="cannot be written"):
        AttachedFile(tmp_path / "no" / "seen.mcap", "robot")
    with pytest.raises(HeadlessError, match=r"ends with \.mcap"):
        AttachedFile(tmp_path / "seen.btlog", "robot")
