// Limits between parameters.  Written by fmus/generate.py from {{ source }}: do not edit.
// clang-format off
#include "numbers/variable_table.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
{% if table.limits %}

// Reports the message of a limit that does not hold.
static bool broken(Report report, void *context, const char *format, ...)
{
    char message[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    report(context, message);
    return false;
}

// A margin that is not a number does not hold either.
bool limits_hold(const Parameters *p, const char *quantity, Report report, void *context)
{
    static const double PI = 3.14159265358979323846;
    bool fine = true;
    double value, bound;
{% for limit in table.limits if limit.at != "build" %}
    if ((!quantity || strcmp(quantity, "{{ limit.quantity }}") == 0){% if limit.when and not limit.is_array %} && ({{ limit.written("when", "C") }}){% endif %})
{% if limit.is_array %}
    for (int j = 0; j < Z; j++)
{% endif %}
    {
        value = {{ limit.written("value", "C") }};
        bound = {{ limit.written("bound", "C") }};
        if (
{%- if limit.is_array and limit.when %}({{ limit.written("when", "C") }}) && {% endif %}
{% if limit.zero %}value != 0.0 && {% endif %}
{% if limit.sign == "==" %}!(fabs(value - bound) <= {{ limit.rounding }} * fabs(bound))
{%- elif limit.rounding %}!(value {{ limit.sign }} bound {{ "+" if "<" in limit.sign else "-" }} {{ limit.rounding }} * fabs(bound))
{%- else %}!(value {{ limit.sign }} bound)
{%- endif %})
            fine = broken(report, context, {{ limit.c_format | quoted }}, {{ limit.c_arguments }});
    }
{% endfor %}
    return fine;
}
{% endif %}
