"""Makes accounts for `load` in the database of the settings, signs them in, and prints their cookies."""

from __future__ import annotations

import json
import os
import sys
from importlib import import_module


def main() -> None:
    """Makes as many accounts as the argument says."""
    os.environ.setdefault("DJANGO_SETTINGS_MODULE", "backend.config.settings")
    import django

    django.setup()
    from django.conf import settings
    from django.contrib.auth import BACKEND_SESSION_KEY, HASH_SESSION_KEY, SESSION_KEY

    from backend.accounts.writes import create_account

    cookies = []
    for number in range(int(sys.argv[1])):
        user = create_account(f"editor{number}", email="", password="")
        session = import_module(settings.SESSION_ENGINE).SessionStore()
        session[SESSION_KEY] = str(user.pk)
        session[BACKEND_SESSION_KEY] = settings.AUTHENTICATION_BACKENDS[0]
        session[HASH_SESSION_KEY] = user.get_session_auth_hash()
        session.create()
        cookies.append(f"{settings.SESSION_COOKIE_NAME}={session.session_key}")
    json.dump(cookies, sys.stdout)


if __name__ == "__main__":
    main()
