"""Django's settings, derived from `environment`. Importing this module writes nothing."""

from __future__ import annotations

import secrets
from pathlib import Path
from typing import Any

from backend import __version__
from backend.config import team
from backend.config.environment import environment

ENVIRONMENT = environment()


def _secret_key() -> str:
    """Returns the secret key.

    It is that of the environment, that of the data folder (made by `serve`), or a random one.
    """
    if given := ENVIRONMENT.secret_key.get_secret_value():
        return given
    try:
        return (ENVIRONMENT.data_dir / "secret_key").read_text(encoding="ascii").strip()
    except FileNotFoundError:
        return secrets.token_urlsafe(48)


SECRET_KEY = _secret_key()
DEBUG = False
# The guard checks hosts, for pages and sockets alike (`backend/core/guard.py`).
ALLOWED_HOSTS = ["*"]
ASGI_APPLICATION = "backend.config.asgi.application"
# The same apps, and so the same tables, in both modes; only the URLs and their views differ.
INSTALLED_APPS = [
    "django.contrib.auth",
    "django.contrib.contenttypes",
    "django.contrib.sessions",
    "django.contrib.messages",
    "django.contrib.staticfiles",
    "django.contrib.admin.apps.SimpleAdminConfig",
    "allauth",
    "backend.accounts.vendor.Account",
    "allauth.socialaccount",
    "allauth.socialaccount.providers.openid_connect",
    "allauth.mfa",
    "rest_framework",
    "drf_spectacular",
    "drf_spectacular_sidecar",
    "backend.accounts",
    "backend.catalog",
    "backend.projects",
    "backend.sessions",
    "backend.runs",
    "backend.evaluations",
]
LOCAL_URLS, TEAM_URLS = "backend.config.urls", "backend.config.urls_team"
LOCAL_MIDDLEWARE = [
    "backend.ingress.middleware.SecurityHeaders",
    "backend.ingress.middleware.Guard",
    "backend.config.static.FrontEndFiles",
    "django.middleware.http.ConditionalGetMiddleware",
    "backend.workers.deferred.Waiting",
]
# The API reads its session itself, without the cost of the pages' middleware.
TEAM_MIDDLEWARE = [
    *LOCAL_MIDDLEWARE,
    "backend.accounts.sign_in.middleware.PageSession",
    "backend.accounts.sign_in.middleware.PageLocale",
    "backend.accounts.sign_in.middleware.PageCsrf",
    "backend.accounts.sign_in.middleware.PageUser",
    "backend.accounts.sign_in.middleware.PageMessages",
    "allauth.account.middleware.AccountMiddleware",
]
ROOT_URLCONF = TEAM_URLS if ENVIRONMENT.is_team else LOCAL_URLS
MIDDLEWARE = TEAM_MIDDLEWARE if ENVIRONMENT.is_team else LOCAL_MIDDLEWARE
TEMPLATES: list[dict[str, Any]] = [
    {
        "BACKEND": "django.template.backends.django.DjangoTemplates",
        "DIRS": [Path(__file__).parent / "templates", Path(__file__).parents[1] / "accounts" / "templates"],
        "APP_DIRS": True,
        "OPTIONS": {
            "context_processors": [
                "django.template.context_processors.request",
                "django.contrib.auth.context_processors.auth",
                "django.contrib.messages.context_processors.messages",
                "backend.accounts.sign_in.pages.context",
            ]
        },
    }
]
AUTH_USER_MODEL = "accounts.User"
DEFAULT_AUTO_FIELD = "django.db.models.BigAutoField"
DATABASES = {"default": team.database(ENVIRONMENT.database_url.get_secret_value(), ENVIRONMENT.data_dir)}
USE_TZ = True
TIME_ZONE = "UTC"
LANGUAGE_CODE = "en"
USE_I18N = True
LANGUAGES = [("en", "English"), ("es", "Español")]
LANGUAGE_COOKIE_NAME = "bt_studio_language"
STATIC_URL = "/static/"
STATICFILES_DIRS = [Path(__file__).parents[1] / part / "static" for part in ("accounts", "config")]
WHITENOISE_USE_FINDERS = True
WHITENOISE_ROOT = str(ENVIRONMENT.frontend_dir)
WHITENOISE_AUTOREFRESH = True  # a new build of the front end needs no restart
WHITENOISE_ALLOW_ALL_ORIGINS = False
DATA_UPLOAD_MAX_MEMORY_SIZE = ENVIRONMENT.max_request_bytes
FILE_UPLOAD_MAX_MEMORY_SIZE = 4 * 1024 * 1024
FILE_UPLOAD_HANDLERS = [
    "django.core.files.uploadhandler.MemoryFileUploadHandler",
    "backend.core.scratch.ScratchUploads",
]
SECURE_CONTENT_TYPE_NOSNIFF = True
# Small notices only, such as that a project has a new revision; never frames, logs or files.
CHANNEL_LAYERS: dict[str, dict[str, Any]] = {
    "default": {
        "BACKEND": "channels_redis.pubsub.RedisPubSubChannelLayer",
        "CONFIG": {"hosts": [ENVIRONMENT.redis_url.get_secret_value()]},
    }
    if ENVIRONMENT.redis_url.get_secret_value()
    else {"BACKEND": "channels.layers.InMemoryChannelLayer"}
}
LOGGING_CONFIG = None
SILENCED_SYSTEM_CHECKS = [
    "admin.E408",  # the admin's pages exist in team mode only, and so do sessions and messages
    "admin.E409",
    "admin.E410",
]

