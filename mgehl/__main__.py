"""``python -m mgehl``."""

import sys

from mgehl.cli import main

if __name__ == "__main__":
    sys.exit(main())
