"""Many runs: sweeps on a cluster and their rows, data sets to train on, stiffness and damping over speed and load.  It
imports show and what lies below it.
"""
