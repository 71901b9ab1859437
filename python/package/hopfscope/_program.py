"""The program `hopfscope`, run in this process."""

import signal
import sys


def main() -> int:
    """Runs the program with the words of the command line; returns its exit code."""
    # The program has its own ways with signals; without them, Ctrl-C ends it.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    from ._hopfscope import program

    return program(["hopfscope", *sys.argv[1:]], sys.stdout is None)
