"""What the tests of the dynamics share: views of C structs, poses of bodies, states away from rest."""

import numpy as np
import pytest
import ribbon
from library import TWO_HALF
from python_core import Body, PythonWork
from scipy.spatial.transform import Rotation

from bearing_model.cage.elastic.elastic_half import mode_order
from bearing_model.generated import variables
from bearing_model.physics.derived import default_table
from bearing_model.physics.hertz_exact import HertzContact, hertz_ellipse

Z = variables.Z
SLICE = variables.STATE_SLICES
OUTPUTS = {name.replace("[j]", "").replace("[k]", ""): variable for name, variable in variables.OUTPUTS.items()}


def view(core, member):
    """A member array of a C struct as numpy sees it: (n,) or (m, n); writes go into the struct."""
    array = np.frombuffer(core.ffi.buffer(member), dtype=float)
    kind = core.ffi.typeof(member)
    return array.reshape(kind.length, -1) if kind.item.kind == "array" else array


class View:
    """Members of a C struct by name: arrays as numpy views, numbers as they are."""

    def __new__(cls, core, struct):
        return struct if isinstance(struct, (Body, PythonWork)) else super().__new__(cls)

    def __init__(self, core, struct):
        object.__setattr__(self, "core", core)
        object.__setattr__(self, "struct", struct)

    def __getattr__(self, name):
        member = getattr(self.struct, name)
        return (
            view(self.core, member)
            if isinstance(member, self.core.ffi.CData) and self.core.ffi.typeof(member).kind == "array"
            else member
        )

    def __setattr__(self, name, value):
        if isinstance(getattr(self.struct, name), (float, int)):
            setattr(self.struct, name, value)
        else:
            getattr(self, name)[...] = value


def axis(beta, gamma):
    """Axis a = (a_x, gamma, -beta) of a tilted body."""
    return np.array([np.sqrt(1.0 - beta**2 - gamma**2), gamma, -beta])


def pose(core, rotor, x=(0, 0, 0), v=(0, 0, 0), frame=None, Omega=(0, 0, 0)):
    """Places a Rotor: centre, velocity, body axes (columns a, b_y, b_z) and angular velocity."""
    frame = np.eye(3) if frame is None else frame
    r = View(core, rotor)
    r.x, r.v, r.Omega = x, v, Omega
    r.a, r.b_y, r.b_z = frame.T
    r.a_dot = np.cross(Omega, frame[:, 0])
    r.s = float(np.dot(Omega, frame[:, 0]))
    r.F = r.M = 0.0


def frames(theta):
    """The balls' frames: (Z, 3, 3), rows e_x, e_r, e_t in the global frame."""
    c, s, o = np.cos(theta), np.sin(theta), np.zeros_like(theta)
    return np.stack([np.stack([o + 1, o, o], -1), np.stack([o, c, s], -1), np.stack([o, -s, c], -1)], 1)


def place_balls(model, x, r, theta, v=None, omega=None, omega_m=None):
    """Writes the kinematics of all balls into Work, alike for all or [Z]; v in the balls' frames, its t part is r omega_m."""
    w = View(model.core, model.work)
    n = slice(0, Z)
    w.x[n], w.r[n], w.theta[n] = x, r, theta
    w.cos_theta[n], w.sin_theta[n] = np.cos(theta), np.sin(theta)
    v, omega = (np.broadcast_to(np.zeros(3) if each is None else each, (Z, 3)) for each in (v, omega))
    w.v_x[n], w.v_r[n], w.v_t[n] = v.T
    w.omega_m[n] = v[:, 2] / r if omega_m is None else omega_m
    w.omega_x[n], w.omega_r[n], w.omega_t[n] = omega.T
    return w


def clear_balls(w):
    """Nothing acts on the balls yet: the accumulators of cage_pockets and drag_force."""
    for name in (
        "F_x",
        "F_r",
        "F_t",
        "M_x",
        "M_r",
        "M_t",
        "D_x",
        "D_r",
        "D_t",
        "D_omega_x",
        "D_omega_r",
        "D_omega_t",
        "dissipated",
    ):
        getattr(w, name)[:] = 0.0


def on_ball(w):
    """Force and moment on each ball in its frame, (Z, 3) each."""
    n = slice(0, Z)
    return np.stack([w.F_x[n], w.F_r[n], w.F_t[n]], -1), np.stack([w.M_x[n], w.M_r[n], w.M_t[n]], -1)


def ring_wrench(w):
    """Force and moment on the inner ring by each ball, about the ring's centre, global frame, (Z, 3) each."""
    rows = np.array([getattr(w, f"ring_{kind}_{i}")[:Z] for kind in "FM" for i in "xyz"])
    return rows[:3].T, rows[3:].T


