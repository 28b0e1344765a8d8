"""From which address a request comes."""

from __future__ import annotations

from backend.core.clients import address_of, is_on_this_machine


def test_only_proxies_that_the_settings_name_are_believed(settings_of):
    told = {"x-forwarded-for": "203.0.113.5, 10.0.0.1"}
    assert address_of("127.0.0.1", told) == "127.0.0.1"
    settings_of(proxy_hops=1)
    assert address_of("127.0.0.1", told) == "10.0.0.1"
    settings_of(proxy_hops=2)
    assert address_of("127.0.0.1", told) == "203.0.113.5"
    assert address_of("nonsense", {}) is None


def test_a_program_of_this_machine_asks_for_itself():
    assert is_on_this_machine("127.0.0.1", {})
    assert not is_on_this_machine("127.0.0.1", {"x-forwarded-for": "127.0.0.1"})
    assert not is_on_this_machine("10.0.0.1", {})
    assert not is_on_this_machine(None, {})
