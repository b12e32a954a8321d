"""Film between the outer ring and the rim of a half that bends: the law of land_film.py with the gap of the bent rim.

    w(theta) = u_2 cos 2 theta + u_3 sin 2 theta + u_4 cos 3 theta + u_5 sin 3 theta      radial, outward, by the modes
    h = C - e.n - w,      W = V.n + w_dot - (omega/2) dw/dtheta                            closing, theta in the half's frame
    P = -kappa C^3 max(W, 0)/h^3 dtheta                                                    radial load, outward

With b = (n_y, n_z, cos 2 theta, sin 2 theta, cos 3 theta, sin 3 theta) the film has the forces F_i = int P b_i and the rates
-dF_i/dV_k = kappa C^3 int b_i b_k/h^3 over the closing part: the matrix is symmetric and not negative, and F is the gradient
of an integral of W^2/h^3.  Couette's torque is that of the gap, int C dtheta/(2 pi h).

Where the gap closes, h stays finite like q^2 of a round land: h = C g_0/2 at the wall and C g_0/4 far behind it.  The dry
contact is a linear bedding: pressure k s, s = -h, with k = (3/4) K_land sqrt(C/2), which for a round land,
s = e - C - e theta^2/2, is F = K_land (e - C)^1.5.  Each point has Hunt and Crossley's damping by its own s_dot.

The sums are over points that Sommerfeld's substitution of a round land of the same e spreads, with eps <= 0.9: 48 of them
leave 0.05 % of the force in the median and 1 % in the worst twentieth of gaps down to -3 um.

The second and the third wave of the load bend the rim.  All other waves load the rivets statically (elastic_lands.py): none of a film
whose force is less than 2 % of the sum of the preloads, all from 4 % on, between them a smooth part.  Smoothness: that of land_film.py.

Arrays are [..., half], of land and rim [6, ..., half], of points [..., half, point].
"""

from types import SimpleNamespace

import numpy as np

from bearing_model.generated.variables import Lubrication
from bearing_model.numbers.lanes import maximum, minimum
from bearing_model.physics.hertz import hertz_damped
from bearing_model.physics.traction import traction_asperity_share

BENT_EPS = 0.9  # largest eps of the points
FAINT_LOAD = 0.02  # load on a rim over the sum of the preloads up to which its waves do not load the rivets
BENT_POINTS = 48
PSI = 2.0 * np.pi * np.arange(BENT_POINTS) / BENT_POINTS


def smooth_part(x):
    """0 up to x = 0, 1 from x = 1 on, smooth between them."""
    x = minimum(maximum(x, 0.0), 1.0)
    return x * x * (3.0 - 2.0 * x)


def film_share(d, load):
    """Part of films of these loads [N] that are not faint: none up to FAINT_LOAD times the sum of the preloads, all from twice that on."""
    return smooth_part(load / (FAINT_LOAD * np.sum(d.P) + 1e-30) - 1.0)


def bent_dot(x, b):
    """Sum over the shapes: x [6, ...] at the points [..., point]."""
    return sum(part[..., None] * shape for part, shape in zip(x, b, strict=True))


def bent_grid(p, pressure):
    """Shapes b [6, ..., point], weights dtheta, gap over the clearance x, and its film's, at the points around the direction of e."""
    C = pressure.C[..., None]
    size = np.sqrt(pressure.e[0] ** 2 + pressure.e[1] ** 2 + 1e-30)
    u_y, u_z, eps = (x[..., None] for x in (*(pressure.e / size), minimum(size / pressure.C, BENT_EPS)))
    one, q = 1.0 + eps * np.cos(PSI), np.sqrt(1.0 - eps * eps)
    cosine, sine = (eps + np.cos(PSI)) / one, q * np.sin(PSI) / one
    y, z = cosine * u_y - sine * u_z, cosine * u_z + sine * u_y
    c_2, s_2 = y * y - z * z, 2.0 * y * z
    b = np.stack([y, z, c_2, s_2, y * c_2 - z * s_2, y * s_2 + z * c_2])
    x = (C - bent_dot(np.concatenate([pressure.e, pressure.rim]), b)) / C
    floor = 0.25 * p.cage.g_0
    above = x - floor
    return (
        b,
        2.0 * np.pi / BENT_POINTS * q / one,
        x,
        floor + 0.5 * (above + np.sqrt(above * above + 8.0 * floor * floor)),
    )


