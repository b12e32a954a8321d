"""The outputs of a run as they come: column by column, on disk if there are many, so that a long run needs no more
memory than a short one.
"""

import tempfile

import numpy as np

from ..base.files import cache_folder

IN_MEMORY = 64 * 2**20  # bytes of a result that stay in memory
BLOCK = 1024  # rows that are turned into columns together


class Record:
    """Columns of at most `count` rows, written one after the other, the last one again if need be; columns() ends it.  A large
    record is a file of the user's cache that the system removes, so that it needs no memory.
    """

    def __init__(self, count, width):
        shape = (width, count)
        if 8 * width * count > IN_MEMORY:
            with tempfile.TemporaryFile(dir=cache_folder("runs")) as file:
                self.data = np.memmap(file, np.float64, "w+", shape=shape)
        else:
            self.data = np.empty(shape)
        self.block = np.empty((min(BLOCK, count), width))
        self.first = self.row = 0

    def write(self, row, values):
        """Write the last row, or the one behind it."""
        if row - self.first == len(self.block):
            self.turn(row)
        self.block[row - self.first] = values
        self.row = row

    def last(self, places):
        """A copy of some numbers of the last row."""
        return self.block[self.row - self.first, places]

    def turn(self, end):
        """Put the rows up to `end` into the columns."""
        self.data[:, self.first : end] = self.block[: end - self.first].T
        self.first = end

    def columns(self):
        """All columns up to the last row, each an array without gaps."""
        self.turn(self.row + 1)
        return self.data[:, : self.row + 1]
