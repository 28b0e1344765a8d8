"""The child that expands xacro: `python -m executor.expansion`, with a job as JSON on standard input."""

import sys

from executor.expansion.child import main

if __name__ == "__main__":
    sys.exit(main())
