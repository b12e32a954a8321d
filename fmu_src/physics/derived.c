// Constants derived from the parameters at their temperatures (temperature.h), element by element; equations stand in
// the elements' files.
#include "cage/cage.h"
#include "cage/common/pocket_squeeze.h"
#include "cage/common/spheres_squeeze.h"
#include "numbers/elementary.h"
#include "physics/hertz.h"
#include "physics/race_surface.h"
#include "physics/ring_fit.h"
#include "rivet/rivet_rom.h"

#include <stdlib.h>

// Density of air [kg/m3] at 293 K and 10^5 Pa.
static const double AIR_DENSITY = 1.19;

// ln Lambda at U = 1 m/s, Q = 1 N:
// ln of 2.69 G^0.53 (1 - 0.61 exp(-0.73 k)) R_x (eta/(E' R_x))^0.67 (1/(E' R_x^2))^-0.067 / sigma.
static double ln_film(double E_prime, double R_x, double k, const Parameters *p, double sigma)
{
    const double G = p->oil.alpha * E_prime;
    return portable_log(2.69 * (1.0 - 0.61 * portable_exp(-0.73 * k)) * R_x / sigma) +
           0.53 * portable_log(G) + 0.67 * portable_log(p->oil.eta / (E_prime * R_x)) +
           0.067 * portable_log(E_prime * R_x * R_x);
}

// F_R at U = 1 m/s, Q = 1 N: 2.86 E' R_x^2 (R_y/R_x)^0.348 G^0.022 (eta/(E' R_x))^0.66 (1/(E' R_x^2))^0.47.
static double inlet(double E_prime, double R_x, double R_y, const Parameters *p)
{
    return p->oil.rolling * 2.86 * E_prime * R_x * R_x * portable_pow(R_y / R_x, 0.348) *
           portable_pow(p->oil.alpha * E_prime, 0.022) * portable_pow(p->oil.eta / (E_prime * R_x), 0.66) *
           portable_pow(E_prime * R_x * R_x, -0.47);
}

// Constants of the balls' material, those of the rings where the parameters leave them open.
static double ball_E(const Parameters *p)
{
    return p->ball.E > 0.0 ? p->ball.E : p->bearing.E;
}

static double ball_nu(const Parameters *p)
{
    return p->ball.nu > 0.0 ? p->ball.nu : p->bearing.nu;
}

// E_star of ball and race, 1/E_star = (1 - nu_b^2)/E_b + (1 - nu^2)/E; half of E/(1 - nu^2) to the last bit
// where both are alike.
static double race_modulus(const Parameters *p)
{
    const double ring = p->bearing.E / (1.0 - p->bearing.nu * p->bearing.nu);
    const double ball = ball_E(p) / (1.0 - ball_nu(p) * ball_nu(p));
    return ring / (1.0 + ring / ball);
}

// Constants of the contacts with one race; side: -1 for the inner race, +1 for the outer one.
static void derive_race(const Parameters *p, double f, double side, Race *race)
{
    const double D = p->bearing.D, R = 0.5 * D, gamma = D / p->bearing.d_m;
    const double E_star = race_modulus(p);
    const double rho_x = 1.0 / (R * (1.0 + side * gamma)), rho_y = 1.0 / R - 1.0 / (f * D);
    race->R_g = 0.5 * p->bearing.d_m - side * ((f - 0.5) * D - 0.25 * p->bearing.P_d);
    race->r_g = f * D;
    race->R_m = 2.0 * f * D * R / (f * D + R);
    race->hertz = hertz_contact(rho_x, rho_y, E_star);
    race->rolling = inlet(2.0 * E_star, 1.0 / rho_x, 1.0 / rho_y, p);
    race->horizontal = 2.0 / (rho_x * R);
    race->ln_Lambda = ln_film(2.0 * E_star, 1.0 / rho_x, race->hertz.k, p, p->oil.sigma_race);
}

// The spall at the contact of ball j with one race (race_surface.h).
static void derive_spall(const Race *race, double track, double length, double width, double depth,
                         double edge, int j, Spalls *s)
{
    const double c = fmin(edge, 0.25 * length), R_x = race->hertz.R_x;
    s->track[j] = track, s->bend[j] = 1.0;
    if (!spall_given(length, width, depth)) return;
    s->half_length[j] = 0.5 * length, s->half_width[j] = 0.5 * width;

    // u_1 (u_1 + c) = 2 R_x depth; a short spall ends before
    s->u_1[j] = fmin(0.5 * (sqrt(c * c + 8.0 * R_x * depth) - c), s->half_length[j] - c);
    s->u_2[j] = s->u_1[j] + c;
    s->bend[j] = 1.0 + s->u_1[j] / c;
    s->flank[j] = s->half_width[j] * s->half_width[j] / (race->hertz.a_delta * race->hertz.a_delta);
}

