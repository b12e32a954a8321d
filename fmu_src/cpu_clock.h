// Processor time.
#pragma once

// Processor time of this thread [s]: what other threads do meanwhile does not count.
double cpu_clock(void);
