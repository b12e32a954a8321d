"""Studies over parameters: which of them decide a result, which values are best, and what happens after the first rivet.
Every answer is a mean over seeds with an interval; it imports duty and what lies below it.
"""
