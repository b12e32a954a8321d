"""The film of oil that a ball presses out of the gap to its pocket's wall.  Both are rigid here; a gap of the order of their
elastic deflection has a floor.

       wall, R_c                       h = C - S cos phi          gap around the pocket's axis, C = R_c - R
    --.           .--                  h(phi, y) = h + y^2/(2R)   and along it, -a < y < b in the cage's section
       `-. ___ .-'                     d/dy (h^3 dp/dy) = -12 eta v cos phi     the oil leaves along the axis: the gap is
  phi -> ( ball )    y: along the axis         R_x/R_y = R_c/C times as wide around it; p = 0 at both ends
         `-----'                       D_strip = 12 eta (I_2 - I_1^2/I_0),  I_n = integral of y^n/h^3 dy
                                       D = 1/(1 + C/R_c) times the integral of D_strip cos^2 phi R_c dphi, cos phi > 0

1/(1 + C/R_c) is the exact factor R_x/(R_x + R_y) of the flow around the axis as h -> 0, where
    D = c/h,  c = 12 pi eta (R_x R_y)^1.5/(R_x + R_y),  R_x = R R_c/C,  R_y = R        paraboloid
Away from there D = G c/h, G a polynomial of z = sqrt(h/reach) through SQUEEZE_NODES values of that integral.  D is within
2 % of Reynolds' equation in two dimensions on the whole gap 0.005 C < h < C (tests/test_pocket_squeeze.py).

Filling, floor, the parts of the halves and all sources: pocket_squeeze.h.
"""

from types import SimpleNamespace

import numpy as np

from bearing_model.numbers.lanes import maximum, minimum
from bearing_model.numbers.vec import vec_dot

SQUEEZE_NODES = 9
INTERVALS = 96  # of Simpson's rule over phi, graded toward the narrowest gap


def strip_integrals(R, h, y):
    """I_0, I_1, I_2 from 0 to y at the gap h."""
    d = 2.0 * R
    q, s = h + y * y / d, np.sqrt(d * h)
    angle = s * np.arctan(y / s)
    return np.array(
        [
            y / (4.0 * h * q * q) + 3.0 * y / (8.0 * h * h * q) + 3.0 * angle / (8.0 * h * h * h),
            0.25 * d * (1.0 / (h * h) - 1.0 / (q * q)),
            d * (y / (8.0 * h * q) - y / (4.0 * q * q) + angle / (8.0 * h * h)),
        ]
    )


def strip(g, h):
    """D_strip / (12 eta) at the gaps h."""
    wet = np.sqrt(6.0 * g.R * np.maximum(g.layer - h, 0.0))
    I = strip_integrals(g.R, h, np.minimum(g.outer, wet)) - strip_integrals(g.R, h, -np.minimum(g.inner, wet))
    return np.where(h < g.layer, I[2] - I[1] * I[1] / np.where(I[0] > 0.0, I[0], 1.0), 0.0)


def whole(g, h):
    """D / (12 eta) of the whole film with the narrowest gap h."""
    grade = np.sqrt(0.5 * h / g.C)
    last = np.arcsinh(0.5 * np.pi / grade)
    T = last * np.arange(INTERVALS + 1) / INTERVALS
    phi, weight = grade * np.sinh(T), np.where(np.arange(INTERVALS + 1) % 2, 4.0, 2.0)
    weight[[0, -1]] = 1.0
    part = weight * strip(g, g.C - (g.C - h) * np.cos(phi)) * np.cos(phi) ** 2 * grade * np.cosh(T)
    return 2.0 * g.R_c / (1.0 + g.C / g.R_c) * np.sum(part) * last / (3.0 * INTERVALS)


def paraboloid(g):
    """c / (12 eta)."""
    R_x = g.R * g.R_c / g.C
    return np.pi * (R_x * g.R) ** 1.5 / (R_x + g.R)


def squeeze_nodes():
    """Nodes of the polynomials of z, Chebyshev's points from 0 to 1."""
    return 0.5 - 0.5 * np.cos(np.pi * np.arange(SQUEEZE_NODES) / (SQUEEZE_NODES - 1))


