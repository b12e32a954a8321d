"""The paper's study again (Cui et al., Machines 2023, 11, 700): its sweeps and pictures (study), its claims (claims),
the page about both (paper).
"""
