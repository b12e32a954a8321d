// Processor time by POSIX or by Windows.  Windows counts in ticks of some milliseconds, so that only the mean
// over many steps is right.
#define _POSIX_C_SOURCE 199309L
#include "numbers/cpu_clock.h"

#if defined(_WIN32)
#include <windows.h>

static double seconds(FILETIME time)
{
    return 1e-7 * (4294967296.0 * time.dwHighDateTime + time.dwLowDateTime);
}

double cpu_clock(void)
{
    FILETIME created, ended, kernel, user;
    if (!GetThreadTimes(GetCurrentThread(), &created, &ended, &kernel, &user)) return 0.0;
    return seconds(kernel) + seconds(user);
}
#else
#include <time.h>

#if defined(__wasm__)  // a browser knows no processor time
#define CLOCK CLOCK_MONOTONIC
#else
#define CLOCK CLOCK_THREAD_CPUTIME_ID
#endif

double cpu_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
#endif
