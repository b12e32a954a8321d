// Counts instructions of one evaluation of the right-hand side by single steps of a child process (Linux).
#include "trace.h"
#include "rhs.h"

#include <signal.h>
#include <sys/ptrace.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

long trace_rhs(Rhs *function, const Model *model, const double *y, Work *w, unsigned long *address, long most)
{
    double y_dot[N_STATES];
    function(model, 0.0, y, y_dot, w);  // symbols bound, memory touched
    const pid_t child = fork();
    if (child < 0) return -1;
    if (child == 0) {
        ptrace(PTRACE_TRACEME, 0, NULL, NULL);
        raise(SIGSTOP);
        function(model, 0.0, y, y_dot, w);
        _exit(0);
    }
    int status;
    long count = 0;
    waitpid(child, &status, 0);
    while (WIFSTOPPED(status) && count < most) {
        struct user_regs_struct registers;
        if (ptrace(PTRACE_GETREGS, child, NULL, &registers) != 0) break;
#if defined(__x86_64__)
        address[count++] = registers.rip;
#endif
        if (ptrace(PTRACE_SINGLESTEP, child, NULL, NULL) != 0) break;
        waitpid(child, &status, 0);
    }
    if (!WIFEXITED(status)) kill(child, SIGKILL), waitpid(child, &status, 0);
    return count;
}
