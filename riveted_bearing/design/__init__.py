"""Studies over parameters: which of them decide a result, and which values are best.  Every answer is a mean over seeds
and is given with its noise.

bench turns points of a box into runs and responses; sensitivity ranks what decides, optimize looks for the best,
weibull fits lives with suspensions.
"""