_REDIS = ENVIRONMENT.redis_url.get_secret_value()
CACHES: dict[str, dict[str, Any]] = {
    "default": {"BACKEND": "django.core.cache.backends.redis.RedisCache", "LOCATION": _REDIS}
    if _REDIS
    else {"BACKEND": "django.core.cache.backends.locmem.LocMemCache"}
}
# `cached_db` would be slower: Redis costs a request more than the query that it saves.
SESSION_ENGINE = "django.contrib.sessions.backends.db"
SESSION_COOKIE_NAME = ("__Host-" if ENVIRONMENT.is_https else "") + "bt_studio_session"
SESSION_COOKIE_AGE = 14 * 24 * 3600
SESSION_COOKIE_SECURE = ENVIRONMENT.is_https
SESSION_COOKIE_HTTPONLY = True
SESSION_COOKIE_SAMESITE = "Lax"  # a link in a mail must open with the user signed in
CSRF_COOKIE_NAME = ("__Host-" if ENVIRONMENT.is_https else "") + "bt_studio_csrf"
CSRF_COOKIE_SECURE = ENVIRONMENT.is_https
CSRF_COOKIE_HTTPONLY = True
CSRF_COOKIE_SAMESITE = "Lax"
CSRF_TRUSTED_ORIGINS = [ENVIRONMENT.public_url] if ENVIRONMENT.public_url else []
CSRF_FAILURE_VIEW = "backend.accounts.sign_in.pages.csrf_failure"
SECURE_PROXY_SSL_HEADER = ("HTTP_X_FORWARDED_PROTO", "https") if ENVIRONMENT.proxy_hops else None
globals().update(team.mail(ENVIRONMENT.smtp_url.get_secret_value(), ENVIRONMENT.mail_from))

