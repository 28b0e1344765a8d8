"""The renderer that works on this machine."""

from __future__ import annotations

import pytest

from executor.render import choose
from executor.render.choose import make_renderer
from executor.render.interface import RenderError


def failing() -> None:
    raise RenderError("there is no EGL")


def test_without_opengl_the_slower_one_draws(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("BT_STUDIO_RENDERER", raising=False)
    monkeypatch.setattr(choose, "GlRenderer", failing)
    renderer = make_renderer()
    assert renderer.name == "TinyRenderer"
    renderer.close()
    with pytest.raises(RenderError):
        make_renderer("gl")


def test_the_environment_may_choose(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BT_STUDIO_RENDERER", "tiny")
    renderer = make_renderer()
    assert renderer.name == "TinyRenderer"
    renderer.close()
