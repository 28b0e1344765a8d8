"""`python -m executor.recorder.summary …`: the child that reads a recording; see `apart`."""

import sys

from executor.recorder.summary.apart import main

sys.exit(main(sys.argv[1:]))
