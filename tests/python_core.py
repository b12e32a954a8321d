"""The Python reference behind the interface of library.Core, as far as tests of elements use it: the same assertions
run on both twins.

core = PythonCore()
model = core.model(parameters={"bearing.P_d": 0.0})
model.kernel("drag_force")(model.pointer, model.work)
model.work.F_t
"""

import functools
from types import SimpleNamespace

import numpy as np
from library import TWO_HALF

from bearing_model.cage.cage import cage_derive, cage_pockets
from bearing_model.generated import variables
from bearing_model.instance.energy import energy_total
from bearing_model.physics import derived, drag, hertz, land_film, race_contact, traction
from bearing_model.physics.model import Model, Work
from bearing_model.physics.parameters import Inputs, Parameters
from bearing_model.physics.rhs import rhs
from bearing_model.physics.ring_load import ring_load_update
from bearing_model.physics.rotor import Rotor
from bearing_model.physics.temperature import temperature_apply
from bearing_model.solver.start import start_state

Z = variables.Z
ELEMENTS = (
    race_contact.race_contact_force,
    cage_pockets,
    drag.drag_mixture,
    drag.drag_force,
    drag.drag_cage,
    drag.drag_ring,
    land_film.land_film_force,
)
KERNELS = {f.__name__: f for f in ELEMENTS}
PLACES = ("x", "r", "theta", "cos_theta", "sin_theta", "v_x", "v_r", "v_t", "omega_m", "omega_x", "omega_r", "omega_t")
VECTORS = {f"{kind}_{axis}": (kind, i) for kind in "FM" for i, axis in enumerate("xrt")}
WRENCH = {f"ring_{kind}_{axis}": (f"ring_{kind}", i) for kind in "FM" for i, axis in enumerate("xyz")}
NORMALS = {f"n_{race}{axis}": (f"n_{race}", i) for race in "ie" for i, axis in enumerate("xrt")}
RATES = {f"{kind}_{axis}": (kind, i) for kind in ("D", "D_omega") for i, axis in enumerate("xrt")}
COMPONENTS = VECTORS | WRENCH | NORMALS | RATES
DISSIPATED = ("race_dissipated", "pocket_dissipated", "drag_dissipated")


class Body:
    """A Rotor whose vectors have three numbers and whose spin is one."""

    def __init__(self, rotor):
        object.__setattr__(self, "rotor", rotor)

    def __getattr__(self, name):
        value = getattr(self.rotor, name)[..., 0]
        return value if np.ndim(value) else float(value)

    def __setattr__(self, name, value):
        shape = (1,) if name == "s" else (3, 1)
        setattr(
            self.rotor,
            name,
            np.broadcast_to(
                np.reshape(np.asarray(value, dtype=float), (-1, 1) if shape == (3, 1) else -1), shape
            ).copy(),
        )


class PythonWork:
    """A Work with the names of the C struct: components F_x, F_r ... n_ix, bodies as Body, numbers of a body or of all
    balls as floats.
    """

    def __init__(self):
        zero = {name: np.zeros(Z) for name in PLACES}
        w = Work(
            **zero,
            F=np.zeros((3, Z)),
            M=np.zeros((3, Z)),
            D=np.zeros((3, Z)),
            D_omega=np.zeros((3, Z)),
            ring=Rotor(),
            half=[Rotor(), Rotor()],
            frame_omega=0.0,
        )
        object.__setattr__(self, "w", w)
        for body in (self.ring, *self.half):
            body.F = body.M = 0.0

    @property
    def ring(self):
        return Body(self.w.ring)

    @property
    def half(self):
        return [Body(half) for half in self.w.half]

    @property
    def dissipated(self):
        return np.zeros(Z) + sum(getattr(self.w, name, 0.0) for name in DISSIPATED)

    @property
    def delta_c(self):
        return np.array(self.w.delta_c)

    @property
    def pocket(self):
        """Load, force and moment about the half's centre of each ball on each half."""

        def of_half(on):
            rows = zip(("F_x", "F_y", "F_z", "M_x", "M_y", "M_z"), (*on.half_F, *on.half_M), strict=True)
            return SimpleNamespace(Q=on.Q, **{f"half_{name}": row for name, row in rows})

        return [of_half(on) for on in self.w.pocket]

    def __getattr__(self, name):
        if name in COMPONENTS:
            array, i = COMPONENTS[name]
            return getattr(self.w, array)[i]
        value = getattr(self.w, name)
        return float(value[0]) if np.shape(value) == (1,) else value

    def __setattr__(self, name, value):
        setattr(self.w, name, value)


