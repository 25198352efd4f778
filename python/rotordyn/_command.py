"""The command ``rotordyn``."""

from __future__ import annotations

import signal
import sys

from . import _native


def main() -> int:
    """Performs the command of ``sys.argv``; returns its exit code."""
    # The command stops cleanly by itself; Python's handler would raise KeyboardInterrupt behind it.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _native.command(["rotordyn", *sys.argv[1:]])


if __name__ == "__main__":
    raise SystemExit(main())