// Table of the waves over a turn that begins at phi = -pi.
static void derive_waves(const double amplitude[WAVES], const double phase[WAVES],
                         double wave[WAVE_CELLS + 1][2])
{
    // c_n exp(i n phi) with exp(i n phi) step by step: w is the real part of the sum, dw/dphi the imaginary part of -n
    // times it
    const double width = 2.0 * PI / WAVE_CELLS;
    double re[WAVES], im[WAVES];
    for (int i = 0; i < WAVES; i++) {
        re[i] = amplitude[i] * portable_cos(phase[i]);
        im[i] = amplitude[i] * portable_sin(phase[i]);
    }
    for (int k = 0; k < WAVE_CELLS; k++) {
        const double phi = (k - WAVE_CELLS / 2) * width, c = portable_cos(phi), s = portable_sin(phi);
        double c_n = 1.0, s_n = 0.0, w = 0.0, dw = 0.0;
        for (int i = 0; i < WAVES; i++) {
            const double next = c_n * c - s_n * s;
            s_n = s_n * c + c_n * s, c_n = next;
            w += re[i] * c_n - im[i] * s_n;
            dw -= (i + 1) * (re[i] * s_n + im[i] * c_n);
        }
        wave[k][0] = w, wave[k][1] = dw * width;
    }
    memcpy(wave[WAVE_CELLS], wave[0], sizeof wave[0]);
}

// Waves and spall of a race (race_surface.h).
static void derive_surface(const double amplitude[WAVES], const double phase[WAVES], double middle,
                           double length, double width, double depth, double edge, double track, Race *race)
{
    RaceSurface *s = &race->surface;
    s->wavy = race_waves_given(amplitude);
    if (s->wavy) derive_waves(amplitude, phase, s->wave);
    s->curvature = 1.0 / race->hertz.R_x;
    s->middle_cos = portable_cos(middle), s->middle_sin = portable_sin(middle);
    s->spalled = spall_given(length, width, depth);
    for (int j = 0; j < LANES; j++) derive_spall(race, track, length, width, depth, edge, j, &s->spall);
}

static void derive_surfaces(const Parameters *p, Derived *d)
{
    const double bottom_i = 0.5 * (p->bearing.d_m - p->bearing.D),
                 bottom_e = 0.5 * (p->bearing.d_m + p->bearing.D);
    derive_surface(p->inner.waviness, p->inner.waviness_phase, p->inner.spall_angle, p->inner.spall_length,
                   p->inner.spall_width, p->inner.spall_depth, p->inner.spall_edge, bottom_i, &d->inner);
    derive_surface(p->outer.waviness, p->outer.waviness_phase, p->outer.spall_angle, p->outer.spall_length,
                   p->outer.spall_width, p->outer.spall_depth, p->outer.spall_edge, bottom_e, &d->outer);
    Race *const race[2] = {&d->inner, &d->outer};
    for (int side = 0; side < 2; side++)
        for (int j = 0; j < Z; j++)
            derive_spall(race[side], d->R[j], p->ball.spall_length[j], p->ball.spall_width[j],
                         p->ball.spall_depth[j], p->ball.spall_edge[j], j, &race[side]->balls);
    d->rough = race_surfaces_given(p);
    d->spalled = ball_spalls_given(p);
}

// Density of the mixture; of the oil, where the flow gives the filling.
static double reference_density(const Parameters *p)
{
    return p->oil.flow > 0.0 ? p->oil.rho : p->oil.rho_mix;
}

