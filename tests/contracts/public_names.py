"""Collects every public name, on which users, stored files and other programs rely.

A test compares the result with `public_names.json`. What is read at run time (Django's registry,
the command line, the messages) survives any move of modules; the rest is found by form in whole folders.
`python -m tests.contracts.public_names` adds new names to the list and refuses to drop any. `--forget` drops
those that are gone, which breaks files or programs of users on purpose.
"""

from __future__ import annotations

import ast
import functools
import gc
import importlib
import io
import json
import os
import re
import sys
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, get_args

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT: Final = Path(__file__).resolve().parents[2]
STORED: Final = Path(__file__).with_name("public_names.json")
PRODUCT: Final = ("backend", "executor", "translator", "tree_gardener")
DEPLOYED: Final = ("docker", "backend", "executor", ".ci", ".github", "Makefile")
# The server's own strings: formats, cookies, salts, labels, metrics and folders.
OWN_STRING: Final = re.compile(r"(?:urn:|org\.|__Host-|/[a-z]+/)?bt[-_]studio(?!.*: )[^\n]*")
# Below these are the pages of other packages.
OTHERS_PAGES: Final = {"/accounts/", "/admin/"}

GONE: Final = (
    "These names are used outside of the repository: by files, browsers, scripts, images or databases. "
    "Restore them. To drop one on purpose: `python -m tests.contracts.public_names --forget`, and a row in "
    "docs/reference/changed-names.md that says what users do instead."
)
NEW: Final = "New public names are fine; store them: `python -m tests.contracts.public_names`."

Names = dict[str, list[str]]


def collect() -> Names:
    """Returns the sorted names of each kind."""
    os.environ.setdefault("DJANGO_SETTINGS_MODULE", "backend.config.settings")
    import django

    django.setup()
    found = {
        "command line": command_line(),
        "environment variables": environment_variables(),
        "REST operations": rest_operations(),
        "addresses of the web server": addresses(),
        "websockets": websockets(),
        "addresses of manager, tools and keeper": process_addresses(),
        "messages of the session": messages(),
        "problem codes": problem_codes(),
        "error codes of the session": session_error_codes(),
        "diagnostic codes": diagnostic_codes(),
        "RAM dialect": ram_words(),
        "cookies, salts, formats and labels": own_strings(),
        "Django apps": django_apps(),
        "Django columns and choices": django_columns(),
        "Django migrations": django_migrations(),
        "entry points": entry_points(),
        "import paths": import_paths(),
        "files of an exported package": exported_files(),
        "fields of file formats": file_formats(),
        "keys in the browser's storage": storage_keys(),
        "kinds of tabs": tab_kinds(),
    }
    return {kind: sorted(set(names)) for kind, names in found.items()}


def modules(*folders: str) -> Iterator[tuple[Path, ast.Module]]:
    for folder in folders:
        for path in sorted((ROOT / folder).rglob("*.py")):
            yield path, _parsed(path)


