// Compiled once per instruction set, like the kernels.
#include "kernel_loops.h"

#include "cage/cage.h"
#include "cage/common/cage_joint.h"
#include "physics/ball.h"
#include "physics/drag.h"
#include "physics/land_film.h"
#include "physics/race_contact.h"
#include "physics/ring.h"

#include <time.h>

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

double rhs_time(const Model *model, int n, const double *y, int rounds, Work *w)
{
    double y_dot[N_STATES];
    const double begin = now();
    for (int round = 0; round < rounds; round++)
        for (int i = 0; i < n; i++) rhs(model, 0.0, &y[i * N_STATES], y_dot, w);
    return (now() - begin) / ((double)rounds * n);
}

#define TIME(index, call)                                         \
    begin = now();                                                \
    for (int round = 0; round < rounds; round++) {                \
        call;                                                     \
        __asm__ volatile("" ::: "memory"); /* each call counts */ \
    }                                                             \
    ns[index] = (now() - begin) / rounds

// In the order of rhs.c and of ELEMENT_NAMES in rhs.py.  Forces that are added pile up: times do not depend
// on them.
void element_times(const Model *model, const double *y, int rounds, Work *w, double ns[ELEMENTS])
{
    double y_dot[N_STATES], begin;
    rhs(model, 0.0, y, y_dot, w);
    TIME(0, ball_kinematics(y, w));
    TIME(1, race_contact_force(model, w));
    TIME(2, cage_pockets(model, w));
    TIME(3, drag_force(model, w));
    TIME(4, land_film_force(model, w));
    TIME(5, drag_cage(model, w));
    TIME(6, cage_joint_kinematics(model, w));
    TIME(7, two_half_joints(model, y, w));
    TIME(8, ball_acceleration(model, w, y_dot));
    TIME(9, ring_acceleration(model, w, y_dot));
}

// A packet that stays in a register: gcc keeps packets of one in memory.
#if LANE_WIDTH == 1
typedef double chain;
#define CHAIN_ROOT sqrt
#else
typedef wide chain;
#define CHAIN_ROOT wide_sqrt
#endif

// A loaded value has to be in a vector register here.
#if defined(__x86_64__)
#define USE(value) __asm__ volatile("" ::"x"(value) : "memory")
#else
#define USE(value) __asm__ volatile("" ::"w"(value) : "memory")
#endif

// `CHAINS` independent instructions in each round.
enum { CHAINS = 12 };

#define PEAK(index, count, operation)                                        \
    begin = now();                                                           \
    for (long round = 0; round < rounds; round++) {                          \
        _Pragma("GCC unroll 12") for (int i = 0; i < CHAINS; i++) operation; \
    }                                                                        \
    ns[index] = (now() - begin) / ((double)rounds * CHAINS * (count));       \
    for (int i = 0; i < CHAINS; i++) memcpy(&sink[i * LANE_WIDTH], &x[i], sizeof x[i])

void peak_times(long rounds, double ns[PEAKS])
{
    _Alignas(64) double memory[CHAINS * LANE_WIDTH], sink[CHAINS * LANE_WIDTH];
    const double near_one = 1.0 - 1e-9, small = 1e-9;
    chain x[CHAINS];
    double begin;
    for (int i = 0; i < CHAINS * LANE_WIDTH; i++) memory[i] = 1e-9 * i;
    for (int i = 0; i < CHAINS; i++) x[i] = (1.0 + i) - (chain){0};
    PEAK(PEAK_ARITHMETIC, 2, x[i] = x[i] * near_one + small);
    PEAK(PEAK_LOAD, 1, USE(*(const chain *)&memory[i * LANE_WIDTH]));
    PEAK(PEAK_DIVIDE, 1, x[i] = near_one / x[i]);
    PEAK(PEAK_ROOT, 1, x[i] = CHAIN_ROOT(x[i]));
    __asm__ volatile("" ::"r"(sink) : "memory");
}
