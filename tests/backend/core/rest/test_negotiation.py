"""`Accept` changes nothing."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from rest_framework.settings import api_settings

from backend.core.rest.negotiation import IgnoreClientNegotiation


@pytest.mark.parametrize("accept", ["text/html", "image/png;q=0.1", "nonsense"])
def test_the_representation_is_the_endpoints_own(api, accept: str) -> None:
    api.get("projects", accept=accept)
    assert IgnoreClientNegotiation.__name__ in str(api_settings.DEFAULT_CONTENT_NEGOTIATION_CLASS)
    assert "json" in api.response.headers["Content-Type"]


def test_a_body_of_another_type_has_no_parser() -> None:
    request: Any = SimpleNamespace(content_type="text/csv")
    parsers = [SimpleNamespace(media_type="application/json")]
    assert IgnoreClientNegotiation().select_parser(request, parsers) is None
    request.content_type = "application/json; charset=utf-8"
    assert IgnoreClientNegotiation().select_parser(request, parsers) is parsers[0]
