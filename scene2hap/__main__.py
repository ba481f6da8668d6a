"""``python -m scene2hap`` is the command line."""

import sys

from scene2hap.cli import main

sys.exit(main())
