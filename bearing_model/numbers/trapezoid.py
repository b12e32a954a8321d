"""Velocities by the trapezoidal rule, v_{n+1} = v_n + gamma (a_n + a_{n+1}): second differences of the accelerations, the error,
the accelerations at the end.

    delta = v_{n+1} - v_n - h a_n
    h^2 a'' = 2 h^2/(h + h_0) ((a_{n+1} - a_n)/h - (a_n - a_{n-1})/h_0),  error = h^3 a''/12
"""

SMOOTHING = 0.15  # part of the second difference of stiff accelerations that is taken away


def trapezoid_error(h, h_0, delta, jerk):
    """Second differences h^2 a'' and errors.  jerk: change of a over the step before / its length h_0."""
    second_difference = 2.0 * h * h / (h + h_0) * (2.0 * delta / (h * h) - jerk)
    return second_difference, h / 12.0 * second_difference


def trapezoid_end(h, f, delta, stiff):
    """Accelerations at the end and their change over the step / h; stiff: second differences of stiff ones, 0 of the others."""
    f_end = f + 2.0 * delta / h - SMOOTHING * stiff
    return f_end, (f_end - f) / h