// Constants of drag.c.
static void derive_mixture(const Parameters *p, Derived *d)
{
    const double D = p->bearing.D, d_m = p->bearing.d_m, R = 0.5 * D, gamma = D / d_m,
                 nu = p->oil.eta / p->oil.rho;
    const double rho = reference_density(p), kappa = 0.5 * (1.0 - gamma);

    // Parker's fraction is 1 at this speed: 10^5 W^0.37/(n d_m^1.7), cm3/min, r/min, mm
    d->flooded_omega = PI / 30.0 * 1e5 * portable_pow(6e7 * p->oil.flow, 0.37) / portable_pow(1e3 * d_m, 1.7);
    d->air = AIR_DENSITY / p->oil.rho;

    // balance of the mixture
    const double r_m = 0.5 * d_m, r_i = r_m - R, r_e = r_m + R;
    const double height = D * fmax(1.0 - p->bearing.h_i - p->bearing.h_e, 0.1);
    const double width_e = fmax(p->cage.width - 2.0 * p->cage.land_width, 0.0);
    const double f_i = 0.066 * portable_pow((1.0 - kappa) * r_i * height / nu, -0.25);
    const double f_e = 0.066 * portable_pow(kappa * r_e * height / nu, -0.25);
    d->sigma = 1.0 / kappa;
    d->ball_area = Z * p->oil.C_d * PI * R * R;
    d->inner_wall = f_i * 2.0 * PI * r_i * p->cage.width * portable_pow(r_i / r_m, 3.0);
    d->outer_wall = f_e * 2.0 * PI * r_e * width_e * portable_pow(r_e / r_m, 3.0);
    d->fresh = 2.0 * p->oil.flow / (kappa * r_m);
    d->ring_drag = p->scene.drag == DRAG_ROW ? 0.5 * rho * d->inner_wall * portable_pow(r_m, 3.0) : 0.0;

    // churning: (1/2) rho R^5 (6.45 sqrt(nu/(R^2 omega)) + 32.1 nu/(R^2 omega)) omega^2
    d->churning_boundary = 0.5 * rho * 6.45 * sqrt(nu) * portable_pow(R, 4.0);
    d->churning_viscous = 0.5 * rho * 32.1 * nu * R * R * R;
}

// Shear heating and starvation of the race inlets (traction.h).
static void derive_inlets(const Parameters *p, Derived *d)
{
    const double D = p->bearing.D, d_m = p->bearing.d_m, gamma = D / d_m, nu = 1e6 * p->oil.eta / p->oil.rho;
    const bool heating = p->scene.heating == SWITCH_ON;

    // n d_m [r/min mm] at U = 1 m/s: U = omega d_m (1 - gamma^2)/4; cross-section of the bearing D/0.3
    const double speed = 30.0 / PI * 4e3 / (1.0 - gamma * gamma), section = 1e3 * D / 0.3;
    d->starvation = p->oil.K_rs * nu * 2.0 * speed * sqrt(0.5 * p->oil.K_Z / section);
    d->ln_heating =
        heating ? portable_log(1.84e-9) + 1.28 * portable_log(speed) + 0.64 * portable_log(nu) : -INFINITY;
    d->ln_thermal =
        heating && p->oil.beta > 0.0 ? portable_log(p->oil.eta * p->oil.beta / p->oil.k) : -INFINITY;
}

static void derive_balls(const Parameters *p, Derived *d)
{
    const double D = p->bearing.D, area = 0.25 * PI * D * D;
    for (int j = 0; j < LANES; j++)
        d->R[j] = j < Z ? 0.5 * (D + p->ball.dD[j]) : 0.0;  // padding lanes touch nothing
    d->m = p->bearing.rho * PI / 6.0 * D * D * D;
    d->J = 0.1 * d->m * D * D;
    d->drag = 0.5 * p->oil.C_d * reference_density(p) * area;
    derive_race(p, p->bearing.f_i, -1.0, &d->inner);
    derive_race(p, p->bearing.f_e, 1.0, &d->outer);
    derive_surfaces(p, d);
    d->fit = ring_fit_of(p);
    derive_inlets(p, d);
    derive_mixture(p, d);
}

