// Digest that identifies a build of the FMU; fmus/build_info.py writes it while the FMU is built.
#pragma once

extern const char BUILD_DIGEST[];  // SHA-256 of all sources that make the FMU, in hexadecimal digits
