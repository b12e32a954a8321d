"""Arrays over balls and vectors."""
