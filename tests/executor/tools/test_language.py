"""Files for a language server."""

from __future__ import annotations

import json

import pytest
from websockets.exceptions import ConnectionClosed

from executor.tools import language
from executor.tools.language import put_files
from tests.executor.tools.test_server import client, tools


@pytest.mark.parametrize("path", ["../x", "/etc/passwd", "a/../../x", ""])
async def test_no_file_leaves_the_folder(tmp_path, path):
    with pytest.raises(PermissionError, match="no place"):
        put_files(tmp_path / "home", {path: "x"})
    async with tools(tmp_path) as (door, _), client(door, "language") as editor:
        await editor.recv()
        await editor.send(json.dumps({"files": {path: "x"}}))
        with pytest.raises(ConnectionClosed) as closed:
            await editor.recv()
        assert closed.value.rcvd.code == language.NO_ROOM
    assert [p.name for p in tmp_path.iterdir()] == ["s"]
