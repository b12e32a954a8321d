"""The bearing over time: scipy's integrators on rhs, with the start, error scales, outputs and statistics of the FMU.

    results = simulate({"cage.pocket_clearance": 0.1e-3}, {"shaft.tilt_z": 2e-3}, t_end=0.01)
    results["ball[1].Q_c"], results["cage.omega"]

Communication points and edges of pulses are hit exactly, because an integration ends at each of them.  The error of a
step is the RMS over the states of error/(tolerance scale); derived.py sets the scales, and no tolerance is relative.
"""

import functools
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.integrate import BDF, DOP853, RK23, RK45, Radau

from bearing_model.cage.cage import cage_loads, cage_slide, cage_slip
from bearing_model.generated.variables import OUTPUTS, WORK, HousingMotion, RingMotion, Stress, Switch, Z
from bearing_model.instance.breakage import Breakage
from bearing_model.instance.energy import energy_terms, energy_total
from bearing_model.instance.fatigue import FatigueChannel, fatigue_law, fatigue_law_in_hole
from bearing_model.instance.ledger import Ledger
from bearing_model.instance.loosening import Loosening
from bearing_model.instance.outputs import outputs, pocket_loads
from bearing_model.instance.statistics import StatisticsChannel
from bearing_model.physics.hertz import hertz_energy
from bearing_model.physics.model import Model, Work
from bearing_model.physics.parameters import InputDerivatives, Inputs, Parameters, check_run
from bearing_model.physics.rhs import jacobian, rhs
from bearing_model.physics.ring_fit import ring_fit_growth, ring_fit_speed
from bearing_model.physics.ring_load import (
    input_trajectory_here,
    input_trajectory_update,
    input_trajectory_varies,
    motion_remember,
    motion_trajectory,
    pulse_next_edge,
    ring_load_at,
)
from bearing_model.physics.temperature import temperature_same
from bearing_model.rivet.rivet_rom import HEAD_P1, MID_VM, rivet_rom_stress
from bearing_model.solver.escape import escape_find
from bearing_model.solver.start import ring_follow, start_state

METHODS = {"DOP853": DOP853, "RK45": RK45, "RK23": RK23, "Radau": Radau, "BDF": BDF}
IMPLICIT = ("Radau", "BDF")
FORCE_FLOOR, STRESS_FLOOR = 1e-3, 1e3  # the statistics do not resolve smaller values [N], [Pa]
FIRST_STEP = 1e-6  # [s]


@dataclass
class Results:
    """Results of a simulation.

    t: communication points [s]; y: states there [points, N_STATES]; outputs: name of the variable table -> [points] or
    [points, Z]; statistics: stat.* and the damage of the rivets at the end; ledger: where the energy went, each term
    [points]; steps, rhs_evals: work done. results[name] takes any output's name, "ball[3].Q_i" or "ball[j].Q_i".
    """

    t: np.ndarray
    y: np.ndarray
    outputs: dict
    statistics: dict
    ledger: Ledger
    steps: int
    rhs_evals: int

    def __getitem__(self, name):
        values = self.outputs | self.statistics
        if name in values:
            return values[name]
        for letter in "jkn":
            head, bracket, tail = name.partition("[")
            number, _, rest = tail.partition("]")
            array = f"{head}[{letter}]{rest}"
            if bracket and number.isdigit() and array in values and 1 <= int(number) <= Z:
                return values[array][..., int(number) - 1]
        raise KeyError(name)


def starts(last, ends):
    """Values at the starts of steps by those at their ends, rows, and the last one before them, if there was one."""
    return np.concatenate([[ends[0] if last is None else last], ends[:-1]])


