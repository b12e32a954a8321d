"""An elastic ball in a spherical hole of an infinite elastic body: an independent solution for the contact of nearly equal spheres.

Each body's surface moves by the Legendre series of the pressure on it, degree by degree in closed form (Love, A Treatise on the Mathematical
Theory of Elasticity, section 172): u = A grad(phi) + B (r^2 grad(phi) + alpha x phi), phi = r^m P_n(cos theta), m = n in the ball and -(n + 1)
outside.  The ball's force is balanced by its inertia, a uniform body force, and its place is that of its centre of mass.  The pressure is
constant on rings; it and the gap are not negative and exclude each other.  Without friction.
"""

import numpy as np


def degree(n, m, E, nu):
    """Radial displacement of the surface r = 1 [m/Pa] by the pressure P_n, of solutions that grow with r^m."""
    lam, mu = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), 0.5 * E / (1.0 + nu)
    alpha = -2.0 * (m * lam + (3.0 * m + 1.0) * mu) / ((m + 3.0) * lam + (m + 5.0) * mu)
    terms = ((m, 1.0, m - 1.0), (m + alpha, 1.0, m + 1.0))  # u_r = U r^k P_n, u_theta = V r^k P_n'
    normal = [lam * (k * U + 2.0 * U - n * (n + 1.0) * V) + 2.0 * mu * k * U for U, V, k in terms]
    shear = [mu * (k * V - V + U) for U, V, k in terms]
    # normal A + normal B = -1 without shear
    det = normal[0] * shear[1] - normal[1] * shear[0]
    return (-shear[1] * terms[0][0] + shear[0] * terms[1][0]) / det


def ball_series(count, E, nu):
    """Radial displacement of a ball's surface / (pressure times radius) by degree [count]."""
    lam, mu = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), 0.5 * E / (1.0 + nu)
    n = np.arange(count, dtype=float)
    series = np.empty(count)
    series[0] = -1.0 / (3.0 * lam + 2.0 * mu)
    series[1] = -1.2 / (6.0 * lam + 4.0 * mu)  # u = beta (r^2 e_z - 2 z x), less its mean beta/5
    series[2:] = degree(n[2:], n[2:], E, nu)
    return series


def hole_series(count, E, nu):
    """The same of a hole in an infinite body."""
    n = np.arange(count, dtype=float)
    series = degree(np.maximum(n, 1.0), -(np.maximum(n, 1.0) + 1.0), E, nu)
    series[0] = 0.5 * (1.0 + nu) / E
    return series


def legendre(c, count):
    """P_n(c) of the degrees 0...count [count + 1, places]."""
    P = np.ones((count + 1, len(c)))
    P[1] = c
    for n in range(1, count):
        P[n + 1] = ((2 * n + 1) * c * P[n] - n * P[n - 1]) / (n + 1)
    return P


def force_at(approach, R, R_hole, ball, hole, rings=60):
    """Force [N] and radius of contact [m] at the approach [m] of the ball's centre of mass beyond the first touch; ball, hole: E [Pa], nu."""
    slack = R_hole - R
    centre = slack + approach
    # rings over twice the radius of Hertz' contact, and as many degrees as resolve them
    end = 2.0 * np.sqrt(approach / slack * R_hole / R)
    theta = np.linspace(0.0, min(end, 1.2), rings + 1)
    count = int(8.0 / (theta[1] - theta[0]))
    middle = 0.5 * (theta[1:] + theta[:-1])

    def motions(theta, middle, series):
        """Radial motions [m/Pa] of a unit sphere at the middles by pressures on the rings."""
        edges, P = legendre(np.cos(theta), count), legendre(np.cos(middle), count)
        # (2 n + 1)/2 times the integral of P_n over a ring: (P_(n-1) - P_(n+1))/2 between its ends
        part = np.empty((count, rings))
        part[0] = 0.5 * (np.cos(theta[:-1]) - np.cos(theta[1:]))
        difference = edges[:-2] - edges[2:]
        part[1:] = 0.5 * (difference[:, 1:] - difference[:, :-1])
        return P[:count].T @ (series[:, None] * part)

    # the patch lies on the hole; seen from the ball its angles are larger
    on_ball = [np.arcsin(np.sin(angle) * R_hole / R) for angle in (theta, middle)]
    W = R_hole * motions(theta, middle, hole_series(count, *hole)) - R * motions(*on_ball, ball_series(count, *ball))
    gap = R_hole - centre * np.cos(middle) - np.sqrt(R**2 - (centre * np.sin(middle)) ** 2)

    touched = gap < 0.0
    for _ in range(100):
        p = np.zeros(rings)
        p[touched] = np.linalg.solve(W[np.ix_(touched, touched)], -gap[touched])
        now = np.where(touched, p > 0.0, gap + W @ p < 0.0)
        if np.array_equal(now, touched):
            break
        touched = now
    else:
        raise RuntimeError("no set of rings in contact")
    assert not touched[-1], "the contact reaches the last ring"
    area = np.pi * R_hole**2 * (np.sin(theta[1:]) ** 2 - np.sin(theta[:-1]) ** 2)  # cos theta dA
    return float(p @ area), float(R_hole * theta[1:][touched].max())
