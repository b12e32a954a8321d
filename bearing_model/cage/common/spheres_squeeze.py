"""The film of oil that a ball presses out of the gap to the sphere of a ribbon cage's half.  Both are rigid here, as in
pocket_squeeze.py.

       pole x                     q = S n: ball's centre from the sphere's centre (pocket_spheres.py), C = R_c - R, h = C - S
     .--+--.    sheet, R_c        gap(u) = C - q.u = h + S (1 - cos phi)      phi: angle of the place u off n
   .'  _|_  '.                    div (gap^3 grad p) = -12 eta v cos phi      on a sphere of the radius sqrt(R R_c)
 -' . ( | ) . '-  seam            p = 0 at the fillet's seam, chi = chi_1 from the split, and at both edges, zeta = +- eta
split     n -> u                  (chi, zeta): angles round the pocket's radius and toward it, n = (cos zeta sin chi, sin zeta,
                                  cos zeta cos chi) = (n_x, n_r, n_t)

A cap round n that ends at the gap h_m:  F = (c v/h) (1 - h/h_m)^2,  c = 6 pi eta R_eff^2,  R_eff = R R_c/C.  Of a straight edge, s l from the
film's middle, l = sqrt(2 h/C):  E(s) = (w + w^2 + w^3)/3,  w = (1 + s/sqrt(s^2 + 1.2))/2.

    D = P E_f E_e E_e c/h,   s_f l = (n_x - sin chi_1)/cos chi_1,   s_e l = (sin eta -+ n_r)/cos eta
    P = P_A + a (P_B - P_A) + b P_R,   a = (n_x - n_xA)/(n_xB - n_xA) >= 0,   b = (n_r/n_rR)^2 up to the edge
    m ~ (n_x, k_r n_r, k_t n_t),   k_t = k_A + a (k_B - k_A)

P and k come from Reynolds' equation by Kantorovich's method (cap_force) at SQUEEZE_NODES gaps in three directions: A where a push along the
circle touches both halves, B 80 degrees from the split, R there at 0.6 sin eta toward an edge.  Force on the ball -F m, F = D v.m, none where v.m < 0.

Derivation, range, filling, floor and sources: spheres_squeeze.h, spheres_squeeze.c.
"""

from types import SimpleNamespace

import numpy as np

from bearing_model.cage.common.pocket_spheres_setup import spheres_radius, spheres_seams
from bearing_model.cage.common.pocket_squeeze import SQUEEZE_NODES, squeeze_newton, squeeze_nodes, squeeze_polynomial
from bearing_model.numbers.lanes import maximum, minimum

ALONG, ACROSS = 96, 32  # intervals over chi and zeta, close together at the narrowest gap
FAR_CHI = 1.3962634015954636  # of B and R, 80 degrees from the split
FAR_ZETA = 0.6  # of R: sin zeta / sin eta


def direction(chi, zeta):
    """A direction from the sphere's centre."""
    return SimpleNamespace(
        chi=chi, zeta=zeta, x=np.cos(zeta) * np.sin(chi), r=np.sin(zeta), t=np.cos(zeta) * np.cos(chi)
    )


def graded(at, first, last, grade, count):
    """Places from first to last, close together at `at`, and the widths of their cells."""
    start, end = np.arcsinh((first - at) / grade), np.arcsinh((last - at) / grade)
    x = at + grade * np.sinh(start + np.arange(count + 1) * ((end - start) / count))
    half = 0.5 * np.diff(x)
    return x, np.append(half, 0.0) + np.insert(half, 0, 0.0)


def tridiagonal(diagonal, off, x):
    """Solution of a symmetric tridiagonal system; off[i] couples i and i + 1."""
    diagonal, x = list(diagonal), list(x)
    for i in range(1, len(x)):
        factor = off[i - 1] / diagonal[i - 1]
        diagonal[i] -= factor * off[i - 1]
        x[i] -= factor * x[i - 1]
    x[-1] /= diagonal[-1]
    for i in range(len(x) - 2, -1, -1):
        x[i] = (x[i] - off[i] * x[i + 1]) / diagonal[i]
    return np.array(x)


