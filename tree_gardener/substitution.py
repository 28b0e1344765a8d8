"""Substitution rules: nodes that are replaced by others when a tree is built, for tests.

The JSON form is BehaviorTree.CPP's: ``TestNodeConfigs`` by name, and ``SubstitutionRules`` from a node's
name, type or path (``*`` and ``?`` are wildcards) to the name of a config or of a node type.
"""

import dataclasses
import functools
import json
import re
from collections.abc import Mapping
from typing import Any

from tree_gardener.leaves.test_node import TestConfig
from tree_gardener.values import ConversionError, parse_status


class RuleError(ValueError):
    """Substitution rules that are invalid."""


@dataclasses.dataclass(frozen=True)
class Rule:
    """Nodes that match `pattern` become a TestNode with `config`, or else a node of type `type`."""

    pattern: str
    config: TestConfig | None = None
    type: str = ""

    def matches(self, name: str, kind: str, path: str) -> bool:
        """Returns whether the rule replaces a node."""
        return self.pattern in (name, kind) or _wildcards(self.pattern).fullmatch(path) is not None


@functools.lru_cache
def _wildcards(pattern: str) -> re.Pattern[str]:
    """Returns the regular expression of a pattern; all but ``*`` and ``?`` is plain."""
    parts = {"*": ".*", "?": "."}
    return re.compile("".join(parts.get(sign) or re.escape(sign) for sign in pattern), re.DOTALL)


def parse_rules(rules: Mapping[str, Any] | str) -> tuple[Rule, ...]:
    """Reads substitution rules, as JSON text or as the object.

    Raises:
        RuleError: the rules are invalid.
    """
    if isinstance(rules, str):
        try:
            rules = json.loads(rules)
        except ValueError as error:
            raise RuleError(f"the substitution rules are not JSON: {error}") from None
    if not isinstance(rules, Mapping):
        raise RuleError("the substitution rules are not an object")
    configs = {name: _config(name, config) for name, config in rules.get("TestNodeConfigs", {}).items()}
    return tuple(
        Rule(pattern, configs[target]) if target in configs else Rule(pattern, type=target)
        for pattern, target in rules.get("SubstitutionRules", {}).items()
    )


def _config(name: str, config: Mapping[str, Any]) -> TestConfig:
    script = config.get("return_status_script", "")
    if "return_status" not in config and not script:
        raise RuleError(f"the TestNodeConfig '{name}' has no return_status")
    try:
        status = parse_status(config.get("return_status", "SUCCESS"))
    except ConversionError as error:
        raise RuleError(f"the TestNodeConfig '{name}': {error}") from None
    return TestConfig(
        return_status=status,
        return_status_script=script,
        async_delay_s=config.get("async_delay", 0) / 1000.0,
        success_script=config.get("success_script", ""),
        failure_script=config.get("failure_script", ""),
        post_script=config.get("post_script", ""),
    )
