"""Options of `python -m executor.tools`; `test_tools_pods.py` of the back end starts it with TLS."""

from __future__ import annotations

import pytest

from executor.tools.__main__ import main

TLS = ("--tls-cert", "missing.crt", "--tls-key", "missing.key")


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((), "one of --gate and --host is given"),
        (("--gate", "/door", "--host", "127.0.0.1"), "one of --gate and --host is given"),
        (("--host", "127.0.0.1"), "--host is given together with --tls-cert and --tls-key"),
        (("--host", "127.0.0.1", *TLS), "are no certificate and its key, as PEM"),
    ],
)
def test_options_that_cannot_be_used_are_said(
    arguments: tuple[str, ...],
    sentence: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setenv("TOKEN", "secret")
    with pytest.raises(SystemExit) as ended:
        main(["--token-env", "TOKEN", *arguments])
    assert ended.value.code == 2
    assert sentence in capsys.readouterr().err


def test_without_a_token_nobody_is_served(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.delenv("TOKEN", raising=False)
    with pytest.raises(SystemExit):
        main(["--token-env", "TOKEN", "--gate", "/door"])
    assert "holds no token" in capsys.readouterr().err


def test_a_gate_that_is_not_there_is_said(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path
) -> None:
    monkeypatch.setenv("TOKEN", "secret")
    monkeypatch.setattr("executor.tools.__main__.fetch_listener", _no_gate)
    assert main(["--token-env", "TOKEN", "--gate", str(tmp_path / "gate.sock")]) == 1
    assert "no socket from the gate" in capsys.readouterr().err


def _no_gate(*_: object) -> None:
    raise FileNotFoundError("there is no gate")
