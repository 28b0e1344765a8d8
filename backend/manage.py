"""Django's command line, for developers: `python backend/manage.py makemigrations`."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def main() -> None:
    """Runs one of Django's commands."""
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    os.environ.setdefault("DJANGO_SETTINGS_MODULE", "backend.config.settings")
    from django.core.management import execute_from_command_line  # noqa: PLC0415 - needs the path above

    execute_from_command_line(sys.argv)


if __name__ == "__main__":
    main()