static void derive_pockets(const Parameters *p, Derived *d)
{
    const double R = 0.5 * p->bearing.D;
    d->pocket_radius = R + 0.5 * p->cage.pocket_clearance;
    const double E_star =
        1.0 / ((1.0 - ball_nu(p) * ball_nu(p)) / ball_E(p) + (1.0 - p->cage.nu * p->cage.nu) / p->cage.E);
    // the closest conformity is R_y = 1000 R
    const double rho_y = fmax(1.0 / R - 1.0 / d->pocket_radius, 1e-3 / R);
    d->pocket = hertz_contact(1.0 / R, rho_y, E_star);
    d->pocket_rolling = inlet(2.0 * E_star, R, 1.0 / rho_y, p);

    // film; of a ribbon's spheres the reduced radius is the same both ways
    const bool ribbon = p->cage.shape == CAGE_SHAPE_RIBBON;
    const double R_x = ribbon ? 1.0 / rho_y : R, k = ribbon ? 1.0 : d->pocket.k;
    d->ln_pocket_piezo = ln_film(2.0 * E_star, R_x, k, p, p->oil.sigma_pocket);

    // isoviscous-rigid film: h/R = 128 alpha_r lambda_b^2 (0.131 atan(alpha_r/2) + 1.683)^2 (U/W)^2, alpha_r
    // = R_y/R_x.  Hamrock & Dowson (1979), Brewe
    const double alpha_r = 1.0 / (rho_y * R_x), lambda_b = 1.0 / (1.0 + 0.698 / alpha_r);
    const double shape = 128.0 * alpha_r * lambda_b * lambda_b *
                         portable_pow(0.131 * portable_atan(0.5 * alpha_r) + 1.683, 2.0);
    d->ln_pocket_rigid =
        portable_log(shape * R_x / p->oil.sigma_pocket) + 2.0 * portable_log(p->oil.eta * R_x);

    // positions of pockets and rivets
    for (int j = 0; j < LANES; j++) {
        const double phi = 2.0 * PI * (j % Z) / Z + p->pocket.dtheta[j % Z];
        const double phi_r = 2.0 * PI * (j % Z + 0.5) / Z;
        d->R_c[j] = d->pocket_radius + 0.5 * p->pocket.dD[j % Z];
        d->pocket_cos[j] = j < Z ? portable_cos(phi) : 0.0;
        d->pocket_sin[j] = j < Z ? portable_sin(phi) : 0.0;
        d->rivet_y[j] = 0.5 * rivet_table.joint.d_m * portable_cos(phi_r);
        d->rivet_z[j] = 0.5 * rivet_table.joint.d_m * portable_sin(phi_r);
    }
    if (ribbon) spheres_derive(p, E_star, d);
}

// A moment of inertia that is left at its start value follows the mass, which scales the density.
static double follows_mass(double J, double J_start, double mass_ratio)
{
    return J == J_start ? mass_ratio * J : J;
}

void cage_half_inertia(const Parameters *p, double *J_p, double *J_t)
{
    Parameters start;
    Inputs input;
    variables_set_start(&start, &input);
    *J_p = follows_mass(p->cage.J_p, start.cage.J_p, p->cage.m / start.cage.m);
    *J_t = follows_mass(p->cage.J_t, start.cage.J_t, p->cage.m / start.cage.m);
}

static void derive_cage(const Parameters *p, Derived *d)
{
    cage_half_inertia(p, &d->J_p, &d->J_t);
    const double R = 0.5 * p->cage.D_o, L = p->cage.land_width, nu = p->oil.eta / p->oil.rho;
    const double r_i = 0.5 * p->cage.D_i;
    d->com_x[0] = -p->cage.x_c;
    d->com_x[1] = p->cage.x_c;
    d->com_e = p->cage.unbalance / (2.0 * p->cage.m);
    d->C_land = 0.5 * p->cage.guide_clearance;
    const double *growth = rivet_table.half.growth;
    d->growth = cage_centrifugal(p) * (growth[0] + p->cage.land_x * growth[1]);
    d->guided = p->cage.guidance == CAGE_GUIDANCE_OUTER;
    d->play = d->guided ? d->C_land : 0.5 * p->cage.pocket_clearance;
    d->bar = p->bearing.d_m * portable_sin(PI / Z) - p->bearing.D - p->cage.pocket_clearance;
    d->kappa = p->oil.eta * R * L * L * L / (d->C_land * d->C_land * d->C_land);
    d->couette = 2.0 * PI * p->oil.eta * R * R * R * L / d->C_land;
    d->nahme = p->scene.heating == SWITCH_ON ? 0.125 * p->oil.beta * p->oil.eta * R * R / p->oil.k : 0.0;
    d->ln_land = portable_log(d->C_land / p->oil.sigma_land);

    // end face: (1/2) rho omega^2 (r_o^5 - r_i^5) C_n/2, given per omega (drag_cage multiplies by omega)
    const double face = 0.25 * reference_density(p) * (portable_pow(R, 5.0) - portable_pow(r_i, 5.0));
    const double Re = R * R / nu;
    d->disk_laminar = face * 3.87 / sqrt(Re);
    d->disk_turbulent = face * 0.146 * portable_pow(Re, -0.2);

    // cylinder outside the land, at the same gap
    const double width = fmax(0.5 * p->cage.width - L, 0.0), Ta = R * d->C_land / nu * sqrt(d->C_land / R);
    d->cylinder_laminar = reference_density(p) * nu * R / d->C_land * (2.0 * PI * R * width) * R;
    d->cylinder_vortex = d->cylinder_laminar * 1.3 * portable_pow(Ta / 41.0, 0.539);

    // the turbulent laws overtake at k_t omega^0.8 = k_l omega^0.5 and 1.3 (Ta/41)^0.539 = 1; the limits are
    // just below these speeds, so that the larger moment decides there
    d->disk_laminar_omega = 0.999 * portable_pow(d->disk_laminar / d->disk_turbulent, 1.0 / 0.3);
    d->cylinder_laminar_omega = 0.999 * portable_pow(d->cylinder_laminar / d->cylinder_vortex, 1.0 / 0.539);
}

