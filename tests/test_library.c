// What the tests' library adds to the core's objects: the inline functions, callable over arrays, and memory
// as the kernels want it.
#include "cage/common/spin_preload.h"
#include "cage/elastic/elastic_half.h"
#include "instance/instance.h"
#include "numbers/elementary.h"
#include "numbers/lanes.h"
#include "physics/hertz.h"
#include "physics/model.h"
#include "physics/ring_load.h"
#include "physics/traction.h"
#include "solver/kernels.h"

#include <stdlib.h>

void *test_allocate(size_t size);
void ring_load_update(const Parameters *p, const Inputs *u, double t, RingLoad *ring_load);
void jacobian_product(const Model *model, double t, const double *y, const double *dy,
                      const double *d_ring_load, double *dy_dot, double *dw);  // jacobian_products.c
void jacobian_housing(const double *w, const double *dw, double dF[3], double dM[3]);
void jacobian_matrix(const Model *model, double t, const double *y, double *J);
double *part_state(Part *part);
Kernels kernels_select(void);
ElasticHalf *test_elastic_half(const Parameters *p, const Derived *d);
void test_spin_bending(int n, int steps, const double *S, double P, const double *w, double *more);
void test_ring_tilts(double beta, double gamma, double *tilt_y, double *tilt_z);
void test_ring_load_at(const InputTrajectory *trajectory, double t, RingLoad *ring_load);
void test_pow(int n, double y, const double *x, double *power);
void test_cbrt(int n, const double *x, double *y);
void test_rcbrt(int n, const double *x, double *y);
void test_asin(int n, const double *x, double *y);
void test_hertz_load(int n, double K, const double *delta, double *Q);
void test_hertz_damped(int n, double Q, double lambda, const double *delta_dot, double *damped);
void test_traction_mu(int n, const Parameters *p, double f_a, bool mixed, const double *s, double *mu);
void test_traction_asperity_share(int n, const double *ln_Lambda, double *f_a);
void test_traction_ln_film(int n, double ln_Lambda_1, double Q, const double *U, double *ln_Lambda);
void test_traction_inlet(int n, double rolling, double Q, const double *U, double *F_R);
void test_traction_race_inlet(int n, const Derived *d, double rolling, double Q, const double *U,
                              double *F_R);
void test_traction_ln_thermal(int n, double ln_thermal, const double *U, double *ln_factor);
void test_rivet_rom_stress(int n, const JointLoads *load, double fit_eff, bool all, double *sigma);
unsigned test_rivet_rom_load_flags(double *sigma, int k);

// Zeroed, aligned for any lane width; free() releases it.
void *test_allocate(size_t size)
{
    size = (size + 63) / 64 * 64;
    void *memory = aligned_alloc(64, size);
    return memory ? memset(memory, 0, size) : NULL;
}

ElasticHalf *test_elastic_half(const Parameters *p, const Derived *d)
{
    ElasticHalf *half = test_allocate(sizeof *half);
    if (half) elastic_half_derive(p, d, half);
    return half;
}

// Load and motion by inputs that are held.
void ring_load_update(const Parameters *p, const Inputs *u, double t, RingLoad *ring_load)
{
    const Inputs held[INPUT_ORDERS + 1] = {*u};
    InputTrajectory trajectory;
    input_trajectory_update(p, held, t, t, &trajectory);
    ring_load_at(&trajectory, t, ring_load);
}

double *part_state(Part *part)
{
    return part->s.integrator.now.y;
}

// The kernels of the best instruction set that this processor and its operating system support.
Kernels kernels_select(void)
{
    const char *refused;
    return kernels_wanted(&refused);
}

// All derivatives by the states, column by column: J[j * cage_states(model) + i] = d(y_dot[i])/d(y[j]).
void jacobian_matrix(const Model *model, double t, const double *y, double *J)
{
    const int states = cage_states(model);
    for (int j = 0; j < states; j++) {
        double dy[N_ALL_STATES] = {0.0};
        dy[j] = 1.0;
        jacobian_product(model, t, y, dy, NULL, &J[j * states], NULL);
    }
}

