// Included before every C file on x86-64 with glibc: versions of functions that glibc 2.17 has, so that a binary runs on older
// systems than the one that compiled it.  exp, log and pow got new versions in 2.29, which differ in errno only.
__asm__(".symver exp,exp@GLIBC_2.2.5");
__asm__(".symver log,log@GLIBC_2.2.5");
__asm__(".symver pow,pow@GLIBC_2.2.5");