static void derive_lands(const Parameters *p, Derived *d)
{
    for (int i = 0; i < LAND_POINTS; i++) {
        const double psi = 2.0 * PI * i / LAND_POINTS;
        d->land_cos[i] = portable_cos(psi);
        d->land_sin[i] = portable_sin(psi);
    }
    for (int i = 0; i < BENT_POINTS; i++) {
        const double psi = 2.0 * PI * i / BENT_POINTS;
        d->bent_cos[i] = portable_cos(psi);
        d->bent_sin[i] = portable_sin(psi);
    }
    const bool odd[ROWS] = {[ROW_V_T] = true, [ROW_M_R] = true, [ROW_DM_R] = true};
    const bool opposed[ROWS] = {[ROW_V_R] = true, [ROW_V_T] = true};
    const double *from = rivet_table.half.land;
    for (int n = 0; n < LAND_WAVES; n++) {
        for (int each = 0; each < LAND_EACH; each++, from += 2 * ROWS) {
            // the modes of elastic halves carry the loads of the joints by the shapes that they bend
            const int harmonic = land_harmonic(n, each);
            const bool bent = p->scene.cage == CAGE_MODEL_ELASTIC && (n == 2 || n == 3) && abs(harmonic) == n;
            for (int i = bent ? ROW_DP : 0; i < ROWS; i++)
                d->land_path.row[n][each][2 * odd[i] + opposed[i]][i] =
                    from[i] + p->cage.land_x * from[ROWS + i];
        }
        for (int k = 0; k < Z; k++) {
            const double angle = 2.0 * PI * n * (k + 0.5) / Z;
            d->land_path.wave[n][0][k] = portable_cos(angle);
            d->land_path.wave[n][1][k] = portable_sin(angle);
        }
    }
}

static const double BROKEN_PLAY = 1.0;  // of a rivet that is gone [m]

// Rivet k: preload, fit, hole.  A broken one has no preload and a free fit; its hole bears nothing.
static void derive_rivet(const Parameters *p, Derived *d, int k)
{
    const bool intact = p->rivet.intact[k % Z] != 0;
    const double fit_a = p->joint.fit + p->rivet.dfit[k % Z] + p->joint.swell;
    d->intact[k] = intact ? 1.0 : 0.0;
    d->P[k] = d->intact[k] * (p->joint.preload * p->rivet.preload_factor[k % Z]);
    d->fit_eff[k] =
        intact ? rivet_rom_fit_eff(&rivet_table, fit_a, p->rivet.fit_model == FIT_MODEL_J2) : -BROKEN_PLAY;
    d->k_hole[k] = intact ? joint_hole_stiffness(&rivet_table.joint, fit_a) : 0.0;
    d->hole_gap[k] = intact ? fmax(0.0, -fit_a) : BROKEN_PLAY;
    if (k < Z) d->fit_flags[k] = intact ? rivet_rom_fit_flags(&rivet_table, fit_a) : 0;
}