def squeeze_newton(node, value):
    """Values at the nodes -> coefficients in Newton's form."""
    value = np.array(value)
    for order in range(1, SQUEEZE_NODES):
        value[order:] = np.diff(value[order - 1 :]) / (node[order:] - node[:-order])
    return value


def squeeze_polynomial(node, newton, z):
    value = newton[-1]
    for place, coefficient in zip(node[-2::-1], newton[-2::-1], strict=True):
        value = value * (z - place) + coefficient
    return value


def fit_shape(g, reach):
    """Nodes and coefficients of the polynomial through the values of G at the nodes; 1 at z = 0."""
    z = squeeze_nodes()
    return z, squeeze_newton(z, [1.0, *(whole(g, x * x * reach) * x * x * reach / paraboloid(g) for x in z[1:])])


def pocket_squeeze_derive(p, d):
    """Constants of the films: d.squeeze, where those of the pockets are known; None in dry pockets."""
    filling, R, R_c = p.cage.pocket_filling, 0.5 * p.bearing.D, d.pocket_radius
    d.squeeze = None
    if filling <= 0.0:
        return
    # the closest conformity as in the contact; a section around the pitch circle
    C, least = max(R_c - R, 1e-3 * R), 0.05 * R
    inner, outer = (max(0.5 * side, least) for side in (p.bearing.d_m - p.cage.D_i, p.cage.D_o - p.bearing.d_m))
    layer = filling * (C + max(inner, outer) ** 2 / (6.0 * R))
    gap = SimpleNamespace(R=R, R_c=R_c, C=C, inner=inner, outer=outer, layer=layer)
    reach = min(layer, C)
    node, newton = fit_shape(gap, reach)
    own = SimpleNamespace(R=R, R_c=d.R_c, C=np.maximum(d.R_c - d.R, 1e-3 * R))
    d.squeeze = SimpleNamespace(
        node=node,
        newton=newton,
        reach=reach,
        roughness_2=p.oil.sigma_pocket**2,
        elastic=2.25 * (12.0 * p.oil.eta * paraboloid(gap) / d.pocket.K) ** 0.8,
        c=12.0 * p.oil.eta * paraboloid(own),
        C=own.C,
        inv_reach=C / (reach * own.C),
    )


def squeeze_shape(film, h):
    """Damping of a whole film / (c/h_eff), by the gap."""
    z = np.sqrt(minimum(h * film.inv_reach, 1.0) + 1e-30)
    return maximum(squeeze_polynomial(film.node, film.newton, z), 0.0)


def pocket_squeeze(d, half, gap, v):
    """The film of one half: D, F = D v.m, 0 where the ball withdraws [N.s/m, N], and m; v: velocity of the ball's centre
    against the wall.
    """
    film, n_x, n_t = d.squeeze, gap.n_x, gap.n_t
    v_x, v_t = vec_dot(v, gap.a), vec_dot(v, gap.e_t)
    # gap with its floor; below 1 nm/s the film is linear in the speed
    closing = maximum(n_x * v_x + n_t * v_t, 1e-9)
    h_e2 = film.elastic * np.exp(0.8 * np.log(closing))
    h = np.sqrt(gap.delta**2 + (h_e2 + film.roughness_2))
    # part of the half
    side = 2.0 * half - 1.0
    l_2 = 2.0 * h / (film.C + 4.0 * h)
    root = np.sqrt(l_2 + n_x * n_x)  # l sqrt(1 + u^2)
    w = 0.5 * (1.0 + side * n_x / root)
    across = 0.425 * side * l_2 / (w * root) * n_t
    m = (n_x + across * n_t) * gap.a + (n_t - across * n_x) * gap.e_t
    D = w * film.c * squeeze_shape(film, maximum(-gap.delta, 0.0)) / h
    speed = (n_x + across * n_t) * v_x + (n_t - across * n_x) * v_t
    return SimpleNamespace(D=D, F=D * maximum(speed, 0.0), m=m)
