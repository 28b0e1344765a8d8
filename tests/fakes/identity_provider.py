"""An OpenID Connect provider that accepts every sign-in as the person that the test names."""

from __future__ import annotations

import json
import threading
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from urllib.parse import parse_qs, urlencode, urlsplit

import jwt

CLIENT_ID, SECRET = "bt-studio", "between-the-two-of-us-and-nobody-else"


class IdentityProvider:
    """Its address, and the next person to sign in."""

    def __init__(self, port):
        self.issuer = f"http://127.0.0.1:{port}"
        self.person = {}
        self.codes = 0
        self.asked = []

    def authorize(self, address):
        """Redirects the browser after a sign-in."""
        asked = {name: values[0] for name, values in parse_qs(urlsplit(address).query).items()}
        assert asked["client_id"] == CLIENT_ID
        assert asked["code_challenge_method"] == "S256"
        self.codes += 1
        back = urlencode({"code": f"code-{self.codes}", "state": asked["state"]})
        return f"{urlsplit(asked['redirect_uri']).path}?{back}"

    def answer(self, path):
        """Returns the document at an address."""
        if path == "/.well-known/openid-configuration":
            return {
                "issuer": self.issuer,
                "authorization_endpoint": f"{self.issuer}/authorize",
                "token_endpoint": f"{self.issuer}/token",
                "userinfo_endpoint": f"{self.issuer}/userinfo",
                "jwks_uri": f"{self.issuer}/keys",
                "token_endpoint_auth_methods_supported": ["client_secret_post"],
            }
        if path == "/token":
            claims = self.person | {"iss": self.issuer, "aud": CLIENT_ID, "exp": 4_000_000_000, "iat": 1}
            token = jwt.encode(claims, SECRET, algorithm="HS256")
            return {"access_token": "access", "token_type": "Bearer", "id_token": token}
        return self.person if path == "/userinfo" else None


@contextmanager
def identity_provider():
    """Serves a provider until the block ends."""

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self):
            self.rfile.read(int(self.headers.get("Content-Length") or 0))
            path = urlsplit(self.path).path
            provider.asked.append(path)
            found = provider.answer(path)
            data = json.dumps(found).encode()
            self.send_response(404 if found is None else 200)
            self.send_header("Content-Type", "application/json")
            self.send_header("Content-Length", str(len(data)))
            self.end_headers()
            self.wfile.write(data)

        do_POST = do_GET  # noqa: N815 - the server's name for it

        def log_message(self, *_):
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server:
        provider = IdentityProvider(server.server_port)
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield provider
        finally:
            server.shutdown()
            thread.join()
