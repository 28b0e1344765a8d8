"""Settings of servers with accounts; checks that no required setting is missing."""

from __future__ import annotations

from email.utils import parseaddr
from pathlib import Path
from typing import Any, Literal, Self
from urllib.parse import parse_qs, unquote, urlsplit

from pydantic import Field, SecretStr, field_validator, model_validator
from pydantic_settings import BaseSettings

MIN_SECRET_KEY = 32
CONNECTION_S = 600
"""Seconds for which a connection to PostgreSQL is kept.

Its PostgreSQL process frees its memory only at its end.
"""
DEFAULT_PORTS = {"smtp": 25, "smtp+starttls": 587, "smtps": 465}


class MissingSettingError(ValueError):
    """A setting that another setting requires is missing; `name` is the field."""

    def __init__(self, name: str, sentence: str) -> None:
        super().__init__(sentence)
        self.name = name


class TeamSettings(BaseSettings):
    """The mode (local or team), and the services that a team server uses."""

    mode: Literal["local", "team"] = Field(
        default="local",
        description="`local`: one user, on this machine only, by the link of `serve`. `team`: accounts.",
    )
    public_url: str = Field(
        default="",
        description="Team mode: address under which users open the server, `https://bt.example.org`.",
    )
    database_url: SecretStr = Field(
        default=SecretStr(""),
        description="`postgresql://user:password@host:5432/name`; without it SQLite in the data folder. "
        "Team mode needs one; `sqlite:////folder/file` will do for a few users, in one process. It isolates "
        "nobody: that is for `BT_STUDIO_LAUNCHER`.",
    )
    redis_url: SecretStr = Field(
        default=SecretStr(""),
        description="`redis://:password@host:6379/0`: what web servers share (login attempts, notices). "
        "Team mode with PostgreSQL needs one.",
    )
    secret_key: SecretStr = Field(
        default=SecretStr(""),
        description="Signs cookies and links; the same for all web servers, 32 characters or more. "
        "Team mode needs one; on localhost it is a file of the data folder.",
    )
    proxy_hops: int = Field(
        default=0,
        ge=0,
        le=5,
        description="Number of reverse proxies in front whose `X-Forwarded-For` is trusted.",
    )
    hsts_days: int = Field(
        default=365,
        ge=0,
        description="Days for which browsers open this server by https alone (HSTS), where "
        "`BT_STUDIO_PUBLIC_URL` is https; 0 sends no such header.",
    )
    smtp_url: SecretStr = Field(
        default=SecretStr(""),
        description="Mail server: `smtp://`, `smtp+starttls://` or `smtps://` `user:password@host:port`; "
        "without it, links are copied instead of mailed.",
    )
    mail_from: str = Field(default="", description="Sender of mails, `BT Studio <bt@example.org>`.")
    registration: Literal["closed", "open"] = Field(
        default="closed", description="`closed`: accounts by invitation only. `open`: anyone can sign up."
    )
    allowed_email_domains: tuple[str, ...] = Field(
        default=(),
        description="E-mail domains (a JSON list) that may sign up or come by OIDC; none allows all.",
    )
    oidc_issuer: str = Field(
        default="", description="Address of an OpenID Connect provider, such as a university's login."
    )
    oidc_client_id: str = Field(default="", description="The client that the provider knows this server as.")
    oidc_client_secret: SecretStr = Field(default=SecretStr(""), description="The secret of that client.")
    oidc_name: str = Field(default="Single sign-on", description="What the button of that login says.")
    expensive_calls_per_minute: int = Field(
        default=60, ge=1, description="Team mode: exports, imports, packages and starts of one user a minute."
    )
    max_user_sessions: int = Field(
        default=2,
        ge=0,
        description="Team mode: robots of one user that run at a time; further ones wait. 0: no limit.",
    )
    max_user_language_servers: int = Field(
        default=2,
        ge=0,
        description="Team mode: editors of one user that get help with Python at a time. 0: no limit.",
    )
    max_user_tests: int = Field(
        default=2,
        ge=0,
        description="Team mode: tests with Python of one user that run at a time. 0: no limit.",
    )
    max_user_waiting: int = Field(
        default=2,
        ge=1,
        description="Team mode: robots (editors, tests) of one user that wait; further ones are refused.",
    )
    audit_days: int = Field(default=365, ge=1, description="Days that the audit log is kept.")

    @field_validator("public_url")
    @classmethod
    def _origin(cls, value: str) -> str:
        if not value:
            return value
        parts = urlsplit(value)
        if parts.scheme not in {"http", "https"} or not parts.netloc or parts.path.strip("/") or parts.query:
            raise ValueError("this must be http(s)://host[:port], without a path")
        return f"{parts.scheme}://{parts.netloc.lower()}"

    @field_validator("database_url")
    @classmethod
    def _database(cls, value: SecretStr) -> SecretStr:
        parts = urlsplit(value.get_secret_value())
        if parts.scheme not in {"", "postgresql", "postgres", "sqlite"}:
            raise ValueError("this must be postgresql://… or sqlite:////…")
        if parts.scheme == "sqlite" and not parts.path.startswith("//"):
            raise ValueError("the path of a SQLite file must be absolute: sqlite:////folder/file")
        if parts.scheme.startswith("postgres") and not parts.path.strip("/"):
            raise ValueError("the name of the database is missing: postgresql://user:password@host:5432/name")
        return value

    @field_validator("redis_url")
    @classmethod
    def _redis(cls, value: SecretStr) -> SecretStr:
        if urlsplit(value.get_secret_value()).scheme not in {"", "redis", "rediss", "unix"}:
            raise ValueError("this must be redis://…, rediss://… or unix://…")
        return value

    @field_validator("smtp_url")
    @classmethod
    def _smtp(cls, value: SecretStr) -> SecretStr:
        parts = urlsplit(value.get_secret_value())
        if parts.scheme and (parts.scheme not in DEFAULT_PORTS or not parts.hostname):
            raise ValueError(f"this must be one of {', '.join(DEFAULT_PORTS)}, with ://host:port")
        return value

    @field_validator("secret_key")
    @classmethod
    def _long(cls, value: SecretStr) -> SecretStr:
        if 0 < len(value.get_secret_value()) < MIN_SECRET_KEY:
            raise ValueError(f"this must have {MIN_SECRET_KEY} characters or more")
        return value

    @field_validator("oidc_issuer")
    @classmethod
    def _issuer(cls, value: str) -> str:
        if value and urlsplit(value).scheme not in {"http", "https"}:
            raise ValueError("this must be an http(s) address")
        return value.rstrip("/")

    @field_validator("allowed_email_domains")
    @classmethod
    def _domains(cls, value: tuple[str, ...]) -> tuple[str, ...]:
        return tuple(domain.strip().lower().removeprefix("@") for domain in value)

    @model_validator(mode="after")
    def _complete(self) -> Self:
        if self.is_team:
            self._need("public_url", "team mode needs the address under which users open the server")
            self._need("database_url", "team mode needs a database, such as postgresql://…")
            self._need("secret_key", "team mode needs a secret, for example of `openssl rand -base64 48`")
            if self.is_postgresql:
                self._need("redis_url", "team mode needs Redis, such as redis://redis:6379/0")
        if self.smtp_url.get_secret_value() and not parseaddr(self.mail_from)[1]:
            raise MissingSettingError("mail_from", "mails need a sender, such as bt@example.org")
        if self.oidc_issuer:
            self._need("oidc_client_id", "a login by OIDC needs the client's name")
            self._need("oidc_client_secret", "a login by OIDC needs the client's secret")
        return self

    def _need(self, name: str, sentence: str) -> None:
        value: SecretStr | str = getattr(self, name)
        if not (value.get_secret_value() if isinstance(value, SecretStr) else value):
            raise MissingSettingError(name, sentence)

    @property
    def is_team(self) -> bool:
        """Whether the server has accounts."""
        return self.mode == "team"

    def of_one_user(self, most: int) -> int:
        """Returns how many places one user may hold where a setting says `most`; 0 is no limit."""
        return most if self.is_team else 0

    @property
    def is_postgresql(self) -> bool:
        """Whether projects are stored in PostgreSQL."""
        return self.database_url.get_secret_value().startswith("postgres")

    @property
    def is_https(self) -> bool:
        """Whether users connect by TLS, so that cookies need the attribute `Secure`."""
        return self.public_url.startswith("https://")

    @property
    def public_host(self) -> str:
        """The `Host` of the public address, with its port."""
        return urlsplit(self.public_url).netloc