def cap_force(chi_1, eta, n, h):
    """Force (x, r, t) of the film at the gap h on a ball that closes in along n, over 12 eta v R_eff^2/C; chi_1, eta: ends of the cap."""
    S, grade = 1.0 - h, np.sqrt(0.5 * h)
    chi, d_chi = graded(n.chi, chi_1, np.pi - chi_1, grade, ALONG)
    zeta, d_zeta = graded(n.zeta, -eta, eta, grade, ACROSS)
    sine, cosine = np.sin(zeta), np.cos(zeta)
    middle = 0.5 * (zeta[1:] + zeta[:-1])
    middle_sine, middle_cosine = np.sin(middle), np.cos(middle)

    # strips: flow resistance of each interval, pressure
    A = S * (n.x * np.sin(chi) + n.t * np.cos(chi))[:, None]
    gap = 1.0 - A * middle_cosine - S * n.r * middle_sine
    flow = np.diff(zeta) / (middle_cosine * gap**3)
    k = np.sum(flow * middle_sine, axis=1) / np.sum(flow, axis=1)
    slope = k[:, None] - middle_sine
    f = np.insert(np.cumsum(slope * flow, axis=1), 0, 0.0, axis=1)
    f[:, -1] = 0.0
    power = np.sum(slope * slope * flow, axis=1)
    part = f * cosine * d_zeta * d_chi[:, None]
    load = np.array(
        [
            np.sum(part * cosine, axis=1) * np.sin(chi),
            np.sum(part * sine, axis=1),
            np.sum(part * cosine, axis=1) * np.cos(chi),
        ]
    )
    diagonal = power * d_chi

    # flow along the cap
    at = 0.5 * (chi[1:] + chi[:-1])
    A_at = S * (n.x * np.sin(at) + n.t * np.cos(at))[:, None]
    along = (1.0 - A_at * cosine - S * n.r * sine) ** 3 / cosine * d_zeta / np.diff(chi)[:, None]
    diagonal[:-1] += np.sum(along * f[:-1] * f[:-1], axis=1)
    diagonal[1:] += np.sum(along * f[1:] * f[1:], axis=1)
    off = -np.sum(along * f[:-1] * f[1:], axis=1)
    X = tridiagonal(diagonal[1:-1], off[1:-1], (n.x * load[0] + n.r * load[1] + n.t * load[2])[1:-1])
    return load[:, 1:-1] @ X


def squeeze_edge(s_l, l_2):
    """E of an edge at s l from the film's middle."""
    w = 0.5 + 0.5 * s_l / np.sqrt(s_l * s_l + 1.2 * l_2)
    return w * (1.0 + w * (1.0 + w)) * (1.0 / 3.0)


def cap_shape(cap, chi_1, eta, n, h):
    """P and the force's direction at the gap h."""
    l_2 = 2.0 * h
    edges = (
        squeeze_edge((n.x - cap.sin_chi) * cap.inv_cos_chi, l_2)
        * squeeze_edge((cap.sin_eta - n.r) * cap.inv_cos_eta, l_2)
        * squeeze_edge((cap.sin_eta + n.r) * cap.inv_cos_eta, l_2)
    )
    force = cap_force(chi_1, eta, n, h)
    along = force[0] * n.x + force[1] * n.r + force[2] * n.t
    return force @ force / along * h / (0.5 * np.pi * edges), force


def spheres_squeeze_derive(p, d):
    """Constants of the films: d.squeeze, where those of the pockets are known; None in dry pockets."""
    filling, R, radius = p.cage.pocket_filling, 0.5 * p.bearing.D, spheres_radius(p)
    d.squeeze, least = None, 1e-3 * R
    if filling <= 0.0:
        return
    # ends of the cap; the three directions
    sin_chi, sin_eta = spheres_seams(p)
    chi_1, eta = np.arcsin(sin_chi), np.arcsin(sin_eta)
    cap = SimpleNamespace(
        sin_chi=sin_chi,
        inv_cos_chi=1.0 / np.sqrt(1.0 - sin_chi**2),
        sin_eta=sin_eta,
        inv_cos_eta=1.0 / np.sqrt(1.0 - sin_eta**2),
        filling=filling,
    )
    push, inside = d.spheres.e / max(radius - R, least), sin_chi + 0.15 * (1.0 - sin_chi)
    A, B = direction(np.arcsin(min(max(push, inside), 0.9)), 0.0), direction(FAR_CHI, 0.0)
    edgeward = direction(FAR_CHI, np.arcsin(FAR_ZETA * sin_eta))
    cap.n_xA, cap.inv_n_x, cap.inv_n_r2 = A.x, 1.0 / (B.x - A.x), 1.0 / edgeward.r**2

    # shapes over the gap: P at A, B, R, k_t at A and B, k_r at R
    cap.node = squeeze_nodes()
    value = np.array([1.0, 1.0, 0.0, 1.0, 1.0, 1.0])[:, None] * np.ones(SQUEEZE_NODES)
    for i, z in enumerate(cap.node[1:], 1):
        (P_A, of_A), (P_B, of_B), (P, of_R) = (cap_shape(cap, chi_1, eta, n, z * z) for n in (A, B, edgeward))
        P_R = P - (P_A + (edgeward.x - A.x) * cap.inv_n_x * (P_B - P_A))
        k = of_A[2] / of_A[0] * A.x / A.t, of_B[2] / of_B[0] * B.x / B.t, of_R[1] / of_R[0] * edgeward.x / edgeward.r
        value[:, i] = P_A, P_B, P_R, *k
    cap.newton = [squeeze_newton(cap.node, shape) for shape in value]

    # closed form of each pocket
    R_eff, own_C = R * radius / max(radius - R, least), np.maximum(d.R_c - d.R, least)
    cap.roughness_2 = p.oil.sigma_pocket**2
    cap.elastic = 2.25 * (6.0 * np.pi * p.oil.eta * R_eff * R_eff / d.spheres.K) ** 0.8
    cap.C, cap.c = own_C, 6.0 * np.pi * p.oil.eta * (d.R * d.R_c / own_C) ** 2
    cap.reach = filling * np.max(own_C)
    d.squeeze = cap


