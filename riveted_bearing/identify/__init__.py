"""Parameters from measurements: which values of unknown parameters a test rig's figures decide, and which they do not.

measures (statistics and spectral lines of a series), study (the file: points, targets, parameters), rig (the runs),
surrogate (Gaussian processes), fit (screen, rounds, profiles, fresh seeds), answer (files, page), claims (the paper's).
"""
