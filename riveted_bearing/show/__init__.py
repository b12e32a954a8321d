"""Pictures and pages of runs: charts, spectra, the cage's orbit, the motion to play, measurements beside them.  It imports
the rooms of a run: base, bearing, running and building.
"""
