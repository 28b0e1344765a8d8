"""Recordings of older versions."""

from __future__ import annotations

import base64
import gzip
import io
import json

import msgspec
import pytest
from mcap.reader import make_reader

from executor.messages import Poses
from executor.recorder.cdr import decode
from executor.recorder.outside.lines import FORMAT, convert_lines
from executor.recorder.reader import RecordingError
from tests.executor.recorder.test_events import NODES, SCAN

HEAD = {"format": FORMAT, "version": 1, "project": "P", "universe": "empty", "seed": 3}
MESH = {"positions": "AAA=", "normals": "", "indices": ""}
LINES = [
    HEAD,
    {"type": "event", "t": 0.5, "tick": 0, "command": "tree", "data": {"nodes": NODES}},
    {"type": "scene", "name": "w", "t": 0.5, "objects": [], "meshes": {"m": MESH}, "lights": []}
    | {"ground_color": [], "sensors": []},
    {"type": "poses", "t": 1.0, "ids": base64.b64encode(b"\1\0").decode(), "poses": ""},
    {"type": "scan", **SCAN, "ranges": base64.b64encode(SCAN["ranges"]).decode()},
    {"type": "camera", "t": 1.0, "jpeg": ""},
]


def write(path, lines, end="\n"):
    text = "\n".join(json.dumps(line) for line in lines) + end
    path.write_bytes(gzip.compress(text.encode()) if path.suffix == ".gz" else text.encode())
    return path


@pytest.mark.parametrize("name", ["old.jsonl", "old.jsonl.gz"])
def test_each_line_becomes_a_message(tmp_path, name):
    out = io.BytesIO()
    assert convert_lines(write(tmp_path / name, LINES), out) == 4
    reader = make_reader(io.BytesIO(out.getvalue()))
    found = {
        channel.topic: (schema.name, message.data) for schema, channel, message in reader.iter_messages()
    }
    assert set(found) == {"/bt/tree", "/world/scene", "/world/poses", "/scan"}
    scene = msgspec.msgpack.decode(decode(*found["/world/scene"])["data"])
    (part,) = reader.iter_attachments()
    assert part.name == f"scene/{scene['meshes']['m']['hash']}"
    assert msgspec.msgpack.decode(part.data)["positions"] == b"\0\0"
    assert msgspec.msgpack.decode(decode(*found["/world/poses"])["data"], type=Poses).ids == b"\1\0"
    about = next(iter(reader.iter_metadata())).metadata
    assert (about["project"], about["seed"]) == ("P", "3")


def test_a_last_line_that_was_cut_is_left_out(tmp_path):
    path = write(tmp_path / "old.jsonl", LINES[:3], end='\n{"type": "poses", "t"')
    assert convert_lines(path, io.BytesIO()) == 2
    packed = tmp_path / "old.jsonl.gz"
    packed.write_bytes(gzip.compress(path.read_bytes())[:-20])
    assert convert_lines(packed, io.BytesIO()) >= 0


@pytest.mark.parametrize(
    ("lines", "place"),
    [
        ([{"format": "other"}], r":1: it does not begin as a recording"),
        (
            [HEAD, {"type": "event", "t": "x", "command": "tick"}, {}],
            r":2: the line is not what its type says",
        ),
        ([HEAD, {"type": "scan", "ranges": 3}], r":2: the line is not what its type says"),
        ([HEAD, [], {}], r":2: the line is no JSON object"),
    ],
)
def test_a_wrong_line_is_named(tmp_path, lines, place):
    with pytest.raises(RecordingError, match=rf"old\.jsonl{place}.*\(Is it a file"):
        convert_lines(write(tmp_path / "old.jsonl", lines), io.BytesIO())


def test_what_is_not_packed_is_refused(tmp_path):
    path = tmp_path / "old.jsonl.gz"
    path.write_bytes(b"no gzip")
    with pytest.raises(RecordingError, match=r"old\.jsonl\.gz:1: it cannot be unpacked"):
        convert_lines(path, io.BytesIO())
