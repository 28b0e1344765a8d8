"""A real S3-compatible server (moto) as a process of its own, with an empty bucket."""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from pathlib import Path

import requests

from backend.core.objects.store import the_store
from tests.backend.services import TIMEOUT_S, await_service

BUCKET = "studio"


class Bucket:
    """The server with its bucket, and the settings of a web server that uses it."""

    def __init__(self, process, origin):
        self.process, self.origin = process, origin
        self.settings = {
            "object_store": f"{origin}/{BUCKET}",
            "object_store_key": "key",
            "object_store_secret": "secret",
        }
        self.variables = {f"BT_STUDIO_{name.upper()}": value for name, value in self.settings.items()}

    def keys(self):
        """The names of all objects."""
        listed = requests.get(f"{self.origin}/{BUCKET}?list-type=2", timeout=TIMEOUT_S).text
        return set(re.findall(r"<Key>(.*?)</Key>", listed))

    def fresh(self):
        """Empties the server, and makes the bucket."""
        assert requests.post(f"{self.origin}/moto-api/reset", timeout=TIMEOUT_S).ok
        assert requests.put(f"{self.origin}/{BUCKET}", timeout=TIMEOUT_S).ok

    def put(self, key, data=b"lost"):
        """Writes an object past our code; the store must be set."""
        the_store()._client.put_object(Bucket=BUCKET, Key=key, Body=data)

    def end(self):
        self.process.kill()
        self.process.wait()


@contextmanager
def bucket():
    """A server with one empty bucket, on a free port."""
    command = [sys.executable, "-m", "moto.server", "-H", "127.0.0.1", "-p", "0"]
    with tempfile.NamedTemporaryFile() as log:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=log)

        def running():
            return re.search(r"Running on (http://127\.0\.0\.1:\d+)", Path(log.name).read_text())

        try:
            await_service(running, process)
            made = Bucket(process, running()[1])
            made.fresh()
            yield made
        finally:
            process.kill()
            process.wait()
