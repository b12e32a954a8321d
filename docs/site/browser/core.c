// The bearing as the worker of the browser's page calls it: one instance, its variables by their names.
//
// The worker writes a variable's name into page_name() and asks for the variable's address and group once; from there on
// the worker reads and writes the numbers in place.  Numbers are doubles; integers and enumerations are 32-bit integers.
#include "instance/part.h"

#include <stdio.h>
#include <string.h>

#define EXPORT(name) __attribute__((export_name(#name)))

static Part *part;
static char name[64], messages[4096];

// Adds an error or a warning to the text that the worker has not read yet; what does not fit is cut off.
static void add_message(void *environment, LogCategory category, const char *message)
{
    (void)environment;
    if (category != LOG_ERROR && category != LOG_WARNING) return;
    const size_t used = strlen(messages);
    snprintf(messages + used, sizeof messages - used, "%s\n", message);
}

EXPORT(page_create) int page_create(void)
{
    const PartHost host = {NULL, add_message};
    part = part_create(&host);
    return part != NULL;
}

EXPORT(page_name) char *page_name(void)
{
    return name;
}

// Errors and warnings since the worker set the first byte to 0.
EXPORT(page_messages) char *page_messages(void)
{
    return messages;
}

// Where the first element of the named variable stands, of an input its derivative of this order; NULL if there is no such variable.
EXPORT(page_address) void *page_address(int order)
{
    const Variable *variable = variable_named(name);
    if (variable == NULL || order < 0 || order > INPUT_ORDERS) return NULL;
    switch (variable->causality) {
    case CAUSALITY_INPUT: return (char *)part_inputs(part, order) + variable->offset;
    case CAUSALITY_PARAMETER: return (char *)part_parameters(part) + variable->offset;
    case CAUSALITY_OUTPUT:
    case CAUSALITY_LOCAL: return (char *)part_outputs(part) + variable->offset;
    case CAUSALITY_INDEPENDENT: break;
    }
    return NULL;
}

EXPORT(page_group) int page_group(void)
{
    const Variable *variable = variable_named(name);
    return variable != NULL ? (int)variable->group : -1;
}

EXPORT(page_reset) void page_reset(void)
{
    part_reset(part);
}

EXPORT(page_initialize) int page_initialize(void)
{
    return part_initialize(part, 0.0, 0.0);
}

EXPORT(page_step) int page_step(double t_end)
{
    return part_step(part, t_end);
}

EXPORT(page_update) void page_update(int group)
{
    part_update(part, (OutputGroup)group);
}
