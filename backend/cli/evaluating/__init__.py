"""Commands that evaluate a project: one run or all of them, against an older version, as JUnit."""
