// What tells one build of the FMU from another.  The text is written by fmus/build_info.py while the FMU is built.
#pragma once

extern const char BUILD_DIGEST[];  // SHA-256 of all sources that make the FMU, in hexadecimal digits
