// Velocities by the trapezoidal rule, v_{n+1} = v_n + gamma (a_n + a_{n+1}): second differences of the accelerations, the
// error, the accelerations at the end.  Balls, ring and cage halves have their own rows [first, end) of one state.
//
//   delta = v_{n+1} - v_n - h a_n
//   h^2 a'' = 2 h^2/(h + h_0) ((a_{n+1} - a_n - b_n)/h - (a_n - a_{n-1} - b_{n-1})/h_0)     over the last two steps
//   error = h^3 a''/12
//
// b: changes of the accelerations that the cage's substeps foresaw and integrated themselves, so that they are no error of this rule.
#pragma once

// Part of the second difference of stiff accelerations that is taken away.  The amplification factor of a
// rate A, which for the trapezoidal rule tends to -1, then has a modulus below 0.46 for gamma A > 2; A may be
// 13 % too small (docs/method.md).
static const double SMOOTHING = 0.15;

// Second differences h^2 a'' and errors.  unforeseen: delta - h/2 b; jerk: (change of a - b) over the step before / its length h_0.
static inline void trapezoid_error(double h, double h_0, int first, int end,
                                   const double *restrict unforeseen, const double *restrict jerk,
                                   double *restrict second_difference, double *restrict error)
{
    const double inv_gamma = 1.0 / (0.5 * h), inv_h = 1.0 / h, inv_span = 2.0 / (h + h_0);
    const double second = h * h * inv_span;
    for (int i = first; i < end; i++) {
        second_difference[i] = second * (unforeseen[i] * (inv_gamma * inv_h) - jerk[i]);
        error[i] = (h / 12.0) * second_difference[i];
    }
}

// Accelerations at the end and their unforeseen change over the step / h.  Stiff ones give up a part of their second difference, which is
// of the order of the method's own error; `stiff` is 0 of the others.
static inline void trapezoid_end(double h, int first, int end, const double *restrict f,
                                 const double *restrict delta, const double *restrict unforeseen,
                                 const double *restrict stiff, double *restrict f_end, double *restrict jerk)
{
    const double inv_gamma = 1.0 / (0.5 * h), inv_h = 1.0 / h;
    for (int i = first; i < end; i++) {
        f_end[i] = f[i] + delta[i] * inv_gamma - SMOOTHING * stiff[i];
        jerk[i] = (unforeseen[i] * inv_gamma - SMOOTHING * stiff[i]) * inv_h;
    }
}