AUTHENTICATION_BACKENDS = ["allauth.account.auth_backends.AuthenticationBackend"]
AUTH_PASSWORD_VALIDATORS = [
    {"NAME": f"django.contrib.auth.password_validation.{name}"}
    for name in (
        "UserAttributeSimilarityValidator",
        "MinimumLengthValidator",
        "CommonPasswordValidator",
        "NumericPasswordValidator",
    )
]
LOGIN_URL = "/accounts/login/"
LOGIN_REDIRECT_URL = "/"
ACCOUNT_ADAPTER = "backend.accounts.sign_in.adapters.AccountAdapter"
ACCOUNT_LOGIN_METHODS = {"email", "username"}
ACCOUNT_SIGNUP_FIELDS = ["username*", "email*", "password1*", "password2*"]
ACCOUNT_UNIQUE_EMAIL = True
# Without a mail server nobody would receive the link.
ACCOUNT_EMAIL_VERIFICATION = "mandatory" if ENVIRONMENT.smtp_url.get_secret_value() else "none"
ACCOUNT_EMAIL_SUBJECT_PREFIX = ""
ACCOUNT_DEFAULT_HTTP_PROTOCOL = "https" if ENVIRONMENT.is_https else "http"
ACCOUNT_LOGOUT_REDIRECT_URL = "/accounts/login/"
ACCOUNT_PREVENT_ENUMERATION = True
ACCOUNT_SESSION_REMEMBER = True
ACCOUNT_USERNAME_MIN_LENGTH = 2
ACCOUNT_USERNAME_BLACKLIST = ["local", "admin", "root", "system"]
# `backend.accounts.sign_in.attempts` counts failed sign-ins; here, wrong codes of second factors are counted
# for each user. The limits for an address are high, since a whole class behind one address may sign up, or
# follow links for new passwords, at the same time.
ACCOUNT_RATE_LIMITS = {
    "login": "",
    "login_failed": "5/5m/key",
    "signup": "300/m/ip",
    "reset_password": "100/m/ip,5/m/key",
    "reset_password_from_key": "300/m/ip",
}
SOCIALACCOUNT_ADAPTER = "backend.accounts.sign_in.adapters.SocialAccountAdapter"
SOCIALACCOUNT_LOGIN_ON_GET = False
SOCIALACCOUNT_ONLY = False
SOCIALACCOUNT_EMAIL_AUTHENTICATION = False
SOCIALACCOUNT_PROVIDERS: dict[str, Any] = {"openid_connect": {"OAUTH_PKCE_ENABLED": True, "APPS": []}}
if ENVIRONMENT.oidc_issuer:
    SOCIALACCOUNT_PROVIDERS["openid_connect"]["APPS"].append(
        {
            "provider_id": "oidc",
            "name": ENVIRONMENT.oidc_name,
            "client_id": ENVIRONMENT.oidc_client_id,
            "secret": ENVIRONMENT.oidc_client_secret.get_secret_value(),
            "settings": {"server_url": ENVIRONMENT.oidc_issuer},
        }
    )
MFA_SUPPORTED_TYPES = ["totp", "recovery_codes"]
# Where no mail is sent, no address is ever verified.
MFA_ALLOW_UNVERIFIED_EMAIL = not ENVIRONMENT.smtp_url.get_secret_value()
MFA_TOTP_ISSUER = "BT Studio"
# A code may change while the user types it (RFC 6238, section 5.2: one step for delay and clocks).
MFA_TOTP_TOLERANCE = 1

REST_FRAMEWORK: dict[str, Any] = {
    "DEFAULT_AUTHENTICATION_CLASSES": ["backend.accounts.api.authentication.GuardAuthentication"],
    "DEFAULT_PERMISSION_CLASSES": ["backend.accounts.permissions.MayAsk"],
    "DEFAULT_THROTTLE_CLASSES": [
        "backend.accounts.permissions.ExpensiveCalls",
        "backend.accounts.permissions.ExpensiveCallsOfGuests",
    ],
    "DEFAULT_PARSER_CLASSES": ["backend.core.rest.parsers.StrictJSONParser"],
    "DEFAULT_RENDERER_CLASSES": ["rest_framework.renderers.JSONRenderer"],
    "DEFAULT_SCHEMA_CLASS": "backend.core.rest.openapi.ProblemSchema",
    "EXCEPTION_HANDLER": "backend.core.problems.exception_handler",
    "UNAUTHENTICATED_USER": None,
    "DEFAULT_CONTENT_NEGOTIATION_CLASS": "backend.core.rest.negotiation.IgnoreClientNegotiation",
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
    "ENUM_NAME_OVERRIDES": {
        "AccountRole": ["local", "administrator", "teacher", "user", "guest"],
        "ProjectRole": ["viewer", "editor", "owner"],
        "SharedRole": ["viewer", "editor"],
        "EvaluationState": "backend.evaluations.choices.JobState",
        "SessionKindEnum": "backend.sessions.choices.SessionKind",
        "SessionStateEnum": "backend.sessions.choices.SessionState",
        "RunOutcome": "backend.evaluations.choices.Result",
    },
    "POSTPROCESSING_HOOKS": [
        "drf_spectacular.hooks.postprocess_schema_enums",
        "backend.config.examples.illustrate",
    ],
    "SERVERS": [],
}
