"""Errors of the gate: `GateError` with a code, a sentence and a hint."""

from __future__ import annotations


class GateError(Exception):
    """The gate cannot carry out a request, or does not answer."""

    def __init__(self, code: str, detail: str, hint: str = "") -> None:
        super().__init__(f"{code}: {detail} {hint}".rstrip())
        self.code = code
        self.detail = detail
        self.hint = hint
