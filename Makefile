# `make run` sets up what is missing and serves the IDE; `make test` sets up what is missing and runs every test.
.DEFAULT_GOAL := help
.PHONY: audit docs lock-images mutants sbom help run test test-full test-docker lint format bench lock wheel clean setup setup-test lint-python lint-frontend generate

PYTHON := $(shell for p in python3.11 python3 python; do "$$p" -c 'import sys; sys.exit(sys.version_info[:2] != (3, 11))' 2>/dev/null && { echo $$p; break; }; done)
# Where no Python 3.11 is found, any Python 3 can still say so in one sentence.
SETUP_PYTHON := $(or $(PYTHON),$(shell command -v python3))
BIN := .venv/bin
# Hashes and no index address: a lock names no registry. The engine is installed from the clone.
LOCK := --no-emit-package tree-gardener --quiet --upgrade --generate-hashes --no-header --no-annotate --python-version 3.11 --python-platform x86_64-manylinux_2_28

help: ## shows this list
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 16

setup:
	@if [ -z "$(SETUP_PYTHON)" ]; then echo "set-up: Python is missing; install CPython 3.11 so that \`python3.11\` is found." >&2; exit 1; fi
	@$(SETUP_PYTHON) backend/setup run

setup-test:
	@if [ -z "$(SETUP_PYTHON)" ]; then echo "set-up: Python is missing; install CPython 3.11 so that \`python3.11\` is found." >&2; exit 1; fi
	@$(SETUP_PYTHON) backend/setup test

run: setup ## sets up what is missing, then serves the IDE on http://127.0.0.1:8000 and opens the browser
	@$(BIN)/bt-studio serve $(ARGS)

test: setup-test ## sets up what is missing, then runs the tests that a change can break, the core and a sample
	@$(BIN)/python -m tests.tools.suite

test-full: setup-test ## all tests with the large counts of tests/budget.toml; SHARD=3/8 for a part, COUNTS=test for small counts
	@$(BIN)/python -m tests.tools.suite --full

test-docker: export BT_STUDIO_FULL = 1
test-docker: setup-test ## builds the images and tries the server for a team in real containers (needs root)
	@$(BIN)/python -m pytest --timeout 0 tests/docker

mutants: ## changes 150 random lines of the page and 150 of Python; at least 60 % must make a test fail (hours)
	@$(BIN)/python -m tests.tools.mutating.page
	@$(BIN)/python -m tests.tools.mutating.python

lint: ## style, types, the direction of imports, the list of words and the documents, in Python and TypeScript
	@$(MAKE) --no-print-directory --jobs 2 --output-sync=target lint-python lint-frontend

lint-python:
	@$(BIN)/ruff check . && $(BIN)/ruff format --check .
	@$(BIN)/mypy
	@$(BIN)/lint-imports
	@$(BIN)/python -m tests.tools.words && $(BIN)/python -m tests.tools.mirror
	@$(BIN)/python -m tests.tools.sleeps && $(BIN)/python -m tests.tools.seams && $(BIN)/python -m tests.tools.pages

lint-frontend:
	@cd frontend && npm run --silent lint

format: ## rewrites the sources in the project's style
	@$(BIN)/ruff check --fix . ; $(BIN)/ruff format . ; cd frontend && npm run --silent format

docs: var/docs/installed ## builds the documentation site from docs/, to var/site
	@var/docs/env/bin/zensical build --clean --strict
	@echo "Open var/site/index.html"

var/docs/installed: requirements-docs.lock
	@test -n "$(PYTHON)" || { echo "make docs: Python is missing; install CPython 3.11 so that \`python3.11\` is found." >&2; exit 1; }
	@$(PYTHON) -m venv --clear var/docs/env
	@var/docs/env/bin/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements-docs.lock
	@touch $@

wheel: setup ## builds the engine's wheel, `tree-gardener`, to var/wheels
	@rm -rf var/build/tree_gardener
	@$(BIN)/uv build --wheel --quiet --no-build-isolation --python $(BIN)/python --out-dir var/wheels tree_gardener

bench: setup-test ## the benchmarks, side by side with their rivals
	@$(BIN)/python -m tests.benchmarks

generate: setup-test ## writes the generated sources and reference pages again
	@$(BIN)/python -m tests.tools.generate

nav2-tables: setup-test ## writes the tables of Nav2's nodes again: SOURCE=FOLDER, a clone of Nav2 with its branches
	@$(BIN)/python -m tests.tools.nav2_tables $(SOURCE)

nav2-trees: setup-test ## drives with each tree that Nav2 ships and writes the page of the outcomes: SOURCE as above
	@$(BIN)/python -m tests.tools.nav2_trees $(SOURCE)

lock: setup-test ## writes the locks again, with the newest versions that pyproject.toml admits
	@$(BIN)/uv pip compile pyproject.toml $(LOCK) -o requirements.lock
	@$(BIN)/uv pip compile pyproject.toml --group dev -c requirements.lock $(LOCK) -o requirements-dev.lock
	@$(BIN)/uv pip compile --group docs -c requirements-dev.lock $(LOCK) -o requirements-docs.lock
	@$(BIN)/uv pip compile docker/evaluation.in -c requirements.lock -c requirements-dev.lock $(LOCK) -o docker/evaluation.lock

lock-images: ## asks the registry for the digests of the base images (needs Docker and a registry)
	@bash docker/bases/lock.sh

audit: setup-test ## asks the advisory services about all locked packages (needs the internet)
	@$(BIN)/python -m tests.tools.audit

sbom: setup-test ## writes what the program is made of as CycloneDX, to var/sbom
	@$(BIN)/python -m tests.tools.sbom var/sbom

clean: ## removes everything that set-up and runs made, but for your projects in var/data
	rm -rf .venv frontend/node_modules frontend/dist var/setup var/docs var/site var/build var/wheels *.egg-info .mypy_cache .ruff_cache .pytest_cache .hypothesis
