// Messages of an instance to its host.
#pragma once

#include "instance/instance.h"

// Sends a message to the host, formatted as by printf.
void bearing_log(Bearing *b, LogCategory category, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
