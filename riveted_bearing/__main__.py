"""The program riveted-bearing, also python -m riveted_bearing."""

import signal
import sys


def main():
    """Run the command line; Ctrl-C before it is loaded ends it with a line, and after its work is done changes nothing
    more.
    """
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
