"""Recordings of each version of the format stay readable. A sample is never changed; a version adds one."""

from __future__ import annotations

import json
from pathlib import Path

import msgspec
import pytest
from mcap.reader import make_reader
from mcap.records import Attachment, Metadata
from rosbags.highlevel import AnyReader

from executor.messages import Scene
from executor.recorder.cdr import decode
from executor.recorder.definitions import OURS
from executor.recorder.moment import Moment
from executor.recorder.reader import RecordReader
from executor.recorder.writer import FORMAT_VERSION
from executor.stream.scene_parts import PREFIX

SAMPLES = Path(__file__).with_name("samples")
VERSIONS = range(1, FORMAT_VERSION + 1)
UNIVERSES = {1: "line", 2: "house", 3: "house"}
KEYFRAMES = {1: 1, 2: 2, 3: 2}


@pytest.mark.parametrize("version", VERSIONS)
def test_each_message_of_ours_is_decoded_and_leads_to_the_state_at_the_end(version):
    moment, counts, last = Moment(), dict[str, int](), {}
    with (SAMPLES / f"v{version}.mcap").open("rb") as file:
        for schema, channel, message in make_reader(file).iter_messages():
            assert schema is not None
            counts[channel.topic] = counts.get(channel.topic, 0) + 1
            if schema.name.startswith(OURS):
                last = decode(schema.name, message.data)
                moment.take(schema.name.rpartition("/")[2], last)
    assert {name: counts[name] for name in ("/bt/tree", "/bt/tick", "/bt/keyframe", "/world/scene")} == {
        "/bt/tree": 1,
        "/bt/tick": 21,
        "/bt/keyframe": KEYFRAMES[version],
        "/world/scene": 1,
    }
    state = moment.keyframe(0, 0, b"")
    assert state["tick"] == 20
    entries = {key: value for _, key, _, value in json.loads(state["blackboard_json"])}
    assert "offset" in entries
    assert set(state["status"]) == {0}  # the run was halted at its end


@pytest.mark.parametrize("version", VERSIONS)
def test_it_says_its_version_and_holds_the_project(version):
    with (SAMPLES / f"v{version}.mcap").open("rb") as file:
        records = list(RecordReader(file, "sample"))
    about = next(r.metadata for r in records if isinstance(r, Metadata) and r.name == "bt-studio")
    assert (about["format_version"], about["universe"]) == (str(version), UNIVERSES[version])
    attached = {record.name: record.data for record in records if isinstance(record, Attachment)}
    assert json.loads(attached["project/trees/MainTree.json"])["format"] == "bt-studio/diagram"


@pytest.mark.parametrize("version", VERSIONS)
def test_another_reader_decodes_each_message_with_no_package_installed(version):
    with AnyReader([SAMPLES / f"v{version}.mcap"]) as reader:
        topics = {c.topic for c, _, data in reader.messages() if reader.deserialize(data, c.msgtype)}
    assert {"/bt/tick", "/bt/keyframe", "/scan", "/odom", "/camera/image_raw/compressed", "/tf"} <= topics


@pytest.mark.parametrize("version", VERSIONS)
def test_the_scene_is_whole_with_its_attached_parts(version):
    with (SAMPLES / f"v{version}.mcap").open("rb") as file:
        reader = make_reader(file)
        parts = {a.name.removeprefix(PREFIX): a.data for a in reader.iter_attachments() if PREFIX in a.name}
        ((schema, _, message),) = reader.iter_messages(topics=["/world/scene"])
    assert schema is not None
    scene = msgspec.msgpack.decode(decode(schema.name, message.data)["data"])
    for kind in ("meshes", "textures"):
        scene[kind] = {
            key: msgspec.msgpack.decode(parts[part["hash"]]) if "hash" in part else part
            for key, part in scene.get(kind, {}).items()
        }
    whole = msgspec.convert(scene, Scene)
    assert whole.objects
    assert bool(parts) == (version > 1)


def test_flags_and_gaps_are_there_from_version_3_on():
    with (SAMPLES / "v3.mcap").open("rb") as file:
        found = [
            (schema.name.rpartition("/")[2], decode(schema.name, message.data))
            for schema, _, message in make_reader(file).iter_messages(topics=["/bt/flag", "/bt/gap"])
            if schema is not None
        ]
    told = [(name, {k: v for k, v in fields.items() if k != "stamp"}) for name, fields in found]
    assert told == [
        ("Flag", {"moment": 500_000_000, "id": "f1", "text": "The line bends here", "user": "ada"}),
        ("Flag", {"moment": 700_000_000, "id": "f2", "text": "A mistake", "user": ""}),
        ("Flag", {"moment": 700_000_000, "id": "f2", "text": "", "user": ""}),
        ("Gap", {"reason": "recorder_died", "text": "was killed by SIGKILL"}),
    ]
