"""An FMU for a bearing: rivet table, compilation, and the comparison with the Python reference.  It imports base, bearing
and running.
"""
