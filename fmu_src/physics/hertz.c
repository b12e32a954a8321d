// Hertz' contact with exact elliptic integrals.
//
//   kappa = a/b from  F(rho) = ((kappa^2 + 1) E - 2 F) / ((kappa^2 - 1) E),
//   F, E elliptic integrals of modulus^2 = 1 - 1/kappa^2,
//   F(rho) = (rho_x - rho_y)/(rho_x + rho_y)
//   a* = (2 kappa^2 E/pi)^(1/3),  b* = (2 E/(pi kappa))^(1/3),  delta* = (2 F/pi) (pi/(2 kappa^2 E))^(1/3)
//   a = a* (3 Q/(2 sum_rho E_star))^(1/3),  delta = delta* (3 Q/(2 sum_rho E_star))^(2/3) sum_rho/2
//
// Harris, Rolling Bearing Analysis, chapter 6.  kappa = 1 gives the sphere: a* = b* = delta* = 1.
#include "physics/hertz.h"

#include "numbers/elementary.h"

void hertz_elliptic(double k2, double *first, double *second)
{
    // a_n, b_n -> AGM; F = pi/(2 a), E = F (1 - sum 2^(n-1) c_n^2).  Abramowitz & Stegun 17.6.
    double a = 1.0, b = sqrt(1.0 - k2), sum = 0.5 * k2, power = 0.5;
    for (int n = 0; n < 40 && fabs(a - b) > 1e-16 * a; n++) {
        const double c = 0.5 * (a - b);
        b = sqrt(a * b);
        a -= c;
        power *= 2.0;
        sum += power * c * c;
    }
    *first = 0.5 * PI / a;
    *second = *first * (1.0 - sum);
}

// F(rho) of an ellipse with axes ratio kappa > 1.
static double curvature_difference(double kappa)
{
    const double k2 = kappa * kappa;
    double F, E;
    hertz_elliptic(1.0 - 1.0 / k2, &F, &E);
    return ((k2 + 1.0) * E - 2.0 * F) / ((k2 - 1.0) * E);
}

Hertz hertz_contact(double rho_x, double rho_y, double E_star)
{
    const double sum = rho_x + rho_y;

    // kappa by bisection of F(rho), which grows with kappa and is (3/4)(kappa - 1) near the sphere; a line
    // contact is out of range: kappa <= 1e5
    const double F_rho = fmin((rho_x - rho_y) / sum, 1.0 - 1e-9);
    double low = 1.0 + 1e-9, high = 1e5;
    if (F_rho <= 1e-8) high = low;
    for (int i = 0; i < 200 && high - low > 1e-15 * high; i++) {
        const double kappa = sqrt(low * high);
        if (curvature_difference(kappa) < F_rho)
            low = kappa;
        else
            high = kappa;
    }
    const double kappa = sqrt(low * high);

    // semi-axes and approach, at the load that scales the ellipse by (Q load)^(1/3)
    double F, E;
    hertz_elliptic(1.0 - 1.0 / (kappa * kappa), &F, &E);
    const double a_star = portable_cbrt(2.0 * kappa * kappa * E / PI), b_star = a_star / kappa;
    const double delta_star = 2.0 * F / (PI * a_star);
    const double load = 3.0 / (2.0 * sum * E_star);
    const double compliance = delta_star * 0.5 * sum * portable_cbrt(load) * portable_cbrt(load);
    const double K = portable_pow(compliance, -1.5), a = a_star * portable_cbrt(load);
    return (Hertz){.K = K,
                   .a = a,
                   .b = b_star * portable_cbrt(load),
                   .a_delta = a * portable_cbrt(K),
                   .k = kappa,
                   .R_x = 1.0 / rho_x};
}
