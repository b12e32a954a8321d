// A stack of blocks: freeing the block allocated last makes its memory available again; freeing the stack frees all.
#include "numbers/reserved_memory.h"

#include <stdint.h>
#include <string.h>

#undef malloc
#undef calloc
#undef free

enum { ALIGNMENT = 64 };  // a cache line

static _Thread_local ReservedMemory *in_use;

void reserved_memory_use(ReservedMemory *memory)
{
    in_use = memory;
}

static size_t rounded(size_t size)
{
    return (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

// Before each block stands its size.
void *reserved_malloc(size_t size)
{
    ReservedMemory *m = in_use;
    if (m == NULL || size > m->size || ALIGNMENT + rounded(size) > m->size - m->used) return malloc(size);
    unsigned char *block = m->bytes + m->used + ALIGNMENT;
    const size_t room = rounded(size);
    memcpy(block - ALIGNMENT, &room, sizeof room);
    m->used += ALIGNMENT + room;
    return block;
}

void *reserved_calloc(size_t n, size_t size)
{
    if (size > 0 && n > SIZE_MAX / size) return NULL;
    void *block = reserved_malloc(n * size);
    if (block != NULL) memset(block, 0, n * size);
    return block;
}

void reserved_free(void *memory)
{
    ReservedMemory *m = in_use;
    const uintptr_t at = (uintptr_t)memory, first = m != NULL ? (uintptr_t)m->bytes : 0;
    if (m == NULL || at < first || at >= first + m->size) {
        free(memory);
        return;
    }
    size_t room;
    memcpy(&room, (unsigned char *)memory - ALIGNMENT, sizeof room);
    if ((unsigned char *)memory + room == m->bytes + m->used) m->used -= ALIGNMENT + room;
}
