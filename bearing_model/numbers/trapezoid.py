"""Velocities by the trapezoidal rule, v_{n+1} = v_n + gamma (a_n + a_{n+1}): second differences of the accelerations, the error,
the accelerations at the end.

    delta = v_{n+1} - v_n - h a_n
    h^2 a'' = 2 h^2/(h + h_0) ((a_{n+1} - a_n - b_n)/h - (a_n - a_{n-1} - b_{n-1})/h_0),  error = h^3 a''/12

b: changes of the accelerations that the cage's substeps foresaw and integrated themselves, so that they are no error of this rule.
"""

SMOOTHING = 0.15  # part of the second difference of stiff accelerations that is taken away


def trapezoid_error(h, h_0, unforeseen, jerk):
    """Second differences h^2 a'' and errors.  unforeseen: delta - h/2 b; jerk: (change of a - b) over the step before / its length h_0."""
    second_difference = 2.0 * h * h / (h + h_0) * (2.0 * unforeseen / (h * h) - jerk)
    return second_difference, h / 12.0 * second_difference


def trapezoid_end(h, f, delta, unforeseen, stiff):
    """Accelerations at the end and their unforeseen change over the step / h; stiff: second differences of stiff ones, 0 of the others."""
    return f + 2.0 * delta / h - SMOOTHING * stiff, (2.0 * unforeseen / h - SMOOTHING * stiff) / h