def bent_law(p, pressure, V, grid):
    """Forces of the film [6, ...] and rates [6, 6, ...] at the squeeze velocities V [6, ...]; load at the points."""
    b, weight, _, gap = grid
    stiff = weight * (pressure.kappa_C3 / pressure.C**3)[..., None] / gap**3
    W = bent_dot(V, b)
    rate = np.where(np.real(W) > 0.0, stiff, 0.0)
    load = rate * W
    rates = np.sum(rate * b[:, None] * b[None], axis=-1)
    return -np.sum(load * b, axis=-1), rates, load


def bent_sums(model, pressure):
    """Forces of film and dry contact, film's rates, int C dtheta/h, load of asperities and of all friction with n, loads,
    stored energy and its rate of the dry contact.
    """
    p, grid = model.p, bent_grid(model.p, pressure)
    b, weight, x, gap = grid
    film, rates, load = bent_law(p, pressure, np.concatenate([pressure.V, pressure.rim_V]), grid)
    rough = 0.0 * load
    if p.scene.lubrication == Lubrication.MIXED:
        thin = gap * (pressure.C / model.d.C_land)[..., None]
        rough = load * traction_asperity_share(model.d.ln_land + np.log(thin))
    pen = maximum(-x * pressure.C[..., None], 0.0)
    bed = 0.75 * p.cage.K_land * np.sqrt(0.5 * pressure.C)[..., None] * pen * weight
    rate = bent_dot(np.concatenate([pressure.v, pressure.rim_v]), b)
    N = hertz_damped(bed, p.cage.lambda_, rate)
    by_gap = 3.0 * load / (gap * pressure.C[..., None]) + np.where(pen > 0.0, bed / np.where(pen > 0.0, pen, 1.0), 0.0)
    return SimpleNamespace(
        film=film,
        stiffness=np.sum(by_gap, axis=-1),
        rates=rates,
        couette=np.sum(weight / gap, axis=-1),
        dry=-np.sum(N * b, axis=-1),
        N_0=np.sum(bed, axis=-1),
        N=np.sum(N, axis=-1),
        along=np.sum((N + rough) * b[:2], axis=-1),
        rubbing=np.sum(N + rough, axis=-1),
        rough=np.sum(rough, axis=-1),
        stored=np.sum(0.5 * bed * pen, axis=-1),
        stored_rate=np.sum(bed * rate, axis=-1),
    )


MOST_ITERATIONS = 100  # of Newton's method on a film that is linear but for its ends
WHOLE = 2  # of them that are not shortened
MISSED = 1e-2  # load that a linear law may miss / its largest force
MOST_HALVINGS = 50
LEVEL = 0.1  # slope of the merit at the end of a step / at its start
STIFF = 100.0  # change of the velocities by a film / velocities
ROUGH = 1e-3  # part of a film's load on asperities whose friction counts


def squeeze_slope(pressure, grid, by, free, V, step):
    """Function of s: slope of the merit sum (V - free)^2/(2 by) + Psi(V), F = -dPsi/dV, at V + s step, and its derivative by s."""
    b, weight, _, gap = grid
    stiff = weight * pressure.kappa_C3 / pressure.C**3 / gap**3
    W, w, held = bent_dot(V, b), bent_dot(step, b), by > 0.0  # a shape that no mode has stays
    slope = np.sum((step * (V - free))[held] / by[held])
    rise = np.sum(step[held] ** 2 / by[held])

    def slope_at(s):
        rate = np.where(W + s * w > 0.0, stiff * w, 0.0)
        return slope + s * rise + np.sum(rate * (W + s * w)), rise + np.sum(rate * w)

    return slope_at