void test_spin_bending(int n, int steps, const double *S, double P, const double *w, double *more)
{
    const CageHalfData half = {.spin_steps = steps, .spin_preload = S};
    for (int i = 0; i < n; i++) more[i] = spin_bending(&half, P, w[i]);
}

void test_ring_tilts(double beta, double gamma, double *tilt_y, double *tilt_z)
{
    ring_tilts(beta, gamma, tilt_y, tilt_z);
}

void test_ring_load_at(const InputTrajectory *trajectory, double t, RingLoad *ring_load)
{
    ring_load_at(trajectory, t, ring_load);
}

void test_pow(int n, double y, const double *x, double *power)
{
    for (int i = 0; i < n; i++) power[i] = portable_pow(x[i], y);
}

void test_cbrt(int n, const double *x, double *y)
{
    for (int i = 0; i < n; i++) y[i] = portable_cbrt(x[i]);
}

void test_rcbrt(int n, const double *x, double *y)
{
    for (int i = 0; i < n; i++) y[i] = approx_inv_cbrt(x[i]);
}

void test_asin(int n, const double *x, double *y)
{
    for (int i = 0; i < n; i++) y[i] = portable_asin(x[i]);
}

void test_hertz_load(int n, double K, const double *delta, double *Q)
{
    for (int i = 0; i < n; i++) Q[i] = hertz_load(wide_set(K), wide_set(delta[i]))[0];
}

void test_hertz_damped(int n, double Q, double lambda, const double *delta_dot, double *damped)
{
    for (int i = 0; i < n; i++)
        damped[i] = hertz_damped(wide_set(Q), wide_set(lambda), wide_set(delta_dot[i]))[0];
}

void test_traction_mu(int n, const Parameters *p, double f_a, bool mixed, const double *s, double *mu)
{
    for (int i = 0; i < n; i++) {
        const wide ratio = wide_set(s[i]), share = wide_set(f_a);
        wide out;
        traction_mu(p, 1, &ratio, &share, mixed, &out);
        mu[i] = out[0];
    }
}

void test_traction_asperity_share(int n, const double *ln_Lambda, double *f_a)
{
    for (int i = 0; i < n; i++) f_a[i] = traction_asperity_share(wide_set(ln_Lambda[i]))[0];
}

void test_traction_ln_film(int n, double ln_Lambda_1, double Q, const double *U, double *ln_Lambda)
{
    for (int i = 0; i < n; i++)
        ln_Lambda[i] =
            traction_ln_film(wide_set(ln_Lambda_1), wide_log(wide_set(U[i])), wide_log(wide_set(Q)))[0];
}

void test_traction_race_inlet(int n, const Derived *d, double rolling, double Q, const double *U, double *F_R)
{
    const wide ln_Q = wide_log(wide_set(Q + Q_FLOOR));
    for (int i = 0; i < n; i++)
        F_R[i] = traction_race_inlet(d, wide_set(rolling), wide_set(U[i]), wide_log(wide_set(U[i])),
                                     wide_set(Q), ln_Q)[0];
}

void test_traction_ln_thermal(int n, double ln_thermal, const double *U, double *ln_factor)
{
    for (int i = 0; i < n; i++)
        ln_factor[i] = traction_ln_thermal(wide_set(ln_thermal), wide_log(wide_set(U[i])))[0];
}

void test_traction_inlet(int n, double rolling, double Q, const double *U, double *F_R)
{
    const wide ln_Q = wide_log(wide_set(Q + Q_FLOOR));
    for (int i = 0; i < n; i++)
        F_R[i] = traction_inlet(wide_set(rolling), wide_log(wide_set(U[i])), wide_set(Q), ln_Q)[0];
}

// sigma: [RIVET_CHANNELS][Z] of the last load.
void test_rivet_rom_stress(int n, const JointLoads *load, double fit_eff, bool all, double *sigma)
{
    constants fit;
    for (int k = 0; k < LANES; k++) fit[k] = fit_eff;
    const Kernels kernels = kernels_select();
    for (int i = 0; i < n; i++)
        kernels.rivet_rom_stress(&rivet_table, &load[i], fit, all, (double (*)[Z])sigma);
}

unsigned test_rivet_rom_load_flags(double *sigma, int k)
{
    return rivet_rom_load_flags(&rivet_table, (double (*)[Z])sigma, k);
}
