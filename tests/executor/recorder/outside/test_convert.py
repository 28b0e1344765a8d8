"""Finds out what a file is; and fuzz of all kinds."""

from __future__ import annotations

import random

import pytest
from mcap.reader import make_reader

from executor.recorder.outside.convert import convert_outside
from executor.recorder.outside.errors import OutsideError
from executor.recorder.reader import RecordingError
from tests.executor.recorder.outside.logs import bag, bag_tables, btlog, btsqlite, converted
from tests.executor.recorder.outside.test_bags import MESSAGES_OF_BAG

OURS = "tests/executor/recorder/samples/v1.mcap"


@pytest.mark.parametrize(
    ("data", "text"),
    [
        (b"", "no log of a known kind"),
        (b"hello", "no log of a known kind"),
        (b"\x1f\x8b\x08", "packed by gzip"),
        (b"PK\3\4", "packed by a zip"),
        (b"\x28\xb5\x2f\xfd", "packed by zstd"),
    ],
)
def test_other_files_are_refused(data, text, tmp_path):
    with pytest.raises(OutsideError, match=text) as caught:
        converted(data, tmp_path)
    assert caught.value.code == "not_a_log"


def test_an_empty_folder_is_no_bag(tmp_path):
    with pytest.raises(OutsideError, match=r"no \.mcap or \.db3"):
        converted(tmp_path, tmp_path)


def test_our_own_recording_is_copied_whole(request, tmp_path):
    source, target = request.config.rootpath / OURS, tmp_path / "copy.mcap"
    with target.open("wb") as out:
        convert_outside(source, out)
    counts = []
    for path in (source, target):
        with path.open("rb") as file:
            counts.append(make_reader(file).get_summary().statistics.message_count)
    assert counts[0] == counts[1] > 0


def refusal(data, folder):
    """Returns the error of a conversion, or None."""
    try:
        converted(data, folder)
    except RecordingError as error:
        return error
    return None


@pytest.mark.parametrize("kind", ["btlog", "btsqlite", "mcap", "tables"])
def test_changed_bytes_give_a_located_error_or_a_recording(kind, tmp_path):
    whole = {
        "btlog": btlog,
        "btsqlite": lambda: btsqlite(tmp_path / "a").read_bytes(),
        "mcap": lambda: bag(MESSAGES_OF_BAG),
        "tables": lambda: bag_tables(tmp_path / "b", MESSAGES_OF_BAG).read_bytes(),
    }[kind]()
    chance = random.Random(5)  # noqa: S311 - not for secrets
    for _ in range(150):
        data = bytearray(whole)
        for _ in range(chance.choice((1, 3, 20))):
            data[chance.randrange(len(data))] = chance.choice((0, 1, 0x7F, 0xFF, chance.randrange(256)))
        if chance.random() < 0.2:
            del data[chance.randrange(len(data)) :]
        error = refusal(bytes(data), tmp_path)
        assert error is None or (error.hint and str(error).startswith("f.log:"))
