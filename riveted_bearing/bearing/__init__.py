"""A bearing before anything runs: its file, designation, materials, oil, rivets and cage, what follows by rule, and the
limits of what can be built.  It imports base.
"""
