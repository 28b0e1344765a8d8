"""Parsers of request bodies."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from rest_framework.exceptions import ParseError
from rest_framework.parsers import JSONParser

from backend.config.environment import environment
from backend.core.problems import StudioError

if TYPE_CHECKING:
    from collections.abc import Mapping


class TooLargeError(StudioError):
    """The body of a request is larger than `BT_STUDIO_MAX_REQUEST_BYTES`."""

    status = 413
    code = "request_too_large"
    title = "Too large"


class StrictJSONParser(JSONParser):
    """Parses JSON in UTF-8; refuses NaN, infinities, NUL and lone surrogates, which cannot be stored."""

    def parse(
        self, stream: Any, media_type: str | None = None, parser_context: Mapping[str, Any] | None = None
    ) -> Any:
        """Returns the value of the whole body."""
        try:
            limit = environment().max_request_bytes
            raw = stream.read(limit + 1)
            if len(raw) > limit:
                raise TooLargeError(f"A request has at most {limit:,} bytes.")
            text = raw.decode("utf-8")
            value = json.loads(text, parse_constant=_refuse_constant)
            if "\\u" in text or "\0" in text:
                _refuse_unstorable(value)
        except RecursionError as error:
            raise ParseError("The JSON is nested too deeply.") from error
        except ValueError as error:
            raise ParseError(f"The body is not valid JSON: {error}.") from error
        return value


def _refuse_constant(name: str) -> None:
    raise ValueError(f"{name} is not a JSON number")


def _refuse_unstorable(value: Any) -> None:
    """Raises a ValueError for text that UTF-8 cannot encode, or that PostgreSQL cannot store."""
    json.dumps(value, ensure_ascii=False).encode("utf-8")
