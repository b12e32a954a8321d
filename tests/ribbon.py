"""A ribbon cage for the 6207's balls and pitch circle, by which the pockets are tested on the table of the machined cage."""

RIBBON = {
    "cage.shape": 2,
    "cage.guidance": 2,
    "cage.sheet": 0.9e-3,
    "cage.pocket_fillet": 1.5e-3,
    "cage.pocket_clearance": 0.2e-3,
    "cage.pocket_depth": 0.0111125 / 2 + 0.05e-3,
    "cage.width": 2.0 * (0.0111125 / 2 + 0.95e-3),
    "cage.D_o": 0.0535 + 0.005,
    "cage.D_i": 0.0535 - 0.005,
    "oil.rolling": 0.0,
}
