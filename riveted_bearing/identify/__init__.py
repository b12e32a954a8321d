"""Parameters from measurements: which values of unknown parameters a rig's figures decide, and which they do not.  It
imports design and what lies below it.
"""
