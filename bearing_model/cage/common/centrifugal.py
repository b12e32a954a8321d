"""The cage's own centrifugal load, which the rivet table has per (rad/s)^2 for a half of its own mass: for the bonded
joints of rigid halves, and for the modes of elastic ones.
"""

from bearing_model.generated.variables import Switch


def cage_centrifugal(p, table):
    """Factor of the table's load: the mass of the half over that of the table, 0 without the load."""
    return p.cage.m / table.half.m if p.cage.centrifugal == Switch.ON else 0.0
