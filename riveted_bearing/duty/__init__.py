"""From minutes to lives: a mission of operating points and events, its damage by Miner's rule, and how sure that is.

mission reads the file, history bins a measured record into points, cycles stores rainflow matrices, sn holds curves of
strength, miner adds up damage, confidence says how sure the life is and which runs it needs next, assess runs them,
tolerances asks how the lives of many bearings scatter, page shows it.
"""
