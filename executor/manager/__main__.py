"""`python -m executor.manager`: the manager of one session."""

import sys

from executor.manager.manager import main

sys.exit(main())