@dataclass
class Record:
    """Peaks, statistics and fatigue over accepted steps, as the FMU keeps them."""

    p: Parameters
    force: StatisticsChannel = field(default_factory=lambda: StatisticsChannel(FORCE_FLOOR))
    # one for each rivet, the last one for the worst rivet
    head: list = field(default_factory=lambda: [StatisticsChannel(STRESS_FLOOR) for _ in range(Z + 1)])
    mid: list = field(default_factory=lambda: [StatisticsChannel(STRESS_FLOOR) for _ in range(Z + 1)])
    fatigue_head: list = field(default_factory=lambda: [FatigueChannel() for _ in range(Z)])
    fatigue_mid: list = field(default_factory=lambda: [FatigueChannel() for _ in range(Z)])
    # at the end of the last step, for the statistics: pocket forces, stresses of each rivet and of the worst one
    end_force: np.ndarray | None = None
    end_stress: dict = field(default_factory=dict)
    duty_time: float = 0.0
    omega_time: float = 0.0
    eccentricity_time: float = 0.0
    dislocation_max: float = 0.0
    breakage: Breakage = field(default_factory=Breakage)
    loosening: Loosening = field(default_factory=Loosening)
    fit_eff: np.ndarray = field(default_factory=lambda: np.zeros(Z))  # of each rivet [m], by the model

    def laws(self, place):
        """FatigueLaw of each rivet at "head" or "mid"."""
        laws = [fatigue_law(self.p, k) for k in range(Z)]
        if place == "head":
            return laws
        return [fatigue_law_in_hole(law, fit) for law, fit in zip(laws, self.fit_eff, strict=True)]

    def add(self, model, t, h, w, rubbed):
        """Record accepted steps of lengths h [s] that end at the times t, from the evaluation w at their ends; returns
        the peaks by output name.
        """
        p, counts = self.p, (t >= self.p.start.settle) & (self.p.scene.statistics == Switch.ON)
        weight = np.repeat(h[:, None], Z, axis=1)
        Q_c = pocket_loads(w)
        before, self.end_force = starts(self.end_force, Q_c), Q_c[-1]
        self.force.add(weight[counts].ravel(), before[counts].ravel(), Q_c[counts].ravel())
        self.duty_time += np.sum((0.5 * weight * ((before > 0.0) * 1.0 + (Q_c > 0.0)))[counts])
        peaks = {"cage.F_pocket_peak": np.max(Q_c)}
        peaks |= self.add_stress(model, t, h, counts, w) if p.scene.stress >= Stress.PEAK else no_stress()
        if p.joint.wear > 0.0:
            self.loosening.add(p, model.d.table, rubbed)
        h0, h1 = w.half
        centre = (0.5 * (h0.x + h1.x) - w.outer_x)[..., 0]
        self.omega_time += np.sum((h * 0.5 * (h0.s + h1.s)[..., 0])[counts])
        self.eccentricity_time += np.sum((h * np.hypot(centre[1], centre[2]) / model.d.play)[counts])
        self.dislocation_max = max(self.dislocation_max, np.max(cage_slip(model, w)[counts], initial=0.0))
        return peaks

    def add_stress(self, model, t, h, counts, w):
        self.fit_eff = model.d.fit_eff[:Z]
        sigma, _ = rivet_rom_stress(model.d.table, cage_loads(model, w).rivet, model.d.fit_eff)
        peaks = {}
        channels = (("head", HEAD_P1, self.head, self.fatigue_head), ("mid", MID_VM, self.mid, self.fatigue_mid))
        standing = np.flatnonzero(self.breakage.holds(self.p))
        for name, channel, statistics, fatigue in channels:
            stress = sigma[..., channel]
            now = np.column_stack([stress, np.max(stress, axis=1)])
            before, self.end_stress[name] = starts(self.end_stress.get(name), now), now[-1]
            for k in range(Z + 1):
                statistics[k].add(h[counts], before[counts, k], now[counts, k])
            if self.p.scene.stress == Stress.FATIGUE:
                laws = self.laws(name)
                for values in stress[t >= self.p.start.settle]:
                    for k in standing:
                        fatigue[k].push(laws[k], values[k])
            peak = np.max(stress, axis=0)
            peaks |= {f"rivet[k].sigma_{name}_peak": peak, f"rivet.sigma_{name}_max": np.max(peak)}
        return peaks

    def statistics(self):
        """stat.* and damage by the names of the variable table."""
        time, p = self.force.time / Z, 0.999  # each ball has added the time of each step
        share = 1.0 / time if time > 0.0 else 0.0
        values = {
            "stat.time": time,
            "stat.contact_duty": self.duty_time * share / Z,
            "stat.cage_omega": self.omega_time * share,
        }
        values |= {"stat.eccentricity": self.eccentricity_time * share, "stat.dislocation_max": self.dislocation_max}

        def four(channel):
            return {"mean": channel.mean, "rms": channel.rms, "p999": channel.quantile(p), "max": channel.max}

        values |= {f"stat.Q_c_{name}": value for name, value in four(self.force).items()}
        for part, channels, fatigue in (("head", self.head, self.fatigue_head), ("mid", self.mid, self.fatigue_mid)):
            values |= {f"stat.sigma_{part}_{name}": value for name, value in four(channels[Z]).items()}
            values |= {
                f"stat.rivet_{part}_{name}[k]": np.array([four(c)[name] for c in channels[:Z]])
                for name in ("mean", "rms", "p999", "max")
            }
            values[f"rivet[k].damage_{part}"] = self.damage(fatigue, part)
        return values

    def damage(self, fatigue, place):
        """Damage of the heads or the middles [Z]."""
        return np.array([channel.damage(law) for channel, law in zip(fatigue, self.laws(place), strict=True)])

    @property
    def standing(self):
        """The parameters in force, with the preloads that wear has left and without broken rivets."""
        return self.breakage.apply(self.loosening.apply(self.p))

    def rivet_outputs(self):
        return self.breakage.outputs(self.p) | {"rivet[k].preload_loss": self.loosening.loss}

    def break_rivets(self, t):
        """Break the rivets whose damage has reached 1 at time t [s]; returns whether there are any."""
        if self.p.scene.breakage != Switch.ON:
            return False
        return self.breakage.update(
            self.p, t, self.damage(self.fatigue_head, "head"), self.damage(self.fatigue_mid, "mid")
        )


