// Processor time.
#pragma once

// Processor time of this thread [s]; the time of other threads does not count.
double cpu_clock(void);
