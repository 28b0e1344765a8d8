"""``python -m tree_gardener.testing``: runs the job on standard input; `apart` starts it."""

import sys

from tree_gardener.descendants import guarded
from tree_gardener.testing.apart import serve

if __name__ == "__main__":
    sys.exit(guarded(serve, int(sys.argv[2])))
