"""Reads foreign JSON; any bytes give a value or a diagnostic with a place."""

from __future__ import annotations

import json
from typing import Any

from translator.diagnostic import Diagnostic, Place, diagnostic
from translator.limits import FILE_BYTES, megabytes


def parse_json(raw: bytes | str, *, file: str) -> tuple[Any, Diagnostic | None]:
    """Returns the parsed value, or None and the diagnostic."""
    if len(raw) > FILE_BYTES:
        found = diagnostic("BT0003", Place(file), size=megabytes(len(raw)), limit=megabytes(FILE_BYTES))
        return None, found
    try:
        text = raw.decode("utf-8-sig") if isinstance(raw, bytes) else raw
        return json.loads(text), None
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        return None, diagnostic("BT0002", Place(file, line=line), byte=error.start)
    except json.JSONDecodeError as error:
        place = Place(file, line=error.lineno, column=error.colno)
        return None, diagnostic("BT0001", place, problem=error.msg)
    except RecursionError:
        return None, diagnostic("BT0001", Place(file, line=1), problem="it is nested too deeply")
    except ValueError as error:  # a number with more digits than Python reads
        return None, diagnostic("BT0001", Place(file, line=1), problem=str(error))
