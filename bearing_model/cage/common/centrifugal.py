"""The centrifugal load of the cage halves.  The rivet table gives this load per (rad/s)^2 for the mass of the table's
half.  It loads the bonded joints of rigid halves and the modes of elastic halves.
"""

from bearing_model.generated.variables import Switch


def cage_centrifugal(p, table):
    """Factor of the table's load: the mass of the half over that of the table, 0 without the load."""
    return p.cage.m / table.half.m if p.cage.centrifugal == Switch.ON else 0.0
