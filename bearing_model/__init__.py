"""The bearing in Python: reference of the C core, quasi-static equilibrium, and the readers of the data that both need.

    from bearing_model import Bearing, Load, Model, Parameters, simulate
    from bearing_model.quasi_static import quasi_static
    quasi_static(Bearing(), Load(F_y=2994.0, omega=1909.9)).Q_i     # ball loads [N]

Dynamics: each element of fmu_src stands here under the same name (race_contact, pocket, land_film, cage_joint, ring
...), rhs joins them to dy/dt, start finds the first state and integrator advances it with SciPy.  Without dynamics:
quasi_static, kinematics, hertz_exact.  After a run: fatigue, statistics.  The rivet table is read by
rivet_table and evaluated by rivet_rom.  Units are SI; nothing here loads an FMU.
"""

from importlib import import_module

PUBLIC = {
    "quasi_static": ("Bearing", "Load", "QuasiStatic"),
    "kinematics": ("fault_frequencies",),
    "physics.hertz_exact": ("ball_race_contact",),
    "physics.parameters": ("Parameters", "Inputs", "InputDerivatives"),
    "physics.model": ("Model", "Work"),
    "solver.start": ("start_state",),
    "physics.rhs": ("jacobian",),
    "solver.integrator": ("simulate", "observe"),
    "rivet.rivet_table": ("RivetTable",),
    "rivet.rivet_rom": ("RivetLoad", "rivet_rom_stress"),
    "instance.fatigue": ("FatigueLaw",),
}
HOMES = {name: module for module, names in PUBLIC.items() for name in names}
__all__ = list(HOMES)


def __getattr__(name):
    """Public names are imported when they are asked for: readers of the rivet table, and rivet_model, do without the
    dynamics.
    """
    if name not in HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{HOMES[name]}"), name)


def __dir__():
    return __all__
