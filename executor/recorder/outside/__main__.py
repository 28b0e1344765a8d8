"""`python -m executor.recorder.outside SOURCE TARGET NAME`: the child that converts; see `apart`."""

import sys

from executor.recorder.outside.apart import main

sys.exit(main(sys.argv[1:]))
