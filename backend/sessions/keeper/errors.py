"""Errors of the keeper: `KeeperError` with a status for HTTP, a code and a sentence."""

from __future__ import annotations


class KeeperError(Exception):
    """A request failed; `log` holds the last lines of an executor that failed."""

    def __init__(self, status: int, code: str, detail: str, log: str = "") -> None:
        super().__init__(detail)
        self.status = status
        self.code = code
        self.detail = detail
        self.log = log
