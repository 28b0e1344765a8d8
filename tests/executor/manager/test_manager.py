"""The manager: its domain, its options and its connections."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest
from websockets.exceptions import InvalidHandshake

from backend.sessions.manager.address import open_socket
from backend.sessions.manager.certificate import make_certificate
from executor.manager.manager import free_domain_id, main
from tests.executor.session_client import TOKEN, manager_process

if TYPE_CHECKING:
    from pathlib import Path


def test_a_session_has_a_domain_of_its_host() -> None:
    assert 0 <= free_domain_id() <= 101


async def test_a_manager_with_a_certificate_speaks_tls_alone(tmp_path: Path) -> None:
    made = make_certificate("session")
    files = tmp_path / "tls.crt", tmp_path / "tls.key"
    for file, text in zip(files, (made.certificate, made.key), strict=True):
        file.write_text(text)
    async with manager_process("--tls-cert", str(files[0]), "--tls-key", str(files[1])) as manager:
        place = f"127.0.0.1:{manager.ready['port']}"
        secure = f"wss://{place}#{made.digest}"
        async with open_socket(
            secure, "control", additional_headers={"Authorization": f"Bearer {TOKEN}"}
        ) as socket:
            assert json.loads(await socket.recv())["command"] == "introspection"
        with pytest.raises((InvalidHandshake, OSError)):
            async with open_socket(place, "control"):
                pass


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("--tls-cert", "missing.crt"), "--tls-cert and --tls-key are given together"),
        (("--tls-key", "missing.key"), "--tls-cert and --tls-key are given together"),
        (("--tls-cert", "missing.crt", "--tls-key", "missing.key"), "are no certificate and its key, as PEM"),
        (("--ram", "--tls-cert", "a", "--tls-key", "b"), "without TLS"),
    ],
)
def test_a_certificate_that_cannot_be_used_is_refused(
    arguments: tuple[str, ...], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["--port", "0", *arguments]) == 2
    assert sentence in capsys.readouterr().err
