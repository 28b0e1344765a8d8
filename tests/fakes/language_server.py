"""A language server that does what its argument says.

echo     reads, and answers nothing
dies     ends at its first message
garbage  answers its first message with something that is no message
hungry   takes 200 MB at its first message
"""

from __future__ import annotations

import sys
import time

kind = sys.argv[1]
sys.stdin.buffer.read(20)
if kind == "garbage":
    sys.stdout.buffer.write(b"Hello!\r\n\r\n")
    sys.stdout.buffer.flush()
if kind == "hungry":
    memory = bytearray(b"x") * (200 * 1024 * 1024)
if kind in {"echo", "hungry"}:
    while sys.stdin.buffer.read(1):
        time.sleep(0)