static void derive_joint(const Parameters *p, Derived *d)
{
    const JointData *joint = &rivet_table.joint;
    double factors = 0.0, standing = 0.0;
    for (int k = 0; k < LANES; k++) derive_rivet(p, d, k);
    for (int k = 0; k < Z; k++) {
        standing += d->intact[k];
        factors += d->intact[k] * p->rivet.preload_factor[k];
    }
    d->P_mean = p->joint.preload * (standing > 0.0 ? factors / standing : 0.0);
    d->k_rivet = joint->k_rivet;
    d->k_plate = joint->k_plate;
    d->k_plate_t = joint->k_t_plate;
    d->k_head = joint->k_t_head;
    const CageHalfData *half = &rivet_table.half;
    d->inv_R = 2.0 / joint->d_m;
    for (int i = 0; i < ROWS; i++) d->centrifugal[i] = cage_centrifugal(p) * half->spin[i];
    d->c_joint = 2.0 * p->joint.zeta * sqrt((d->k_rivet + d->k_plate) * 0.5 * p->cage.m / Z);
}

// Errors that tolerance 1 allows: lengths and velocities, angles as arcs, friction states as parts of the deflection at
// which the plates slip.  The default method has scales by consequence (docs/method.md): a ball's velocity along its
// orbit decides how it meets its pocket and is finer, less so where walls give way; integrator.c makes it
// finer still at lower speeds.  Its velocity along the contact normals, where a step's error moves it by
// nanometres, and the friction states, whose error hardly changes a half's velocity within a step, are wider.
static void derive_scales(const Parameters *p, Derived *d)
{
    const bool equal = p->solver.method == METHOD_EXPLICIT;
    const double length = 1e-5, velocity = equal ? 0.1 : 0.5, r = 0.5 * p->bearing.d_m;
    double orbit, friction_scale;
    cage_scales(p, &orbit, &friction_scale);
    const double slip =
        fmax(p->joint.mu * d->P_mean, 3.0);  // force at which plates slip; of a loose joint the default's
    const double friction = equal ? slip : friction_scale * slip;
    d->scale[SCALE_LENGTH] = length;
    d->scale[SCALE_VELOCITY] = velocity;
    d->scale[SCALE_NORMAL] = equal ? velocity : 1.5 * velocity;
    d->scale[SCALE_RATE] = velocity / r;
    d->scale[SCALE_ORBIT] = (equal ? velocity : velocity * orbit) / r;
    d->scale[SCALE_MODE] = velocity;
    d->scale[SCALE_SPIN] = velocity / (0.5 * p->bearing.D);
    d->scale[SCALE_ANGLE] = d->scale[SCALE_TILT] = length / r;
    d->scale[SCALE_PLATE] = friction / d->k_plate_t;
    d->scale[SCALE_HEAD] = friction / d->k_head;
    d->scale[SCALE_ENERGY] = 1e30;
}

static void derive_relative(const Parameters *p, Derived *d)
{
    const double translation = 2.0 / p->cage.m, c_x = d->com_x[1];
    const double across = translation + 2.0 * c_x * c_x / d->J_t;
    const double inverse[] = {translation, 2.0 / d->J_t, 2.0 / d->J_t, across, across, 2.0 / d->J_p};
    memcpy(d->relative_inverse, inverse, sizeof inverse);
    d->relative_part = translation / across, d->relative_tilt = c_x / d->J_t / across;
}

static void fill(double *row, int count, double value)
{
    for (int i = 0; i < count; i++) row[i] = value;
}

static void derive_inertia(const Parameters *p, Derived *d)
{
    fill(&d->inertia[Y_BALL_V_X], 3 * Z, d->m);
    fill(&d->inertia[Y_BALL_OMEGA_X], 3 * Z, d->J);
    fill(&d->inertia[Y_CAGE_V_X], 6, p->cage.m);
    fill(&d->inertia[Y_CAGE_BETA_DOT], 4, d->J_t);
    fill(&d->inertia[Y_CAGE_S], 2, d->J_p);
}

void model_derive(const Parameters *p, Derived *d)
{
    memset(d, 0, sizeof *d);
    derive_balls(p, d);
    derive_pockets(p, d);
    (d->spheres.on ? spheres_squeeze_derive : pocket_squeeze_derive)(p, d);
    derive_cage(p, d);
    derive_lands(p, d);
    derive_relative(p, d);
    derive_joint(p, d);
    derive_scales(p, d);
    derive_inertia(p, d);
}

void work_init(const Derived *d, Work *w)
{
    memset(w, 0, sizeof *w);
    for (int j = 0; j < LANES; j++) w->r[j] = 0.5 * (d->inner.R_g + d->outer.R_g);
}