@functools.cache
def _parsed(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def strings(tree: ast.AST) -> Iterator[str]:
    """Every string and bytes literal."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str | bytes):
            yield node.value if isinstance(node.value, str) else node.value.decode("latin-1")


def files(*names: str) -> list[Path]:
    """Returns the files with these names, and those in folders with these names."""
    paths = [ROOT / name for name in names]
    inside = [path for folder in paths for path in sorted(folder.rglob("*")) if path.is_file()]
    return [path for path in paths + inside if path.is_file() and "__pycache__" not in path.parts]


def texts(*folders: str) -> Iterator[str]:
    for path in files(*folders):
        try:
            yield path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue


def command_line() -> list[str]:
    from typer.main import get_command

    from backend.cli.main import app

    return list(_verbs(get_command(app), "bt-studio"))


def _verbs(command: Any, path: str) -> Iterator[str]:
    for parameter in command.params:
        names = [*parameter.opts, *parameter.secondary_opts]
        yield from (f"{path} {name}" for name in names if name != "--help")
    if not hasattr(command, "list_commands"):
        yield path
        return
    import click

    context = click.Context(command)
    for name in command.list_commands(context):
        yield from _verbs(command.get_command(context, name), f"{path} {name}")


def environment_variables() -> list[str]:
    from django.conf import settings

    fields = [f"BT_STUDIO_{name.upper()}" for name in type(settings.ENVIRONMENT).model_fields]
    named = [
        name
        for text in texts(*PRODUCT, *DEPLOYED)
        for name in re.findall(r"\bBT_STUDIO_[A-Z0-9_]*[A-Z0-9]", text)
    ]
    return fields + named


def rest_operations() -> list[str]:
    document = json.loads((ROOT / "docs" / "reference" / "openapi.json").read_text(encoding="utf-8"))
    return [
        f"{method.upper()} {re.sub(r'{.*?}', '{}', path)}"
        for path, methods in document["paths"].items()
        for method in methods
        if method in {"get", "put", "post", "patch", "delete", "head"}
    ]


def addresses() -> list[str]:
    from django.conf import settings

    found = []
    for mode, module in (("local", settings.LOCAL_URLS), ("team", settings.TEAM_URLS)):
        patterns = importlib.import_module(module).urlpatterns
        found += [f"{mode}: {address}" for address in _addresses(patterns, "/")]
    return found


def _addresses(patterns: list[Any], before: str) -> Iterator[str]:
    for pattern in patterns:
        address = re.sub(r"<(\w+):\w+>", r"<\1>", before + str(pattern.pattern).lstrip("^"))
        if not hasattr(pattern, "url_patterns") or address in OTHERS_PAGES:
            yield address
        else:
            yield from _addresses(pattern.url_patterns, address)


def websockets() -> list[str]:
    from backend.config.asgi import routes

    return [address.pattern for address in routes]


def process_addresses() -> list[str]:
    return [
        text
        for _, tree in modules("backend", "executor")
        for text in strings(tree)
        if re.fullmatch(r"/(control|stream|watch|metrics|language|ruff|sessions|tools|health[a-z/]*)", text)
    ]


def messages() -> list[str]:
    import msgspec

    from executor import messages as native

    found = [native.PROTOCOL]
    for kind, structs in (
        ("command", native.COMMANDS),
        ("event", native.EVENTS),
        ("frame", {struct.__struct_config__.tag: struct for struct in native.FRAMES}),
    ):
        for name, struct in structs.items():
            fields = [field.encode_name for field in msgspec.structs.fields(struct)]
            found += [f"{kind} {name}", *(f"{kind} {name}.{field}" for field in fields)]
    for alias in ("State", "LogSource", "LogLevel", "Role", "NodeStatus", "LaunchState", "FinishReason"):
        found += [f"{alias} {value}" for value in get_args(getattr(native, alias))]
    return found


def problem_codes() -> list[str]:
    for path in files("backend"):  # the subclasses are known once their modules are loaded
        if path.name == "errors.py" or "Error" in path.read_text(encoding="utf-8", errors="replace"):
            _load(path)
    bases = [module.StudioError for module in list(sys.modules.values()) if hasattr(module, "StudioError")]
    return [kind.code for base in bases for kind in (base, *_subclasses(base))]


def _load(path: Path) -> None:
    relative = path.relative_to(ROOT)
    if path.suffix != ".py" or {"migrations", "behaviours", "setup", "keeper"} & set(relative.parts):
        return
    if path.stem not in {"__main__", "manage", "asgi"}:
        parts = relative.with_suffix("").parts
        importlib.import_module(".".join(parts[:-1] if parts[-1] == "__init__" else parts))


def _subclasses(kind: type[Any]) -> Iterator[type[Any]]:
    for subclass in kind.__subclasses__():
        yield subclass
        yield from _subclasses(subclass)


def session_error_codes() -> list[str]:
    """The codes of replies `error`, as the generated page of the protocol lists them."""
    page = (ROOT / "docs" / "reference" / "protocol.md").read_text(encoding="utf-8")
    table = page.partition("\n## Errors\n")[2].partition("\n## ")[0]
    return re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE)


def diagnostic_codes() -> list[str]:
    table = json.loads((ROOT / "translator" / "diagnostics.json").read_text(encoding="utf-8"))
    rows = re.findall(r"\bBT\d{4}\b", json.dumps(table))
    others = [code for text in texts("executor") for code in re.findall(r"\bBT[A-Z]\d{3}\b", text)]
    return rows + others


def ram_words() -> list[str]:
    """Commands, events, states and names of worlds: every one-word literal of the dialect's folder."""
    words = []
    for _, tree in modules("executor/ram"):
        public = {text for node in ast.walk(tree) if _is_all(node) for text in strings(node)}
        words += [text for text in strings(tree) if re.fullmatch(r"[a-z][a-z0-9_-]+", text)]
        words = [word for word in words if word not in public]
    return words


def _is_all(node: ast.AST) -> bool:
    return isinstance(node, ast.Assign) and any(
        isinstance(target, ast.Name) and target.id == "__all__" for target in node.targets
    )


def own_strings() -> list[str]:
    found = [text for _, tree in modules("backend", "executor") for text in strings(tree)]
    from django.conf import settings

    cookies = [settings.SESSION_COOKIE_NAME, settings.CSRF_COOKIE_NAME, settings.LANGUAGE_COOKIE_NAME]
    kinds = [
        f"bt-studio {node.args[0].value!s}"
        for _, tree in modules("backend")
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and _called(node) in {"link_of", "token_of", "identity_of"}
        if node.args and isinstance(node.args[0], ast.Constant)
    ]
    return [text for text in found if OWN_STRING.fullmatch(text)] + cookies + kinds


def _called(call: ast.Call) -> str:
    return call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")


def _our_apps() -> list[Any]:
    from django.apps import apps

    return [config for config in apps.get_app_configs() if config.name.startswith("backend.")]


def django_apps() -> list[str]:
    return [config.label for config in _our_apps()]


def django_columns() -> list[str]:
    found = []
    for config in _our_apps():
        for model in config.get_models(include_auto_created=True):
            table = model._meta.db_table
            found += [table, f"{config.label}.{model.__name__}"]
            for field in model._meta.local_fields:
                found.append(f"{table}.{field.column}")
                # The choices of a language or a time zone are Django's.
                found += [f"{table}.{field.column}={value}" for value, _ in field.choices or ()]
    return found


def django_migrations() -> list[str]:
    return [
        f"{config.label}.{path.stem}"
        for config in _our_apps()
        for path in (Path(config.path) / "migrations").glob("[0-9]*.py")
    ]


def entry_points() -> list[str]:
    """Returns the modules that images and manifests start, and those that servers and installers receive."""
    found = ["backend.config.asgi:application", "backend.config.settings"]
    form = re.compile(r"""-m['"]?,?\s+['"]?((?:backend|executor|translator|tree_gardener)(?:\.\w+)*)""")
    for text in texts("docker", ".ci", ".github", "backend/sessions/keeper"):
        found += form.findall(text)
    found += re.findall(r'"([\w.]+:\w+)"', (ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    return found


def import_paths() -> list[str]:
    """The names that exported packages and users' actions import: the engine's, and the translator's."""
    found = []
    for path, tree in modules("tree_gardener"):
        relative = path.relative_to(ROOT).with_suffix("")
        name = ".".join(relative.parts).removesuffix(".__init__")
        found += [name, *(f"{name}.{public}" for public in _public_names(tree))]
    import translator

    return found + [f"translator.{name}" for name in translator.__all__]


def _public_names(tree: ast.Module) -> Iterator[str]:
    """Yields the names in a module's `__all__`, or else those that it defines."""
    for node in tree.body:
        if _is_all(node):
            yield from strings(node)
        elif isinstance(node, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            if not node.name.startswith("_"):
                yield node.name
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            for target in targets:
                if isinstance(target, ast.Name) and not target.id.startswith("_"):
                    yield target.id


def exported_files() -> list[str]:
    """The paths in the packages and apps of our examples."""
    from translator import open_path, to_app_zip, to_ros2_package

    found = []
    for folder in sorted((ROOT / "examples").iterdir()):
        project = open_path(folder)
        with zipfile.ZipFile(io.BytesIO(to_app_zip(project))) as app:
            found += [f"app {folder.name}: {path}" for path in app.namelist()]
        found += [f"package {folder.name}: {path}" for path in to_ros2_package(project).files]
    return found


def file_formats() -> list[str]:
    folder = ROOT / "docs" / "reference" / "schemas"
    return [
        f"{path.name.removesuffix('.schema.json')} {field}"
        for path in folder.glob("*.schema.json")
        for field in _fields(json.loads(path.read_text(encoding="utf-8")), "")
    ]


def _fields(schema: Any, path: str) -> Iterator[str]:
    if isinstance(schema, list):
        for item in schema:
            yield from _fields(item, path)
    if not isinstance(schema, dict):
        return
    for key, value in schema.items():
        if key == "properties":
            for name, inner in value.items():
                yield f"{path}{name}"
                yield from _fields(inner, f"{path}{name}.")
        elif key == "$defs":
            for name, inner in value.items():
                yield from _fields(inner, f"{name}: ")
        else:
            yield from _fields(value, path)


def _page_sources() -> list[str]:
    paths = files("frontend/src")
    return [
        path.read_text(encoding="utf-8")
        for path in paths
        if path.suffix in {".ts", ".tsx"} and ".test." not in path.name
    ]


def storage_keys() -> list[str]:
    form = re.compile(r"""['"`]((?:bts\.|bt-studio-)[\w.${}-]*)""")
    keys = [key for text in _page_sources() for key in form.findall(text)]
    return [re.sub(r"\$\{.*?\}", "…", key).replace("${", "…") for key in keys]


def tab_kinds() -> list[str]:
    """The panels and documents that layouts in browsers name."""
    text = "\n".join(_page_sources())
    panels = re.search(r"export type PanelId =([^;]*);", text)
    documents = re.search(r"export type DocumentTab =(.*?);\n", text, re.DOTALL)
    if panels is None or documents is None:
        raise LookupError("the types PanelId or DocumentTab have another name now: say so in `tab_kinds`")
    version = re.findall(r"bts\.layout\.\$\{VERSION\}", text)
    kinds = re.findall(r"kind: '(\w+)'", documents[1])
    return [*re.findall(r"'(\w+)'", panels[1]), *(f"document {kind}" for kind in kinds), *version]


def gone(stored: Names, found: Names) -> list[str]:
    """Returns the stored names that are no longer there, each with its kind."""
    return [
        f"{kind}: {name}"
        for kind, names in stored.items()
        for name in sorted(set(names) - set(found.get(kind, [])))
    ]


def new(stored: Names, found: Names) -> list[str]:
    """Returns the names that are not stored yet, each with its kind."""
    return gone(found, stored)


def read() -> Names:
    names: Names = json.loads(STORED.read_text(encoding="utf-8"))
    return names


def main(arguments: list[str]) -> int:
    """Compares, prints or writes the list. Returns 1 if names have disappeared that must not."""
    gc.disable()  # a short process that keeps every syntax tree
    found = collect()
    if "--print" in arguments:
        print(json.dumps(found))
        return 0
    missing = gone(read(), found) if STORED.exists() else []
    for line in missing:
        print(f"gone: {line}")
    if missing and "--forget" not in arguments:
        print(GONE)
        return 1
    STORED.write_text(json.dumps(found, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
