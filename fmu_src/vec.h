// Vectors of the balls' frames: three bundles.
#pragma once

#include "model.h"

INLINE real vec_dot(vec u, vec v)
{
    return real_fma(u.t, v.t, real_fma(u.r, v.r, u.x * v.x));
}
INLINE vec vec_cross(vec u, vec v)
{
    return (vec){real_fma(u.r, v.t, -(u.t * v.r)), real_fma(u.t, v.x, -(u.x * v.t)), real_fma(u.x, v.r, -(u.r * v.x))};
}
INLINE vec vec_add(vec u, vec v)
{
    return (vec){u.x + v.x, u.r + v.r, u.t + v.t};
}
INLINE vec vec_sub(vec u, vec v)
{
    return (vec){u.x - v.x, u.r - v.r, u.t - v.t};
}
INLINE vec vec_scale(real k, vec v)
{
    return (vec){k * v.x, k * v.r, k * v.t};
}
// u + k v
INLINE vec vec_axpy(real k, vec v, vec u)
{
    return (vec){real_fma(k, v.x, u.x), real_fma(k, v.r, u.r), real_fma(k, v.t, u.t)};
}
// The part of v across the unit vector n.
INLINE vec vec_across(vec v, vec n)
{
    return vec_axpy(-vec_dot(v, n), n, v);
}
// A vector of the global frame, seen from balls at azimuth theta.
INLINE vec vec_local(const number global[3], real cos_theta, real sin_theta)
{
    const real y = real_set(global[1]), z = real_set(global[2]);
    return (vec){real_set(global[0]), real_fma(y, cos_theta, z * sin_theta), real_fma(z, cos_theta, -(y * sin_theta))};
}
INLINE void vec_to_global(vec v, real cos_theta, real sin_theta, number *x, number *y, number *z)
{
    real_store(x, v.x);
    real_store(y, real_fma(v.r, cos_theta, -(v.t * sin_theta)));
    real_store(z, real_fma(v.r, sin_theta, v.t * cos_theta));
}
INLINE vec vec_load(const number *x, const number *r, const number *t)
{
    return (vec){real_load(x), real_load(r), real_load(t)};
}
INLINE void vec_store(vec v, number *x, number *r, number *t)
{
    real_store(x, v.x);
    real_store(r, v.r);
    real_store(t, v.t);
}
