"""What decides and what to choose: studies over parameters in which every answer is a mean over seeds, with its noise
beside it.

bench turns points of a box into runs and responses; sensitivity ranks what decides, optimize looks for the best,
weibull fits lives with suspensions.
"""
