"""Pockets, joints and the law of opening joints, for rigid and elastic halves."""
