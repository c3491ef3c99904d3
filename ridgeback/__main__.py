"""``python -m ridgeback`` does what the command does."""

from __future__ import annotations

import sys

from ridgeback.cli import main

if __name__ == "__main__":
    sys.exit(main())