class Members(SimpleNamespace):
    """Members that accept lists, as arrays of C structs do."""

    def __setattr__(self, name, value):
        super().__setattr__(name, np.array(value) if isinstance(value, list) else value)


class PythonModel:
    """Parameters, inputs, derived constants and the results of the last evaluation."""

    def __init__(self, core, parameters, inputs):
        self.core, self.work, self.turn = core, PythonWork(), None
        self.p, self.u = Parameters(), Inputs()
        for values, changes in ((self.p, parameters), (self.u, inputs)):  # unchecked, as the C structs are
            for name, value in changes.items():
                group, member = name.replace("[j]", "").replace("[k]", "").replace("[n]", "").split(".")
                value = np.array(value) if isinstance(value, list) else value
                setattr(getattr(values, group), member + "_" * (member == "lambda"), value)
        self.p.mark_given(variables.PARAMETERS)
        self.p = temperature_apply(self.p, self.u, derived.default_table())
        self.d = derive(self.p, Members())
        self.modes = cage_derive(self.p, self.d, derived.default_table())
        self.pointer = self

    def model(self, t=0.0):
        return Model(self.p, self.d, ring_load_update(self.p, self.u, t), modes=self.modes, turn=self.turn)

    def kernel(self, name):
        return lambda _, work: KERNELS[name](self.model(), work.w)

    def solve_start(self):
        """State and residual force of the quasi-static start; the work struct keeps its contacts."""
        y, residual = start_state(self.model())
        self.rhs(0.0, y)
        return y, residual

    def start(self):
        return self.solve_start()[0]

    def rhs(self, t, y):
        return rhs(self.model(t), t, np.asarray(y, dtype=float), self.work.w)

    def energy(self, y):
        return float(energy_total(self.model(), np.asarray(y, dtype=float), self.work.w))


def derive(p, d):
    """Derived constants into the namespace d, their parts as changeable as C structs."""
    vars(d).update(vars(derived.model_derive(p)))
    for name in ("inner", "outer"):
        race = getattr(d, name)
        setattr(d, name, SimpleNamespace(**race._asdict() | {"hertz": SimpleNamespace(**race.hertz._asdict())}))
    d.pocket = SimpleNamespace(**d.pocket._asdict())
    return d


class PythonCore:
    """Models and the functions of hertz and traction under their names in the tests' C library."""

    name = "Python"

    def __init__(self):
        self.lib = SimpleNamespace(
            hertz_contact=hertz.hertz_contact,
            test_hertz_load=lambda delta, K: hertz.hertz_load(K, delta),
            test_hertz_damped=lambda delta_dot, Q, lambda_: hertz.hertz_damped(Q, lambda_, delta_dot),
            test_traction_mu=lambda s, p, f_a, mixed: traction.traction_mu(p, s, f_a, mixed),
            test_traction_asperity_share=traction.traction_asperity_share,
            test_traction_ln_film=lambda u, ln_1, Q: traction.traction_ln_film(ln_1, np.log(u), np.log(Q)),
            test_traction_inlet=lambda u, rolling, Q: traction.traction_inlet(
                rolling, np.log(u), Q, np.log(Q + traction.Q_FLOOR)
            ),
            test_traction_race_inlet=lambda u, d, rolling, Q: traction.traction_race_inlet(
                d, rolling, u, np.log(u), Q, np.log(Q + traction.Q_FLOOR)
            ),
            test_traction_ln_thermal=lambda u, ln_thermal: traction.traction_ln_thermal(ln_thermal, np.log(u)),
            model_derive=derive,
        )

    def model(self, parameters=None, inputs=None, isa=None):
        return PythonModel(self, TWO_HALF | (parameters or {}), inputs or {})

    def map(self, function, x, *before):
        return np.asarray(function(np.ascontiguousarray(x, dtype=float), *before))


@functools.cache
def python_core():
    return PythonCore()
