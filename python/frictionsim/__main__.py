"""The command line, ``frictionsim`` and ``python -m frictionsim``."""

from __future__ import annotations

import signal
import sys

from . import _native


def main() -> None:
    """Run the command line and exit with its code."""
    # Signals are the program's own from here on.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(_native.command_line(["frictionsim", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