def pocket_wrench(model, h):
    """Force and moment on half h by each ball, about the half's centre, global frame, (Z, 3) each."""
    row = model.work.pocket[h]
    return tuple(np.array([list(getattr(row, f"half_{kind}_{i}"))[:Z] for i in "xyz"]).T for kind in "FM")


def bodies_of(m, rng, apart):
    """The halves of a model displaced by up to `apart` [m], tilted, turning and moving."""
    for half in m.work.half:
        body = {
            "x": rng.uniform(-apart, apart, 3),
            "v": rng.uniform(-0.2, 0.2, 3),
            "frame": Rotation.from_rotvec(rng.uniform(-3e-4, 3e-4, 3)).as_matrix(),
            "Omega": np.array([757.0, 0, 0]) + rng.uniform(-5, 5, 3),
        }
        pose(m.core, half, **body)
        yield body


def assert_balanced(m, w, ball, bodies, energy):
    """Forces and moments about the bearing's centre cancel over each ball and the halves, to 1e-13 of force and arm; the power
    that the contacts take from them is stored, by differences of the energy(place, body, j, side) along the motion over
    1e-9 s, or dissipated, to 3e-6 of the force times 1 m/s; observed 1e-16 and 3e-7.
    """
    F, M = on_ball(w)
    axes = frames(ball["theta"])
    for j in range(Z):
        place, v = axes[j].T @ [ball["x"][j], ball["r"][j], 0.0], axes[j].T @ ball["v"][j]
        force = axes[j].T @ F[j]
        moment = np.cross(place, force) + axes[j].T @ M[j]
        power, stored, scale = F[j] @ ball["v"][j] + M[j] @ ball["omega"][j], 0.0, np.abs(F[j]).max()
        for index, (side, body) in enumerate(zip((-1, 1), bodies, strict=True)):
            F_half, M_half = (part[j] for part in pocket_wrench(m, index))
            force = force + F_half
            moment = moment + np.cross(body["x"], F_half) + M_half
            power += F_half @ body["v"] + M_half @ body["Omega"]

            def at(t, body=body, side=side, j=j, place=place, v=v):
                frame = Rotation.from_rotvec(body["Omega"] * t).as_matrix() @ body["frame"]
                return energy(place + v * t, {"x": body["x"] + body["v"] * t, "frame": frame}, j, side)

            stored += (at(1e-9) - at(-1e-9)) / 2e-9
        assert force == pytest.approx(np.zeros(3), abs=1e-13 * (scale + 1.0))
        assert moment == pytest.approx(np.zeros(3), abs=1e-13 * (scale + 1.0) * ball["r"][j])
        assert w.dissipated[j] == pytest.approx(-power - stored, abs=3e-6 * scale + 1e-9)


def pocket_contact(clearance=2e-4):
    """Hertz contact of ball and pocket at the default geometry, by the quasi-static model: the long half axis lies
    around the pocket's axis.
    """
    R = 0.5 * 0.0111125
    curvatures = np.array([1.0 / R, 1.0 / R - 1.0 / (R + 0.5 * clearance)])  # along the pocket's axis the ball alone
    F_rho = (curvatures[0] - curvatures[1]) / curvatures.sum()
    return HertzContact(
        curvatures.sum(), F_rho, 1.0 / ((1.0 - 0.3**2) / 207e9 + (1.0 - 0.33**2) / 110e9), hertz_ellipse(F_rho)
    )


def pocket_loads(model):
    """Contact load of each ball with each half, (2, Z) [N]."""
    return np.array([list(model.work.pocket[h].Q)[:Z] for h in range(2)])


def film_rates(w, j):
    """Sum over the halves of D m m^T [3, 3] of the films before ball j in a work of the twin or a View of the core's, along the
    pocket's axes.
    """
    if isinstance(w, PythonWork):
        films = [(film["D"][j], film["m"][:, j]) for film in w.films]
    else:
        of = w.cage.films
        films = [(of.D[h][j], np.array([of.m[i][h][j] for i in range(3)])) for h in range(2)]
    return sum(D * np.outer(m, m) for D, m in films)


