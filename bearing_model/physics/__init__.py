"""The elements of the bearing beside its cage, and the right-hand side that joins them."""
