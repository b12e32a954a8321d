"""From the geometry of one rivet joint to the table that the FMU reads: finite elements offline, splines online."""