def no_stress():
    """Zeros in the place of the peak stresses, for scenes that record no stress."""
    names = [name for name, variable in OUTPUTS.items() if variable.group == "peak" and "sigma" in name]
    return {name: np.zeros(Z) if "[k]" in name else 0.0 for name in names}


class Integration:
    """One run in progress: state, step size and records."""

    def __init__(self, p, t, y, tolerance, method):
        self.p, self.t, self.y, self.tolerance, self.method = p, t, y, tolerance, method
        self.step_size, self.steps, self.rhs_evals = FIRST_STEP, 0, 0

    def segment(self, model, t_end):
        """Accepted steps from here to t_end under one ring load: their times and states, without the start; energy that
        friction has dissipated in all of them [J]; normal force times slip of the joints in each [steps, Z] [J].
        """
        rtol = 100.0 * np.finfo(float).eps  # the smallest that SciPy accepts: in effect only atol counts
        options = {"rtol": rtol, "atol": self.tolerance * model.d.scale}
        if self.method in IMPLICIT:
            options["jac"] = lambda t, y: jacobian(model, t, y)
        first = min(self.step_size, t_end - self.t)
        solver = METHODS[self.method](functools.partial(rhs, model), self.t, self.y, t_end, first_step=first, **options)
        times, states, lost, rubbed = [], [], 0.0, []
        while solver.status == "running":
            message = solver.step()
            if solver.status == "failed":
                raise RuntimeError(f"t = {solver.t:.9g} s: the solver cannot go on: {message}")
            slip, reason = self.slide(model, solver)
            if reason:
                raise RuntimeError(f"t = {solver.t:.9g} s: {reason}: the run ends")
            lost += slip[0]
            rubbed.append(slip[1])
            times.append(solver.t)
            states.append(solver.y.copy())
            self.steps += 1
            if 0 < self.p.solver.max_steps < self.steps:
                raise RuntimeError(
                    f"t = {solver.t:.9g} s: more than solver.max_steps = {self.p.solver.max_steps} steps"
                )
        self.step_size = max(getattr(solver, "h_abs", solver.step_size), 0.9 * self.step_size)
        self.rhs_evals += solver.nfev
        self.t = t_end
        return np.array(times), np.array(states), lost, np.array(rubbed)

    def slide(self, model, solver):
        """Maps the joints' friction states at the end of the solver's step back; returns the results of cage_slide, and the reason
        if the step has led out of the bearing.  The rates there depend only on the part of the states that friction bears, so that
        those of the solver stay.
        """
        w, y = Work(), solver.y.copy()
        rhs(model, solver.t, y, w)
        slip = cage_slide(model, self.y, y, w)
        if isinstance(solver, BDF):
            solver.D[0] += y - solver.y
        self.y = solver.y = y
        return slip, escape_find(model, w)