def assert_step_gets_film(moved, least):
    """D m m^T is minus the derivative of the force on a ball by its velocity, where the floor does not matter.

    moved(dv): the working memory with the ball faster by dv [m/s]; least: of the derivative's largest entry [N s/m]
    """
    step = 1e-4
    J = np.array([(on_ball(moved(np.zeros(3)))[0][0] - on_ball(moved(step * d))[0][0]) / step for d in np.eye(3)]).T
    D = film_rates(moved(np.zeros(3)), 0)
    # along other axes; the floor's change with the speed: h_e^2/h^2
    assert np.linalg.eigvalsh(D) == pytest.approx(np.linalg.eigvalsh(0.5 * (J + J.T)), abs=0.02 * np.abs(J).max())
    assert np.abs(J).max() > least


def running_state(model, rng, *, pockets=True, slip=1.0, stuck=False):
    """A state near the quasi-static start with every element at work: pockets closed, cage off centre and tilted,
    joints offset; their friction holds.

    `slip` scales all velocities' deviations from pure rolling; without `pockets` no ball touches the cage;
    `stuck`: the halves move as one rigid body.
    """
    y = model.start()
    p, d = model.p, model.d
    r_0 = 0.5 * p.bearing.d_m

    def add(name, scale):
        y[SLICE[name]] += scale * rng.uniform(-1.0, 1.0, SLICE[name].stop - SLICE[name].start)

    add("ball_x", 5e-6), add("ball_r", 4e-6)
    add("ball_v_x", 0.05 * slip), add("ball_v_r", 0.05 * slip), add("ball_omega_m", 2.0 * slip)
    add("ball_omega_x", 30.0 * slip), add("ball_omega_r", 30.0 * slip), add("ball_omega_t", 30.0 * slip)
    add("joint_plate_y", 3e-9), add("joint_plate_z", 3e-9), add("joint_head_y", 3e-8), add("joint_head_z", 3e-8)
    shift = rng.uniform(-0.5, 0.5, 2) * d.C_land
    for h in range(2):  # the halves move together but for some micrometres
        y[SLICE["cage_y"]][h] += shift[0]
        y[SLICE["cage_z"]][h] += shift[1]
    phi = 2.0 * np.pi * np.arange(Z) / Z
    play = 0.5 * p.cage.pocket_clearance + rng.uniform(-2e-6, 3e-6, Z) if pockets else np.zeros(Z)
    y[SLICE["ball_theta"]] = (
        phi + (rng.choice([-1.0, 1.0], Z) * play + shift[1] * np.cos(phi) - shift[0] * np.sin(phi)) / r_0
    )
    if p.scene.cage == variables.CageModel.ELASTIC:
        order, _, _ = mode_order(default_table().modes)
        n = len(order)
        for block in (variables.MODE_S, variables.MODE_D):  # lower modes farther, all with the same acceleration
            y[block][:n] += 1e-6 * rng.uniform(-1.0, 1.0, n) / (1.0 + order)
        for block in (variables.MODE_S_DOT, variables.MODE_D_DOT):
            y[block][:n] += 1e-2 * slip * rng.uniform(-1.0, 1.0, n) / (1.0 + order)
    if not stuck:
        add("cage_x", 3e-7), add("cage_y", 3e-6), add("cage_z", 3e-6), add("cage_psi", 5e-5)
        tilt = rng.uniform(-2e-4, 2e-4, 2)
        for h in range(2):
            y[SLICE["cage_beta"]][h] += tilt[0]
            y[SLICE["cage_gamma"]][h] += tilt[1]
        (
            add("cage_beta", 5e-6),
            add("cage_gamma", 5e-6),
            add("cage_v_x", 1e-3 * slip),
            add("cage_v_y", 0.1 * slip),
            add("cage_v_z", 0.1 * slip),
        )
        add("cage_beta_dot", 1.0 * slip), add("cage_gamma_dot", 1.0 * slip), add("cage_s", 1.0 * slip)
    else:
        rigid_halves(
            model,
            y,
            beta=rng.uniform(-2e-4, 2e-4),
            gamma=rng.uniform(-2e-4, 2e-4),
            psi=rng.uniform(-5e-5, 5e-5),
            slip=slip,
            rng=rng,
        )
    add("ring_v_x", 0.01 * slip), add("ring_v_y", 0.01 * slip), add("ring_v_z", 0.01 * slip)
    add("ring_beta", 1e-4), add("ring_gamma", 1e-4), add("ring_beta_dot", 1.0 * slip), add("ring_gamma_dot", 1.0 * slip)
    return y


