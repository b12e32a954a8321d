"""Ctrl-C: kept back while something must not be cut in two."""

import signal
import threading
from multiprocessing import resource_tracker


class held_interrupts:
    """While this context lasts, Ctrl-C only sets `pending`: else KeyboardInterrupt may come between a finished step and its
    place in the result, or in a callback of the FMU, where it is lost.  Nothing changes outside a program's main thread.
    """

    def __enter__(self):
        self.pending = False
        self.main = threading.current_thread() is threading.main_thread()
        if self.main:
            self.before = signal.signal(signal.SIGINT, self.note)
        return self

    def __exit__(self, *_):
        if self.main:
            signal.signal(signal.SIGINT, self.before)

    def note(self, *_):
        """Handler of the signal."""
        self.pending = True


class kept_from_children(held_interrupts):
    """Ctrl-C only sets `pending`, and processes started meanwhile never receive it: they inherit the mask.  Where signals have
    no masks (Windows), it is ignored and `pending` stays false.
    """

    def __enter__(self):
        super().__enter__()
        if self.main and hasattr(signal, "pthread_sigmask"):
            resource_tracker.ensure_running()  # before: its start lifts the mask of the thread that needs it first
            self.mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        elif self.main:
            signal.signal(signal.SIGINT, signal.SIG_IGN)
        return self

    def __exit__(self, *_):
        if self.main and hasattr(signal, "pthread_sigmask"):
            signal.pthread_sigmask(signal.SIG_SETMASK, self.mask)
        super().__exit__()