def simulate(
    parameters=None,
    inputs=None,
    t_end=1e-3,
    *,
    derivatives=None,
    changes=None,
    step=1e-4,
    t_start=0.0,
    tolerance=None,
    method="DOP853",
    y=None,
    table=None,
):
    """Integrate from the quasi-static start (or the state y) at t_start to t_end [s]; returns Results at communication
    points `step` [s] apart.

    parameters: {name: value} of the variable table in SI, others at their start values.  inputs: the same, or a
    function t -> {name: value} called at each communication point and held until the next one, as an FMU's inputs are.
    derivatives: a function t -> (first, second) derivatives of inputs {name: value}, called at the same points: the
    inputs are then polynomials of time until the next point.  changes: a function t -> parameters {name: value} that
    are set at the communication point t and in force from there.  tolerance: of a step, relative to the error scales;
    default solver.tol.  method: DOP853, RK45, RK23, or with the exact Jacobian Radau, BDF.  table: RivetTable,
    default that of the 6207. ValueError names a value that is not allowed; RuntimeError if the solver cannot go on, a body
    leaves the bearing, or all rivets are broken.

    >>> results = simulate({"scene.cage": "two_half"}, {"shaft.F_y": 1000.0}, t_end=1e-4)
    >>> results["ball[1].Q_i"].shape
    (2,)
    """
    if method not in METHODS:
        raise ValueError(f"method = {method!r}: allowed are {', '.join(METHODS)}")
    if not (t_end > t_start and step > 0.0):
        raise ValueError(
            f"t_end = {t_end} s, step = {step} s: t_end must be after t_start = {t_start} s and step positive"
        )
    if tolerance is not None and not tolerance > 0.0:
        raise ValueError(f"tolerance = {tolerance}: more than 0 is allowed")
    if Parameters(parameters).housing.motion == HousingMotion.SUPPORTED:
        raise ValueError("housing.motion = supported: the FMU alone integrates a housing on springs; given is allowed")
    spalled = np.flatnonzero(Parameters(parameters).ball.spall_length > 0.0)
    if len(spalled):
        raise ValueError(
            f"ball[{spalled[0] + 1}].spall_length: the FMU alone follows the turn of a ball; 0 m is allowed"
        )
    check_run(Parameters(parameters))
    p, held = Parameters(parameters), inputs if callable(inputs) else lambda t: inputs
    slopes = derivatives or (lambda t: ({}, {}))
    here = input_trajectory_update(
        p, (Inputs(held(t_start)), *map(InputDerivatives, slopes(t_start))), t_start, t_start
    )
    model = Model.under(p, here.u[0], ring_load_at(here, t_start), table=table)
    y = start_state(model)[0] if y is None else np.array(y, dtype=float)
    run = Integration(p, t_start, y, p.solver.tol if tolerance is None else tolerance, method)
    record, w = Record(p), Work()
    rhs(model, t_start, y, w)
    energy_start, energy_change = energy_total(model, y, w) - y[WORK][0], 0.0

    count = int(np.ceil((t_end - t_start) / step * (1.0 - 1e-12)))
    points = np.minimum(t_start + step * np.arange(count + 1), t_end)
    ledger, history = Ledger(), None
    ledger.add(model, np.array([t_start]), y[None])
    first = (
        observe(model, t_start, y, energy_start)
        | record.rivet_outputs()
        | {"event.energy_off": 0.0}
        | accepted(model, record, np.array([t_start]), np.zeros(1), y[None], np.zeros((1, Z)))
    )
    states, ledgers, rows = [y], [ledger.copy()], [first]
    for point in points[1:]:
        u, peaks, t_0 = [Inputs(held(run.t)), *map(InputDerivatives, slopes(run.t))], [], run.t
        angles = here.frame_angle, here.angles
        given, reached = u, here.u[0]
        u, history = (
            motion_trajectory(p, given, reached, point - t_0, history),
            motion_remember(given[0], point - t_0, history),
        )
        model, expansion = at_temperature(record.standing, model, reached, given[0], run, table)
        set_now = changes(t_0) if changes else None
        if set_now:
            p = record.p = run.p = p.changed(set_now)
            if "solver.tol" in set_now:
                run.tolerance = p.solver.tol
            model, jump = rederive(record, model, given[0], run, table, ledger)
            energy_change += jump
        expansion += at_speed(model, given[0], run)
        while run.t < point:
            trajectory, begin, y_begin = input_trajectory_update(p, u, t_0, run.t, *angles), run.t, run.y
            varies = trajectory if input_trajectory_varies(trajectory) else None
            model = replace(model, ring_load=ring_load_at(trajectory, run.t), trajectory=varies)
            times, ys, slid, rubbed = run.segment(model, min(pulse_next_edge(p, run.t), point))
            peaks.append(accepted(model, record, times, np.diff(times, prepend=begin), ys, rubbed))
            ledger.add(model, np.append(begin, times), np.vstack([y_begin, ys]))
            ledger.add_friction(slid)
        here = input_trajectory_here(trajectory, run.t)
        model = replace(model, ring_load=ring_load_at(here, run.t), trajectory=None)
        if p.ring.motion == RingMotion.PRESCRIBED:
            run.y = ring_follow(model.ring_load, run.y)
        model, further = at_temperature(record.standing, model, given[0], here.u[0], run, table)
        energy_start += expansion + further
        if record.loosening.update(model.p.joint.preload, model.d.P):
            model, jump = rederive(record, model, here.u[0], run, table, ledger)
            energy_change += jump
        if record.break_rivets(run.t):
            model, jump = rederive(record, model, here.u[0], run, table, ledger)
            energy_change += jump
        states.append(run.y)
        ledgers.append(ledger.copy())
        rows.append(
            observe(model, run.t, run.y, energy_start, energy_change)
            | record.rivet_outputs()
            | {name: np.max([peak[name] for peak in peaks], axis=0) for name in peaks[0]}
            | ledger.means(ledgers[-2], point - t_0)
        )
        rows[-1]["event.energy_off"] = ledger.event(ledgers[-2], rows[-1]["bearing.energy"])
        if p.scene.breakage == Switch.ON and not np.any(record.breakage.holds(p)):
            raise RuntimeError(f"t = {run.t:.9g} s: all {Z} rivets are broken, the halves of the cage come apart")
    table_of = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    return Results(
        points, np.array(states), table_of, record.statistics(), Ledger.over_time(ledgers), run.steps, run.rhs_evals
    )