def squeeze_part(slope_at):
    """Part of a step, 1 or less, at whose end the merit falls no more: Newton's method on its slope, between bounds that it narrows."""
    level, low, high, s = LEVEL * abs(slope_at(0.0)[0]), 0.0, 1.0, 1.0
    for _ in range(MOST_HALVINGS):
        slope, rise = slope_at(s)
        if abs(slope) <= level or (s == 1.0 and slope < 0.0):
            break
        low, high = (s, high) if slope < 0.0 else (low, s)
        s = s - slope / rise
        if not low < s < high:
            s = 0.5 * (low + high)
    return s


def squeeze_step(pressure, grid, by, free, shorten, V, F, D):
    """A step of Newton's method from V by the force F and the rates D there, `shorten`: as long as the merit falls.  Returns V, F behind it
    by that law, and whether the law holds there or the step has left the model's range.
    """
    step = np.linalg.solve(np.eye(6) + by[:, None] * D, free + by * F - V)
    fine = np.all(np.isfinite(step))
    part = squeeze_part(squeeze_slope(pressure, grid, by, free, V, step)) if shorten and fine else 1.0
    after, F = V + part * step, F - D @ (part * step)
    W, stiff = bent_dot(after, grid[0]), grid[1] * pressure.kappa_C3 / pressure.C**3 / grid[3] ** 3
    missed = np.sum(np.where((W > 0.0) != (bent_dot(V, grid[0]) > 0.0), stiff * np.abs(W), 0.0))
    return after, F, not fine or (part == 1.0 and missed <= MISSED * np.max(np.abs(F)))


def squeeze_find(p, pressure, by, free, V, grid):
    """V = free + by F(V) from a guess V [6]; returns V, the force F and its rates D."""
    for iteration in range(MOST_ITERATIONS):
        F, D, _ = bent_law(p, pressure, V, grid)
        V, F, done = squeeze_step(pressure, grid, by, free, iteration >= WHOLE, V, F, D)
        if done:
            break
    return V, F, D


def bent_foresee(p, pressure, by, before, film, rough):
    """Whether the film [6] of a half at the predicted velocities has to be foreseen: it would change them a hundred times over in the step,
    by: change per force [6], or asperities bear a part of it, rough [N]; then pressure.V and pressure.rim_V become the velocities at the step's end by
    the film, which had the forces `before` at its start.
    """
    start = np.concatenate([pressure.V, pressure.rim_V])
    if np.max(np.abs(by * film)) <= STIFF * np.max(np.abs(start)) and rough <= ROUGH * np.max(np.abs(film)):
        return False
    V, _, _ = squeeze_find(p, pressure, by, start - by * before, start, bent_grid(p, pressure))
    pressure.V, pressure.rim_V = V[:2], V[2:]
    return True


def bent_solve(p, pressure, gamma, by, residual, V):
    """The implicit step of one land and its bent rim: velocities change by the residual [6], which has the film's force at
    the evaluation, and by `by` times the excess of the law's force at the end over that force.  pressure: of this half; by: change of the
    velocities per force [6]; V: squeeze velocities to begin with [6].

    Returns squeeze velocities, their change, impulse of the film and its force [6], its rates [6, 6].
    """
    start, grid = np.concatenate([pressure.V, pressure.rim_V]), bent_grid(p, pressure)
    free, known = start + residual - by * pressure.film, bent_law(p, pressure, pressure.at, grid)[1]
    first, film, done = squeeze_step(pressure, grid, by, free, False, pressure.at, pressure.film, known)
    V, film, D = (first, film, known) if done else squeeze_find(p, pressure, by, free, V, grid)
    return SimpleNamespace(V=V, change=V - start, impulse=gamma * (pressure.film - film), film=film, rates=D)
