"""The reference page of the protocol."""

from __future__ import annotations

import re
from pathlib import Path

import executor
from executor.generate import protocol_page
from executor.generate.protocol_page import PAGE, main, page

EXECUTOR = Path(executor.__file__).parent


def test_the_page_in_the_docs_is_up_to_date():
    assert PAGE.read_text() == page()
    assert main(["--check"]) == 0


def test_every_error_code_is_explained():
    modules = ("steps", "running", "waits", "hangs/watch", "immediate", "protocol")
    paths = [*(f"session/{name}" for name in modules), "manager/server"]
    sources = "".join((EXECUTOR / f"{name}.py").read_text() for name in paths)
    codes = set(re.findall(r'(?:StepFailed\(|_?refuse\(\w+, (?:\w+, )?)\s*"(\w+)"', sources))
    codes |= set(re.findall(r'NOT_ANSWERING: Final = "(\w+)"', sources))
    assert {"cancelled", "wrong_state", "unknown_command", "tick_hangs", "not_answering"} <= codes
    assert codes <= set(protocol_page._ERRORS)
