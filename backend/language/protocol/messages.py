"""Filters the messages between a page and its language server; does no I/O.

The page's settings for interpreters, folders or commands are ignored: only the server's configuration decides
which programs run.
"""

from __future__ import annotations

import re
from typing import Any, Final

from backend.language.protocol.docstrings import readable

Message = dict[str, Any]

_FROM_PAGE: Final = frozenset(
    {"initialized", "shutdown", "exit", "$/cancelRequest", "completionItem/resolve", "codeAction/resolve"}
)
# Our own request: the text of a file outside of the project. The relay answers it.
SOURCE_METHOD: Final = "studio/source"
_TO_PAGE: Final = frozenset({"textDocument/publishDiagnostics"})
_HINT: Final = 4
_METHOD_NOT_FOUND: Final = -32601
_INVALID_REQUEST: Final = -32600
# Links to files reveal paths of this machine, and a browser cannot open them.
_FILE_LINK: Final = re.compile(r"\[([^\]]*)\]\(file:[^)]*\)")
# `ty` names a class in this way: ```` ```xml <class 'Turn'> ````.
_CLASS: Final = re.compile(r"```xml\n<class '([^']*)'>")
# The list of paths in which `ty` looked for a module reveals our folders, not the user's.
_LOOKED_IN: Final = re.compile(r"\n\s*(?:info: )?Searched in the following paths[\s\S]*$")


def for_server(message: Any, root_uri: str) -> tuple[Message | None, Message | None]:
    """Filters a message of the page; returns the message for the server, and an answer for the page."""
    if not isinstance(message, dict):
        return None, _error(None, _INVALID_REQUEST, "A message is an object.")
    method = message.get("method")
    if method is None:
        return None, None  # an answer to a request of the server: such requests are not passed on
    if method == "initialize":
        return message | {"params": _initialize(message.get("params"), root_uri)}, None
    if isinstance(method, str) and (method.startswith("textDocument/") or method in _FROM_PAGE):
        return message, None
    answer = _error(message["id"], _METHOD_NOT_FOUND, "Not offered.") if "id" in message else None
    return None, answer


def source_asked(message: Any) -> tuple[Any, str] | None:
    """Returns id and address of a request for a file outside of the project; None for other messages."""
    if not isinstance(message, dict) or message.get("method") != SOURCE_METHOD or "id" not in message:
        return None
    params = message.get("params")
    uri = params.get("uri") if isinstance(params, dict) else None
    return message["id"], uri if isinstance(uri, str) else ""


def _initialize(params: Any, root_uri: str) -> Message:
    given = params if isinstance(params, dict) else {}
    capabilities = given.get("capabilities")
    known = capabilities if isinstance(capabilities, dict) else {}
    document = known.get("textDocument")
    # A server that may be asked for findings sends none by itself, and the page does not ask.
    offered = (
        {name: each for name, each in document.items() if name != "diagnostic"}
        if isinstance(document, dict)
        else {}
    )
    return {
        "processId": None,
        "clientInfo": {"name": "bt-studio"},
        "rootUri": root_uri,
        "workspaceFolders": [{"uri": root_uri, "name": "project"}],
        # Without these capabilities the server does not request the page's configuration.
        "capabilities": {"textDocument": offered}
        | ({"general": known["general"]} if "general" in known else {}),
    }


def for_page(message: Any) -> tuple[Message | None, Message | None]:
    """Filters a message of the server; returns the message for the page, and an answer for the server."""
    if not isinstance(message, dict):
        return None, None
    if "method" not in message:
        return _cleaned(message), None
    if "id" in message:
        return None, {"jsonrpc": "2.0", "id": message["id"], "result": None}
    return (_without_hints(_cleaned(message)), None) if message["method"] in _TO_PAGE else (None, None)


def _without_hints(message: Message) -> Message:
    """Removes hints from findings, such as those about an unused argument that `terminate` must have."""
    params: Any = message.get("params")
    found = params.get("diagnostics") if isinstance(params, dict) else None
    if not isinstance(found, list):
        return message
    kept = [each for each in found if not (isinstance(each, dict) and each.get("severity") == _HINT)]
    return message | {"params": params | {"diagnostics": kept}}


def _cleaned(value: Any) -> Any:
    """Removes paths of this machine from texts that are shown to users."""
    if isinstance(value, dict):
        return {
            key: _text(each, key) if key in {"value", "message", "documentation"} else _cleaned(each)
            for key, each in value.items()
        }
    return [_cleaned(each) for each in value] if isinstance(value, list) else value


def _text(value: Any, key: str) -> Any:
    if not isinstance(value, str):
        return _cleaned(value)
    value = _CLASS.sub(r"```python\nclass \1", value)
    value = _FILE_LINK.sub(r"\1", _LOOKED_IN.sub("", value))
    return value if key == "message" else readable(value)


def _error(message_id: Any, code: int, text: str) -> Message:
    return {"jsonrpc": "2.0", "id": message_id, "error": {"code": code, "message": text}}
