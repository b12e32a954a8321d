"""Interpolation by the clamped quadratic B-splines of bearing_model.rivet.rivet_splines, on one axis and on products of
axes.
"""

from bearing_model.rivet.rivet_splines import collocation, interpolate, sites

__all__ = ["collocation", "interpolate", "sites"]
