// Parameters at the temperatures of oil, rings, balls and cage: equations in temperature.h.
#include "physics/temperature.h"

#include "physics/ring_fit.h"
#include "physics/viscosity.h"
#include "rivet/rivet_rom.h"

double *temperature_of(Inputs *u, int i)
{
    double *const all[TEMPERATURES] = {&u->oil.T, &u->ring.T_i, &u->ring.T_e, &u->ball.T, &u->cage.T};
    return all[i];
}

bool temperature_same(const Inputs *u, const Inputs *v)
{
    for (int i = 0; i < TEMPERATURES; i++)
        if (*temperature_of((Inputs *)u, i) != *temperature_of((Inputs *)v, i)) return false;
    return true;
}

// Density of the oil at T.
static double oil_density(const Parameters *p, double T)
{
    return p->oil.rho - p->oil.rho * p->oil.expansion * (T - p->oil.T_0);
}

// Viscosity and beta at T of the oil's two points, relative to `from` at its T_0.
static void oil_ratios(const Parameters *p, double T, const Parameters *from, double *eta, double *beta)
{
    const Oil oil = oil_of(p->oil.nu_1, p->oil.T_1, p->oil.nu_2, p->oil.T_2);
    const Oil other = oil_of(from->oil.nu_1, from->oil.T_1, from->oil.nu_2, from->oil.T_2);
    const double T_0 = from->oil.T_0;
    *eta = oil_density(p, T) * oil_nu(&oil, T) / (oil_density(from, T_0) * oil_nu(&other, T_0));
    *beta = oil_beta(&oil, T) / oil_beta(&other, T_0);
}

static void heat_oil(const Parameters *p, double T, Parameters *hot)
{
    Parameters start;
    Inputs unused;
    variables_set_start(&start, &unused);
    double given_eta, given_beta, eta, beta;
    oil_ratios(p, T, p, &given_eta, &given_beta);
    oil_ratios(p, T, &start, &eta, &beta);
    const double dT = T - p->oil.T_0;
    hot->oil.eta = p->oil.eta * (p->given.oil_eta ? given_eta : eta);
    hot->oil.beta = p->oil.beta * (p->given.oil_beta ? given_beta : beta);
    hot->oil.rho = oil_density(p, T);
    hot->oil.alpha = p->oil.alpha * portable_exp(-p->oil.alpha_T * dT);
}

static void heat_steel(const Parameters *p, double e_i, double e_e, double e_b, Parameters *hot)
{
    const double D = p->bearing.D, d_m = p->bearing.d_m, P_d = p->bearing.P_d;
    const double d_i = d_m - D - 0.5 * P_d, d_e = d_m + D + 0.5 * P_d, volume = 1.0 + e_b;
    hot->bearing.D = D + e_b * D;
    hot->bearing.d_m = d_m + 0.5 * (e_i * d_i + e_e * d_e);
    hot->bearing.P_d = P_d + (e_e * d_e - e_i * d_i - 2.0 * e_b * D);
    hot->bearing.f_i = p->bearing.f_i * ((1.0 + e_i) / (1.0 + e_b));
    hot->bearing.f_e = p->bearing.f_e * ((1.0 + e_e) / (1.0 + e_b));
    hot->bearing.rho = p->bearing.rho / (volume * volume * volume);
}

static void heat_cage(const Parameters *p, double e_c, double e_e, double e_b, Parameters *hot)
{
    const double D = p->bearing.D, pocket = p->cage.pocket_clearance, guide = p->cage.guide_clearance;
    hot->cage.pocket_clearance = pocket + (e_c * (D + pocket) - e_b * D);
    hot->cage.guide_clearance = guide + (e_e * (p->cage.D_o + guide) - e_c * p->cage.D_o);
    double *const sizes[] = {&hot->cage.D_o,          &hot->cage.D_i,           &hot->cage.sheet,
                             &hot->cage.pocket_depth, &hot->cage.pocket_fillet, &hot->cage.pocket_edge};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) *sizes[i] += e_c * *sizes[i];
}

// Fits at temperature; contraction of groove and land of the outer ring by the housing.
static void heat_fits(const Parameters *p, const Inputs *u, double T_a, Parameters *hot)
{
    const double expansion = p->bearing.expansion;
    hot->shaft.interference =
        p->shaft.interference + (p->shaft.expansion - expansion) * (u->ring.T_i - T_a) * ring_fit_bore(p);
    hot->housing.interference = p->housing.interference + (expansion - p->housing.expansion) *
                                                              (u->ring.T_e - T_a) * ring_fit_outside(p);
    const double groove = ring_fit_housing(hot, 0.5 * (p->bearing.d_m + p->bearing.D));
    const double land = ring_fit_housing(hot, 0.5 * (p->cage.D_o + p->cage.guide_clearance));
    hot->bearing.P_d -= 2.0 * groove;
    hot->bearing.d_m -= groove;
    hot->cage.guide_clearance -= 2.0 * land;
}

void temperature_apply(const Parameters *p, const Inputs *u, Parameters *hot)
{
    const Parameters cold = *p;
    const JointData *joint = &rivet_table.joint;
    const double T_a = joint->T_0, expansion = cold.bearing.expansion;
    const double e_i = expansion * (u->ring.T_i - T_a), e_e = expansion * (u->ring.T_e - T_a);
    const double of_ball = cold.ball.expansion > 0.0 ? cold.ball.expansion : expansion;
    const double e_b = of_ball * (u->ball.T - T_a), e_c = joint->alpha_flange * (u->cage.T - T_a);
    *hot = cold;
    heat_oil(&cold, u->oil.T, hot);
    heat_steel(&cold, e_i, e_e, e_b, hot);
    heat_cage(&cold, e_c, e_e, e_b, hot);
    heat_fits(&cold, u, T_a, hot);
    hot->joint.preload = joint_preload(joint, cold.joint.preload, u->cage.T);
    hot->joint.fit = joint_fit(joint, cold.joint.fit, u->cage.T);
}
