"""The cage: pockets and joints (common), rigid halves (two_half), halves that vibrate (elastic)."""
