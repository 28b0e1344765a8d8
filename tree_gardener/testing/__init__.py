"""Behaviour tests: a tree alone, with doubles for its leaves, on a clock that does not wait.

```python
from tree_gardener.testing import Suite, read_tests

suite = Suite(xml, nodes)
cases, problems = read_tests(document, "tests/drive.test.yaml", suite=suite)
results = [suite.run(case) for case in cases]
```

The form of the document is described in ``docs/reference/behaviour-tests.md``. This package reads plain
dictionaries; a caller that has YAML reads it before.
"""

from tree_gardener.testing.cases import Case, Failure, Result
from tree_gardener.testing.coverage import Coverage
from tree_gardener.testing.doubles import LeafModel, leaf_models
from tree_gardener.testing.reading import read_tests
from tree_gardener.testing.suite import Suite

__all__ = ["Case", "Coverage", "Failure", "LeafModel", "Result", "Suite", "leaf_models", "read_tests"]