def rigid_halves(model, y, beta, gamma, psi, slip, rng):
    """Both halves as one rigid body about the cage's centre (cage without unbalance)."""
    a, a_dot = axis(beta, gamma), np.zeros(3)
    beta_dot, gamma_dot, s = (
        slip * rng.uniform(-1, 1),
        slip * rng.uniform(-1, 1),
        y[SLICE["cage_s"]][0] + slip * rng.uniform(-1, 1),
    )
    a_dot[1], a_dot[2] = gamma_dot, -beta_dot
    a_dot[0] = -(a[1] * a_dot[1] + a[2] * a_dot[2]) / a[0]
    centre = np.array([0.0, y[SLICE["cage_y"]][0], y[SLICE["cage_z"]][0]])
    velocity = slip * rng.uniform(-0.1, 0.1, 3)
    for h in range(2):
        place, rate = centre + model.d.com_x[h] * a, velocity + model.d.com_x[h] * a_dot
        for i, name in enumerate("xyz"):
            y[SLICE[f"cage_{name}"]][h], y[SLICE[f"cage_v_{name}"]][h] = place[i], rate[i]
        for name, value in (
            ("beta", beta),
            ("gamma", gamma),
            ("psi", psi),
            ("beta_dot", beta_dot),
            ("gamma_dot", gamma_dot),
            ("s", s),
        ):
            y[SLICE[f"cage_{name}"]][h] = value


class Instance:
    """A whole bearing behind part.h: parameters and inputs by name, stepping, states and outputs.  Freed with this
    object.
    """

    def __init__(self, core, parameters=None, inputs=None, tolerance=0.0):
        self.core, self.lib, self.messages = core, core.lib, []
        ffi = core.ffi
        self.log = ffi.callback(
            "void(void *, LogCategory, const char *)",
            lambda _, category, text: self.messages.append(ffi.string(text).decode()),
        )
        self.host = ffi.new("PartHost *", {"environment": ffi.NULL, "log": self.log})
        self.bearing = ffi.gc(self.lib.part_create(self.host), self.lib.part_destroy)
        if ribbon.SHAPE in (parameters or {}):
            ribbon.unlock(core)
        core.set_values(self.lib.part_parameters(self.bearing), variables.PARAMETERS, TWO_HALF | (parameters or {}))
        self.set(**(inputs or {}))
        status = self.lib.part_initialize(self.bearing, 0.0, tolerance)
        if status != self.lib.PART_OK:
            raise ValueError(f"initialisation: status {status}, {self.messages}")

    def set(self, **inputs):
        """Inputs by their names in the variable table."""
        self.core.set_values(self.lib.part_inputs(self.bearing, 0), variables.INPUTS, inputs)

    @property
    def time(self):
        return self.lib.part_time(self.bearing)

    def step(self, t):
        """To time t; ArithmeticError if the solver cannot go on."""
        if self.lib.part_step(self.bearing, t) != self.lib.PART_OK:
            raise ArithmeticError(f"t = {t}: {self.messages}")
        return self

    def put(self, y):
        """The state y in the place of the one that a step reached, without its films in pockets."""
        saved = self.core.new("InstanceState")
        self.lib.part_save(self.bearing, saved)
        now = saved.integrator.now
        now.y[0 : len(y)] = list(y)
        for row in now.cage.halves.pockets.D:
            row[0 : len(row)] = [0.0] * len(row)
        self.lib.part_restore(self.bearing, saved)
        return self

    @property
    def y(self):
        """A copy of the state."""
        elastic = self.lib.part_parameters(self.bearing).scene.cage == variables.CageModel.ELASTIC
        count = variables.N_ALL_STATES if elastic else variables.N_STATES
        return np.frombuffer(self.core.ffi.buffer(self.lib.part_state(self.bearing), 8 * count)).copy()

    def output(self, name):
        """One output now; an array for ball[j] and rivet[k]."""
        group, member = name.split(".")
        self.lib.part_update(self.bearing, getattr(self.lib, f"GROUP_{OUTPUTS[name].group.upper()}"))
        return getattr(View(self.core, getattr(self.lib.part_outputs(self.bearing), group)), member)


def c_opens(core, bonded, P, spin_M, spin_P, isa=None, intact=True):
    """(N, M_r, M_t), (T, m_r, m_t) [Z, 3] by the C core."""
    ffi, lib = core.ffi, core.lib
    rows, out = (core.new("ball_array", 8) for _ in range(2))  # aligned
    for i in range(3):
        rows[i][0:Z] = bonded[:, i].tolist()
    rows[3][0:Z] = P.tolist()
    rows[4][0:Z] = np.broadcast_to(intact, Z).astype(float).tolist()
    core.model(isa=isa).kernel("joints_open")(
        ffi.addressof(lib.rivet_table.half, "law"), rows, rows[3], rows[4], spin_M, spin_P, out, out + 3
    )
    found = np.array([list(out[i])[:Z] for i in range(6)])
    return found[:3].T, found[3:].T
