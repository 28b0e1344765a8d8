"""Without its libraries the protocol says which to install."""

from __future__ import annotations

import sys

import pytest

from tree_gardener.groot.libraries import libraries


@pytest.mark.parametrize("missing", ["zmq", "msgpack"])
def test_a_missing_library_is_named(missing: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert [module.__name__ for module in libraries()] == ["zmq", "msgpack"]
    monkeypatch.setitem(sys.modules, missing, None)
    with pytest.raises(ModuleNotFoundError, match="pip install pyzmq msgpack"):
        libraries()
