"""Run the command line with ``python -m scene2hap``."""

import sys

from scene2hap.cli import main

sys.exit(main())
