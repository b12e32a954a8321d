// Memory aligned for any lane width: C17's aligned_alloc; Windows' C library lacks this function and has its
// own.
#pragma once

#include <stdlib.h>

#if defined(_WIN32)
#include <malloc.h>

static inline void *aligned_new(size_t size)
{
    return _aligned_malloc(size, 64);
}

static inline void aligned_delete(void *memory)
{
    _aligned_free(memory);
}
#else
static inline void *aligned_new(size_t size)
{
    return aligned_alloc(64, (size + 63) / 64 * 64);
}

static inline void aligned_delete(void *memory)
{
    free(memory);
}
#endif
