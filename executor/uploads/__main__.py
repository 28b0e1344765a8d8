"""`python -m executor.uploads FOLDER`: the child that reads an upload."""

from __future__ import annotations

import sys

from executor.uploads.child import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
