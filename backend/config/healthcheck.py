"""`python -m backend.config.healthcheck`: checks whether the web server of this container is ready.

It runs every few seconds, so it imports little.
"""

from __future__ import annotations

import http.client
import os
import sys

READY = "/health/ready"
TIMEOUT_S = 4


def main() -> int:
    """Sends a request to the server of this machine; returns the exit status."""
    connection = http.client.HTTPConnection(
        "127.0.0.1", int(os.environ.get("BT_STUDIO_PORT") or 8000), timeout=TIMEOUT_S
    )
    try:
        connection.request("GET", READY)
        response = connection.getresponse()
        sys.stdout.write(response.read().decode(errors="replace"))
    except (OSError, http.client.HTTPException) as error:
        sys.stdout.write(f"{error}\n")
        return 1
    return 0 if response.status == 200 else 1


if __name__ == "__main__":
    sys.exit(main())
