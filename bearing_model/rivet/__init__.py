"""The rivet table and its evaluation: loads and stress of the rivets."""
