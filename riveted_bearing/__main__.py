"""The program riveted-bearing, also python -m riveted_bearing."""

import gc
import signal
import sys


def main():
    """Run the command line; Ctrl-C before it is loaded ends it with a line, after its work changes nothing more."""
    gc.set_threshold(100_000)  # what is imported stays: to look for garbage in it takes a tenth of the start
    try:
        from .cli import program

        program(prog_name="riveted-bearing")
    except KeyboardInterrupt:
        print("interrupted: no file has changed", file=sys.stderr)
        sys.exit(130)
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


if __name__ == "__main__":
    main()
