"""Describes the authentication of the API in the OpenAPI document."""

from __future__ import annotations

from typing import Any

from drf_spectacular.extensions import OpenApiAuthenticationExtension


class GuardScheme(OpenApiAuthenticationExtension):  # type: ignore[no-untyped-call]
    """Authentication by the browser's cookie, or by a program's token."""

    target_class = "backend.accounts.api.authentication.GuardAuthentication"
    name = ["cookie", "token"]  # noqa: RUF012 - what the base class asks for

    def get_security_definition(self, auto_schema: Any) -> list[dict[str, str]]:
        """Returns the definitions of both schemes."""
        return [
            {
                "type": "apiKey",
                "in": "cookie",
                "name": "bt_studio_session_<port>",
                "description": "Set by the link that `bt-studio serve` prints.",
            },
            {"type": "http", "scheme": "bearer", "description": "The token of that link, for programs."},
        ]
