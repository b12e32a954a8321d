// Messages of an instance to its host.
#include "instance/log.h"

#include <stdarg.h>
#include <stdio.h>

void bearing_log(Bearing *b, LogCategory category, const char *format, ...)
{
    if (b->host.log == NULL) return;
    char message[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    b->host.log(b->host.environment, category, message);
}
