"""Commands of the older dialect as our own."""

from __future__ import annotations

import base64
import io
import json
import zipfile
from typing import Any

import pytest

from executor.ram.translate import RamError, to_native


@pytest.mark.parametrize(
    ("data", "universe"),
    [
        ({"name": "x", "scene": {"name": "Warehouse", "type": "gz"}}, "warehouse"),
        ({"name": "maze", "launch_file_path": ""}, "maze"),
        ({"name": "x", "scene": {"name": "y", "launch_file_path": "/o/simple_circuit.launch.py"}}, "circuit"),
        ({"name": "Obstacle Avoidance Default"}, "circuit_obstacles"),
        ({"name": "x", "scene": {"name": "y", "type": None}}, "empty"),
    ],
)
def test_worlds_are_found_by_name_and_launch_file(data, universe):
    native = to_native("launch_world", data)
    assert (native.command, getattr(native.data, "universe", None)) == ("launch_universe", universe)


def test_a_world_in_a_zip_is_refused():
    with pytest.raises(RamError, match="zip"):
        to_native("launch_world", {"name": "empty", "scene": {"name": "empty", "zip": "data:,"}})


@pytest.mark.parametrize(
    ("settings", "expected"),
    [
        (None, (20.0, "repeat")),
        ({"tick_hz": 5, "on_finish": "stop"}, (5.0, "stop")),
        ({"tick_hz": -5}, (20.0, "repeat")),
        ([], (20.0, "repeat")),
    ],
)
def test_our_own_zips_bring_their_settings(settings, expected):
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        if settings is not None:
            archive.writestr("project.json", json.dumps(settings))
    code = f"data:application/zip;base64,{base64.b64encode(packed.getvalue()).decode()}"
    native = to_native("run_application", {"code": code})
    data: Any = native.data
    assert (data.tick_hz, data.on_finish) == expected
