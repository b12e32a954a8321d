// Instructions of a call, by single steps of a child process (Linux).
#include "trace.h"
#include "physics/rhs.h"

#include <signal.h>
#include <sys/ptrace.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

typedef void Action(void *context);

static long trace(Action *action, void *context, unsigned long *address, long max_count)
{
    const pid_t child = fork();
    if (child < 0) return -1;
    if (child == 0) {
        ptrace(PTRACE_TRACEME, 0, NULL, NULL);
        raise(SIGSTOP);
        action(context);
        _exit(0);
    }
    int status;
    long count = 0;
    waitpid(child, &status, 0);
    while (WIFSTOPPED(status) && count < max_count) {
        struct user_regs_struct registers;
        if (ptrace(PTRACE_GETREGS, child, NULL, &registers) != 0) break;
#if defined(__x86_64__)
        // A string instruction stops the child at each of its repetitions.
        if (count == 0 || address[count - 1] != registers.rip) address[count++] = registers.rip;
#endif
        if (ptrace(PTRACE_SINGLESTEP, child, NULL, NULL) != 0) break;
        waitpid(child, &status, 0);
    }
    if (WIFEXITED(status)) return count;
    kill(child, SIGKILL), waitpid(child, &status, 0);
    return -1;
}

typedef struct {
    Rhs *function;
    const Model *model;
    const double *y;
    Work *w;
} Evaluation;

static void call_rhs(void *context)
{
    const Evaluation *e = context;
    double y_dot[N_STATES];
    e->function(e->model, 0.0, e->y, y_dot, e->w);
}

long trace_rhs(Rhs *function, const Model *model, const double *y, Work *w, unsigned long *address,
               long max_count)
{
    Evaluation e = {function, model, y, w};
    call_rhs(&e);  // symbols bound, memory touched
    return trace(call_rhs, &e, address, max_count);
}

typedef struct {
    Part *part;
    double t;
} Step;

static void call_step(void *context)
{
    const Step *s = context;
    part_step(s->part, s->t);
}

long trace_step(Part *part, double t, unsigned long *address, long max_count)
{
    Step s = {part, t};
    return trace(call_step, &s, address, max_count);
}
