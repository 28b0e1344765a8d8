"""The settings of a project."""

from __future__ import annotations

from translator.settings import Settings, read_settings, restore_settings


def test_what_is_written_reads_back() -> None:
    settings = Settings(name="Robot", tick_hz=10, robot="waffle")
    assert restore_settings(settings.to_json()) == (settings, ())
    assert settings.to_json()["tick_hz"] == 10
    assert "robot" not in Settings().to_json()


def test_a_wrong_setting_is_reported_and_gets_its_default() -> None:
    settings, [found] = read_settings(b'{"name": "Robot", "tick_hz": 0}')
    assert (settings.name, settings.tick_hz) == ("Robot", Settings().tick_hz)
    assert (found.code, found.values["setting"]) == ("BT0030", "tick_hz")


def test_what_is_no_object_gives_the_defaults() -> None:
    assert [found.code for found in read_settings(b"[]")[1]] == ["BT0004"]
    assert [found.code for found in read_settings(b"[")[1]] == ["BT0001"]


def test_what_is_nested_too_deeply_gives_the_defaults() -> None:
    for levels in (600, 900, 100_000):
        text = '{"name": "Robot", "maintainer": ' + '{"a":' * levels + "1" + "}" * (levels + 1)
        settings, [found] = read_settings(text)
        assert settings == Settings()
        assert (found.code, found.values["problem"]) == ("BT0001", "it is nested too deeply")
