"""The rules of what a test can read beside the modules that it imports and the processes that it starts.

Each row names data by patterns, and who reads it: everyone that imports or starts a module below one of these
paths. A path that is no module and has no row is read by every test. A row without readers is read by no dear
test: tests that are not dear always run.
"""

from __future__ import annotations

from fnmatch import fnmatchcase
from typing import Final, NamedTuple


class Row(NamedTuple):
    """Data, by patterns of `fnmatch` (`*` also matches slashes), and the prefixes of those that read it."""

    data: tuple[str, ...]
    readers: tuple[str, ...]


# The page as it is built, with what its build reads.
PAGE: Final = (
    *(
        "frontend/src/*",
        "frontend/public/*",
        "frontend/index.html",
        "frontend/tsconfig.json",
        "frontend/postcss.config.js",
    ),
    *("frontend/vite.config.ts", "frontend/bounds.ts", "frontend/compressed.ts", "frontend/notices.ts"),
    "frontend/validators.ts",
)
# What only the page's own tests and checks read; both always run.
PAGE_TESTS: Final = (
    *("frontend/src/*.test.ts", "frontend/src/*.test.tsx", "frontend/harness/*", "frontend/tools/*"),
    *("frontend/vitest.setup.ts", "frontend/eslint.config.js", "frontend/.*"),
)
ROWS: Final = (
    # The first row with a pattern that matches counts.
    Row(PAGE_TESTS, ("tests/executor/recorder/page.py",)),
    Row(
        ("frontend/src/features/code/templates/*",),
        ("tests/e2e/", "tests/executor/test_goal_template.py", "tests/backend/language/"),
    ),
    Row(
        PAGE,
        (
            "tests/e2e/",
            "tests/executor/recorder/page.py",
            "tests/executor/generate/",
            "tests/backend/cli/test_ci_workflow.py",
        ),
    ),
    Row(("tree_gardener/*",), ("tree_gardener/",)),
    Row(("translator/*",), ("translator/",)),
    Row(("executor/robots/*",), ("executor/robots/",)),
    Row(("executor/universes/*",), ("executor/universes/",)),
    Row(("executor/recorder/*",), ("executor/recorder/",)),
    Row(("executor/ros/*",), ("executor/ros/",)),
    Row(("executor/evaluation/*",), ("executor/evaluation/",)),
    Row(("executor/headless/*",), ("executor/headless/",)),
    Row(("backend/accounts/*",), ("backend/accounts/",)),
    Row(
        ("backend/catalog/*",),
        (
            "backend/catalog/",
            "tests/executor/evaluation/test_variation.py",
            "tests/tree_gardener/",
            "tests/translator/test_behaviour_tests.py",
        ),
    ),
    Row(("backend/config/*",), ("backend/config/",)),
    Row(("backend/sessions/*",), ("backend/sessions/",)),
    Row(
        ("docker/*", ".dockerignore"),
        (
            "tests/docker/",
            "tests/fakes/docker.py",
            "tests/backend/sessions/",
            "tests/executor/evaluation/sealed/test_launchers.py",
            "tests/tree_gardener/test_distribution.py",
        ),
    ),
    Row(
        ("docs/how-to/use-the-engine-by-itself.md",),
        ("tests/tree_gardener/test_distribution.py", "tests/backend/cli/test_ci_workflow.py"),
    ),
    Row(
        ("docs/explanation/action-errors.md",),
        ("tests/action_errors/", "tests/backend/cli/test_ci_workflow.py"),
    ),
    Row(("docs/*",), ("tests/backend/cli/test_ci_workflow.py",)),
    Row(
        (
            "README.md",
            "CHANGELOG.md",
            "CONTRIBUTING.md",
            "LICENSE",
            ".github/*",
            "findings/*",
            "zensical.toml",
            "requirements-docs.lock",
        ),
        (),
    ),
    Row(("tests/action_errors/*",), ("tests/action_errors/", "tests/benchmarks/ends.py")),
    Row(("tests/benchmarks/*",), ("tests/benchmarks/",)),
    Row(("tests/backend/*",), ("tests/backend/",)),
    Row(
        ("tests/conformance/*",),
        ("tests/conformance/", "tests/tree_gardener/", "tests/backend/cli/test_conformance.py"),
    ),
    Row(("tests/contracts/*", "tests/tools/*"), ()),
    Row(("tests/docker/*",), ("tests/docker/",)),
    Row(("tests/e2e/*",), ("tests/e2e/",)),
    Row(("tests/executor/recorder/*",), ("tests/executor/recorder/", "tests/backend/runs/", "tests/e2e/")),
    Row(("tests/executor/*",), ("tests/executor/",)),
    Row(("tests/fakes/*",), ("tests/fakes/",)),
    Row(("tests/ram_client/*",), ("tests/executor/ram/",)),
    Row(
        ("tests/shared/*",), ("tests/shared/", "tests/executor/", "tests/translator/", "tests/tree_gardener/")
    ),
    Row(("tests/translator/*",), ("tests/translator/",)),
)
# Tests of the sources themselves read all of them.
EVERYTHING: Final = ("tests/tools/", "tests/contracts/")
# Modules that are named in texts and not imported: who reads something below the first path can read all
# of the
# second. Django finds its settings, applications, middleware and addresses by names; a package has the whole
# engine; one test reads all sources of the executor.
NAMED: Final = (
    ("tests/backend/", "backend/"),
    ("backend/config/settings.py", "backend/"),
    ("translator/package/", "tree_gardener/"),
    ("tests/executor/world/physics/test_motion_lint.py", "executor/"),
)
# Who runs a function below the first path reads all sources below the second as texts: a package has the
# whole engine, and so has its wheel; the language server, which is no Python, follows links to the engine
# and to Python parts of ROS. `tests/tools/measuring` sees what Python opens; other programs read these
# without being seen.
READ_AS_TEXTS: Final = (
    ("tests/tree_gardener/distribution.py", "tree_gardener/"),
    ("translator/package/engine.py", "tree_gardener/"),
    ("backend/language/servers.py", "tree_gardener/"),
    ("backend/language/servers.py", "executor/ros_python/"),
    ("executor/tools/", "tree_gardener/"),
    ("executor/tools/", "executor/ros_python/"),
    ("tests/executor/world/physics/test_motion_lint.py", "executor/"),
)
# The files whose tests run programs that cannot be followed, as on other machines: imports stand for them.
NOT_FOLLOWED: Final = ("tests/docker/", "tests/test_setup.py")


def row_of(path: str, rows: tuple[Row, ...] = ROWS) -> Row | None:
    """Returns the row that knows a path of data."""
    return next((row for row in rows if any(fnmatchcase(path, pattern) for pattern in row.data)), None)