def at_temperature(p, model, from_, u, run, table):
    """The Model at the temperatures in the Inputs u instead of those in from_, and the work of the expansion [J], which
    is no part of the energy balance.
    """
    if temperature_same(from_, u):
        return model, 0.0
    hot = Model.under(p, u, model.ring_load, table=table)
    energies = []
    for each in (model, hot):
        w = Work()
        rhs(each, run.t, run.y, w)
        energies.append(energy_total(each, run.y, w))
    return hot, energies[1] - energies[0]


def rederive(record, model, u, run, table, ledger):
    """The Model with the parameters in force and the rivets that hold, at the temperatures in the Inputs u, and the
    energy that the change adds [J].
    """
    new, terms = Model.under(record.standing, u, model.ring_load, table=table), []
    for each in (model, new):
        w = Work()
        rhs(each, run.t, run.y, w)
        terms.append(energy_terms(each, run.y, w))
    before = dict(ledger.changed)
    ledger.add_change(*terms)
    return new, sum(ledger.changed.values()) - sum(before.values())


def at_speed(model, u, run):
    """Elastic energy that a jump to the speed in the Inputs u adds [J], because the inner ring grows at once."""
    loads, fit = (model.ring_load, replace(model.ring_load, omega=u.shaft.omega)), model.d.fit
    before, after = (ring_fit_growth(fit, ring_fit_speed(load)) for load in loads)
    if before == after:
        return 0.0
    energies = []
    for load in loads:
        w = Work()
        rhs(replace(model, ring_load=load, trajectory=None), run.t, run.y, w)
        energies.append(np.sum(hertz_energy(model.d.inner.hertz.K, w.delta_i)))
    return energies[1] - energies[0]


def observe(model, t, y, energy_start, energy_change=0.0):
    """Outputs at one state by name."""
    w = Work()
    y_dot = rhs(model, t, y, w)
    return outputs(model, w, y, y_dot, energy_start, energy_change)


def accepted(model, record, t, h, y, rubbed):
    """Record accepted steps that end at times t in states y [steps, N_STATES] with the joints' rubbing [steps, Z] [J]; returns
    the peaks of these steps.
    """
    w = Work()
    rhs(model, t, y, w)
    return record.add(model, t, h, w, rubbed)
