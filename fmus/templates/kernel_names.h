// Names of the kernel files' functions with a suffix for each instruction set.  Written by fmus/generate.py from the kernel files: do not edit.
// clang-format off
#pragma once

{% for name in kernel_functions %}
#define {{ name }} FOR_ISA({{ name }})
{% endfor %}