def squeeze_layer(G_e, h, t, C):
    """G of a film that ends at the edges, or where a layer t fills the gap; C: mean gap of a full pocket."""
    least, left = 1e-9, t - h
    root = maximum(left * (2.0 * C - h) / ((2.0 * t - h) * (C - h)), least)
    of_edges, of_layer = maximum(1.0 / maximum(G_e, least) - 1.0, least), 1.0 / (root * root) - 1.0
    cubes = of_edges * of_edges * of_edges + of_layer * of_layer * of_layer
    return np.where(np.real(left) > 0.0, 1.0 / (1.0 + np.exp(np.log(cubes) * (1.0 / 3.0))), 0.0)


def spheres_squeeze(d, q, taken, v):
    """The film of one half: D, F = D v.m, 0 where the ball withdraws [N.s/m, N], and m along the pocket's axes (x, r, t), x toward the pole.

    q: ball's centre from the sphere's; taken: part of the approach by the wall's own compliance; v: velocity of the ball's centre against
    the wall; all along the same axes.
    """
    cap, C = d.squeeze, d.squeeze.C
    S = np.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + 1e-30)
    n_x, n_r, n_t = q[0] / S, q[1] / S, q[2] / S
    # gap with its floor; below 1 nm/s the film is linear in the speed
    delta = S - d.spheres.slack - taken
    closing = maximum(n_x * v[0] + n_r * v[1] + n_t * v[2], 1e-9)
    h_e2 = cap.elastic * np.exp(0.8 * np.log(closing))
    h_eff = np.sqrt(delta * delta + (h_e2 + cap.roughness_2))
    l_2, h = 2.0 * h_eff / C, maximum(-delta, 0.0)
    # edges
    E_f = squeeze_edge((n_x - cap.sin_chi) * cap.inv_cos_chi, l_2)
    E_out = squeeze_edge((cap.sin_eta - n_r) * cap.inv_cos_eta, l_2)
    E_in = squeeze_edge((cap.sin_eta + n_r) * cap.inv_cos_eta, l_2)
    # P and the resultant's direction by gap and direction
    z = np.sqrt(minimum(h / C, 1.0) + 1e-30)
    P_A, P_B, P_R, k_A, k_B, k_r = (squeeze_polynomial(cap.node, newton, z) for newton in cap.newton)
    a = maximum((n_x - cap.n_xA) * cap.inv_n_x, 0.0)
    b = minimum(n_r * n_r, cap.sin_eta**2) * cap.inv_n_r2
    P, k_t = P_A + a * (P_B - P_A) + b * P_R, k_A + a * (k_B - k_A)
    m_x, m_r, m_t = maximum(n_x, 0.0), k_r * n_r, k_t * n_t
    m = np.array([m_x, m_r, m_t]) / np.sqrt(m_x * m_x + m_r * m_r + m_t * m_t + 1e-30)
    G = maximum(P, 0.0) * E_f * E_out * E_in
    if cap.filling < 1.0:
        G = squeeze_layer(G, h, cap.filling * C, C)
    D = G * cap.c / h_eff
    speed = m[0] * v[0] + m[1] * v[1] + m[2] * v[2]
    return SimpleNamespace(D=D, F=D * maximum(speed, 0.0), m=m)
