// Vectors in the frames of the balls: three packets each.
#pragma once

#include "numbers/lanes.h"

// One vector for each ball of a packet, in the balls' own frames.
typedef struct {
    wide x, r, t;
} vec;

INLINE wide vec_dot(vec u, vec v)
{
    return wide_fma(u.t, v.t, wide_fma(u.r, v.r, u.x * v.x));
}

INLINE vec vec_cross(vec u, vec v)
{
    return (vec){wide_fma(u.r, v.t, -(u.t * v.r)), wide_fma(u.t, v.x, -(u.x * v.t)),
                 wide_fma(u.x, v.r, -(u.r * v.x))};
}

INLINE vec vec_add(vec u, vec v)
{
    return (vec){u.x + v.x, u.r + v.r, u.t + v.t};
}

INLINE vec vec_sub(vec u, vec v)
{
    return (vec){u.x - v.x, u.r - v.r, u.t - v.t};
}

INLINE vec vec_scale(wide k, vec v)
{
    return (vec){k * v.x, k * v.r, k * v.t};
}

// u + k v
INLINE vec vec_axpy(wide k, vec v, vec u)
{
    return (vec){wide_fma(k, v.x, u.x), wide_fma(k, v.r, u.r), wide_fma(k, v.t, u.t)};
}

// The part of v across the unit vector n.
INLINE vec vec_across(vec v, vec n)
{
    return vec_axpy(-vec_dot(v, n), n, v);
}

// Components of a vector of the global frame in the frames of balls at azimuth theta.
INLINE vec vec_local(const scalar global[3], wide cos_theta, wide sin_theta)
{
    const wide y = wide_set(global[1]), z = wide_set(global[2]);
    return (vec){wide_set(global[0]), wide_fma(y, cos_theta, z * sin_theta),
                 wide_fma(z, cos_theta, -(y * sin_theta))};
}

INLINE void vec_to_global(vec v, wide cos_theta, wide sin_theta, scalar *x, scalar *y, scalar *z)
{
    wide_store(x, v.x);
    wide_store(y, wide_fma(v.r, cos_theta, -(v.t * sin_theta)));
    wide_store(z, wide_fma(v.r, sin_theta, v.t * cos_theta));
}

INLINE vec vec_load(const scalar *x, const scalar *r, const scalar *t)
{
    return (vec){wide_load(x), wide_load(r), wide_load(t)};
}

// v where the condition holds, else -0, which changes no sum.
INLINE vec vec_where(bits condition, vec v)
{
    const wide none = wide_set(-0.0);
    return (vec){wide_select(condition, v.x, none), wide_select(condition, v.r, none),
                 wide_select(condition, v.t, none)};
}

INLINE void vec_store(vec v, scalar *x, scalar *r, scalar *t)
{
    wide_store(x, v.x);
    wide_store(r, v.r);
    wide_store(t, v.t);
}
