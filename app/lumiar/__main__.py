"""`python -m lumiar` is the command `lumiar`."""

import sys

from .cli import main

sys.exit(main())