def database(url: str, data_dir: Path) -> dict[str, Any]:
    """Returns Django's settings of the database: the one that `url` names, or SQLite in the data folder."""
    parts = urlsplit(url)
    if parts.scheme.startswith("postgres"):
        return postgresql(url)
    return {
        "ENGINE": "django.db.backends.sqlite3",
        "NAME": Path(parts.path[1:]) if parts.scheme else data_dir / "bt-studio.sqlite3",
        "CONN_MAX_AGE": None,  # request threads live as long as the process
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


def postgresql(url: str) -> dict[str, Any]:
    """Returns Django's settings of a PostgreSQL server; threads keep their connections."""
    parts = urlsplit(url)
    query = {name: values[-1] for name, values in parse_qs(parts.query).items()}
    host = unquote(parts.hostname or query.pop("host", ""))
    return {
        "ENGINE": "django.db.backends.postgresql",
        "NAME": unquote(parts.path.lstrip("/")),
        "USER": unquote(parts.username or ""),
        "PASSWORD": unquote(parts.password or ""),
        "HOST": host,
        "PORT": str(parts.port or ""),
        "CONN_MAX_AGE": CONNECTION_S,
        # Most statements are of few kinds: PostgreSQL reads and plans each kind once.
        "OPTIONS": {
            "application_name": "bt-studio",
            "server_side_binding": True,
            "prepare_threshold": 3,
        }
        | query,
    }


def mail(url: str, sender: str) -> dict[str, Any]:
    """Returns Django's settings of the mail server that `url` names."""
    if not url:
        return {"EMAIL_BACKEND": "django.core.mail.backends.dummy.EmailBackend"}
    parts = urlsplit(url)
    return {
        "EMAIL_BACKEND": "django.core.mail.backends.smtp.EmailBackend",
        "EMAIL_HOST": parts.hostname,
        "EMAIL_PORT": parts.port or DEFAULT_PORTS[parts.scheme],
        "EMAIL_HOST_USER": unquote(parts.username or ""),
        "EMAIL_HOST_PASSWORD": unquote(parts.password or ""),
        "EMAIL_USE_TLS": parts.scheme == "smtp+starttls",
        "EMAIL_USE_SSL": parts.scheme == "smtps",
        "EMAIL_TIMEOUT": 10,
        "DEFAULT_FROM_EMAIL": sender,
        "SERVER_EMAIL": sender,
    }
