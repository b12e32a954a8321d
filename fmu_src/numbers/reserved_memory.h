// Memory for SUNDIALS: a block that stands ready before SUNDIALS is called, so that none of its allocations fails.
//
// SUNDIALS 7.1.1 does not survive a refused allocation: 35 of the 81 that an instance made when it was
// created ended in a crash (each refused in turn). Its functions have no argument for a source of memory, so
// the block in use is a property of the calling thread.  This header stands at the end of sundials_config.h,
// which every file of SUNDIALS includes: their calls of malloc and free come here.
#pragma once

#include <stddef.h>
#include <stdlib.h>

typedef struct {
    unsigned char *bytes;  // aligned for any type
    size_t size, used;
} ReservedMemory;

// The block from which this thread's allocations are served from here on; NULL, or a block that is full: by the system.
void reserved_memory_use(ReservedMemory *memory);

void *reserved_malloc(size_t size);
void *reserved_calloc(size_t n, size_t size);
void reserved_free(void *memory);

#define malloc(size) reserved_malloc(size)
#define calloc(n, size) reserved_calloc(n, size)
#define free reserved_free  // without an argument: SUNDIALS has members of this name too
