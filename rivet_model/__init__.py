"""From the geometry of one rivet joint to the table that the FMU reads: finite elements offline, splines online.

    from rivet_model import Geometry, make_table, write
    write(make_table(Geometry(fillet_radius=0.1e-3), coarse=True), "rivet.json")

The rivet: geometry -> elasticity (mesh, weak form) -> load_cases (unilateral contact) -> reduction (homogeneous
coordinates) -> splines -> table. The cage half: half (solid, mass, limits) -> cage_half (elements by waves) ->
joint_contact (pads and rivets) -> half_loads (load path, joint law) -> table; of a ribbon half: ribbon_shape, ribbon
(mesh) and land_bending (its lands in the load path) by the same doors.  Its vibration: half_modes (modes,
residual) -> impacts (their error) -> table. Commands: `python -m rivet_model.build`, `closed_form`, `embed`,
`friction`; docs/rivet.md explains them. Of bearing_model this package knows the table's format and how a table is
evaluated: rivet_table, rivet_rom, rivet_splines, joint_law, joint_open, half_path, half_modes.
"""

from importlib import import_module

PUBLIC = {
    "geometry": ("Geometry",),
    "load_cases": ("Joint",),
    "build": ("make_table",),
    "table": ("write",),
    "cage_half": ("CageHalf",),
}
HOMES = {name: module for module, names in PUBLIC.items() for name in names}
__all__ = list(HOMES)


def __getattr__(name):
    """Public names are imported when they are asked for: `embed` runs in builds that have neither SciPy nor scikit-fem."""
    if name not in HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{HOMES[name]}"), name)


def __dir__():
    return __all__
