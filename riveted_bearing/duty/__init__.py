"""From minutes to lives: a mission of operating points and of events such as shocks, its damage by Miner's rule, how sure
that is, and the sheet that says it.  It imports studies and what lies below it.
"""
