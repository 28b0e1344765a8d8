"""Django's settings, derived from `environment`; importing this writes nothing."""

from __future__ import annotations

import secrets
from pathlib import Path
from typing import Any

from backend import __version__
from backend.config.environment import environment

ENVIRONMENT = environment()


def _secret_key() -> str:
    """The key that `serve` keeps in the data folder, or one for this process alone."""
    try:
        return (ENVIRONMENT.data_dir / "secret_key").read_text(encoding="ascii").strip()
    except FileNotFoundError:
        return secrets.token_urlsafe(48)


SECRET_KEY = _secret_key()
DEBUG = False
# The guard judges hosts, for pages and sockets alike (`backend/config/guard.py`).
ALLOWED_HOSTS = ["*"]
ROOT_URLCONF = "backend.config.urls"
ASGI_APPLICATION = "backend.config.asgi.application"
INSTALLED_APPS = [
    "django.contrib.auth",
    "django.contrib.contenttypes",
    "rest_framework",
    "drf_spectacular",
    "backend.accounts",
    "backend.catalog",
    "backend.projects",
    "backend.sessions",
]
MIDDLEWARE = [
    "backend.config.middleware.SecurityHeaders",
    "backend.config.middleware.Guard",
    "backend.config.static.FrontEndFiles",
    "django.middleware.http.ConditionalGetMiddleware",
]
TEMPLATES: list[dict[str, Any]] = [
    {
        "BACKEND": "django.template.backends.django.DjangoTemplates",
        "DIRS": [Path(__file__).parent / "templates"],
        "OPTIONS": {},
    }
]
AUTH_USER_MODEL = "accounts.User"
DEFAULT_AUTO_FIELD = "django.db.models.BigAutoField"
DATABASES: dict[str, dict[str, Any]] = {
    "default": {
        "ENGINE": "django.db.backends.sqlite3",
        "NAME": ENVIRONMENT.data_dir / "bt-studio.sqlite3",
        "OPTIONS": {
            # A writer takes its lock at BEGIN, so that no transaction fails half way with "locked".
            "transaction_mode": "IMMEDIATE",
            "timeout": 20,
            # synchronous=FULL: an acknowledged save survives a loss of power, too.
            "init_command": (
                "PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL; PRAGMA foreign_keys=ON;"
                "PRAGMA temp_store=MEMORY; PRAGMA mmap_size=134217728; PRAGMA cache_size=-16000;"
            ),
        },
    }
}
USE_TZ = True
TIME_ZONE = "UTC"
LANGUAGE_CODE = "en"
USE_I18N = False
STATIC_URL = "/static/"
WHITENOISE_ROOT = str(ENVIRONMENT.frontend_dir)
WHITENOISE_AUTOREFRESH = True  # a new build of the front end needs no restart
WHITENOISE_ALLOW_ALL_ORIGINS = False
DATA_UPLOAD_MAX_MEMORY_SIZE = ENVIRONMENT.max_request_bytes
FILE_UPLOAD_MAX_MEMORY_SIZE = 4 * 1024 * 1024
SECURE_CONTENT_TYPE_NOSNIFF = True
LOGGING_CONFIG = None

REST_FRAMEWORK: dict[str, Any] = {
    "DEFAULT_AUTHENTICATION_CLASSES": ["backend.accounts.authentication.GuardAuthentication"],
    "DEFAULT_PERMISSION_CLASSES": ["rest_framework.permissions.IsAuthenticated"],
    "DEFAULT_PARSER_CLASSES": ["backend.config.parsers.StrictJSONParser"],
    "DEFAULT_RENDERER_CLASSES": ["rest_framework.renderers.JSONRenderer"],
    "DEFAULT_SCHEMA_CLASS": "backend.config.openapi.ProblemSchema",
    "EXCEPTION_HANDLER": "backend.config.problems.exception_handler",
    "UNAUTHENTICATED_USER": None,
    "DEFAULT_CONTENT_NEGOTIATION_CLASS": "backend.config.negotiation.IgnoreClientNegotiation",
}
SPECTACULAR_SETTINGS: dict[str, Any] = {
    "TITLE": "BT Studio",
    "DESCRIPTION": "Projects, their files and revisions, the catalogue, and the sessions that run them.",
    "VERSION": __version__,
    "OAS_VERSION": "3.1.0",
    "SERVE_INCLUDE_SCHEMA": False,
    "COMPONENT_SPLIT_REQUEST": True,
    "SCHEMA_PATH_PREFIX": "/api/v1",
    "SORT_OPERATION_PARAMETERS": True,
    "ENUM_GENERATE_CHOICE_DESCRIPTION": False,
    "POSTPROCESSING_HOOKS": ["drf_spectacular.hooks.postprocess_schema_enums"],
    "SERVERS": [],
}
