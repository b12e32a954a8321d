// A host in plain C that runs the FMU against the clock: a load and a speed that change at every step, outputs read at
// every step, each step due at a fixed time.
//
//     cc -O2 -I$(python -c "import fmpy, os; print(os.path.dirname(fmpy.__file__))")/c-code host.c -ldl -lm -o host
//     ./host FOLDER [--step 1e-4] [--seconds 60] [--set NAME=VALUE]...        FOLDER: the unpacked FMU
//
// First an empty loop shows the machine's own lateness; then the FMU runs.  A step is late when its work ends after the
// time at which the next one is due.  SCHED_FIFO and locked memory are used where the system allows them.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fmi2FunctionTypes.h>
#include <math.h>
#include <sched.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>
#ifdef __linux__
#include <linux/perf_event.h>
#include <sys/syscall.h>
#endif

enum { BINS = 24 };  // of half an octave each, from a sixteenth of a step on

typedef struct {
    void *library;
    char *description;  // modelDescription.xml
    fmi2Component instance;
    fmi2SetRealTYPE *set_real;
    fmi2SetIntegerTYPE *set_integer;
    fmi2GetRealTYPE *get_real;
    fmi2DoStepTYPE *do_step;
} Unit;

// Times of all steps of one loop.
typedef struct {
    long steps, late, histogram[BINS];
    double worst, sum, latest_start;  // [s]; how late the loop itself began a step
    unsigned long long instructions, most_instructions;
} Record;

static void stop(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
    exit(1);
}

// ---- the duty ---------------------------------------------------------------------------------------------
// A run-up from half speed within a second [rad/s].
static double speed(double t)
{
    return 1909.9 * (0.5 + 0.5 * fmin(t, 1.0));
}

// A load that swings as beside a gear, in parts of its mean.
static double load_factor(double t)
{
    return 1.0 + 0.1 * sin(2.0 * M_PI * 700.0 * t);
}

// ---- the unit ---------------------------------------------------------------------------------------------
static void log_message(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                        fmi2String category, fmi2String message, ...)
{
    (void)environment, (void)name, (void)category;
    if (status > fmi2Warning) fprintf(stderr, "%s\n", message);
}

static char *read_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) stop("%s: %s", path, strerror(errno));
    fseek(file, 0, SEEK_END);
    const long size = ftell(file);
    rewind(file);
    char *text = calloc((size_t)size + 1, 1);
    if (text == NULL || fread(text, 1, (size_t)size, file) != (size_t)size) stop("%s: cannot be read", path);
    fclose(file);
    return text;
}

// The value of an attribute in the XML from `at` on.
static const char *attribute(const char *at, const char *name, char *value, size_t size)
{
    char wanted[64];
    snprintf(wanted, sizeof wanted, " %s=\"", name);
    const char *begin = at ? strstr(at, wanted) : NULL;
    if (begin == NULL) stop("modelDescription.xml has no %s", name);
    begin += strlen(wanted);
    const size_t length = strcspn(begin, "\"");
    if (length >= size) stop("modelDescription.xml: %s is too long", name);
    memcpy(value, begin, length);
    value[length] = 0;
    return begin;
}

static const char *variable(const Unit *unit, const char *name)
{
    char wanted[128];
    snprintf(wanted, sizeof wanted, "<ScalarVariable name=\"%s\"", name);
    const char *at = strstr(unit->description, wanted);
    if (at == NULL) stop("%s is no variable of the FMU", name);
    return at;
}

static fmi2ValueReference reference(const Unit *unit, const char *name)
{
    char value[32];
    attribute(variable(unit, name), "valueReference", value, sizeof value);
    return (fmi2ValueReference)strtoul(value, NULL, 10);
}

static void *function(const Unit *unit, const char *name)
{
    void *found = dlsym(unit->library, name);
    if (found == NULL) stop("%s: not in the FMU", name);
    return found;
}

static void set(const Unit *unit, const char *name, double value)
{
    const fmi2ValueReference vr = reference(unit, name);
    const char *at = variable(unit, name), *end = strstr(at, "</ScalarVariable>"),
               *real = strstr(at, "<Real");
    const fmi2Integer number = (fmi2Integer)lround(value);
    const fmi2Status status = real && real < end ? unit->set_real(unit->instance, &vr, 1, &value)
                                                 : unit->set_integer(unit->instance, &vr, 1, &number);
    if (status > fmi2Warning) stop("%s = %g is refused", name, value);
}

static Unit load(const char *folder, int settings, char **setting)
{
    static const fmi2CallbackFunctions callbacks = {log_message, calloc, free, NULL, NULL};
    char path[4096], guid[128], identifier[128];
    Unit unit = {0};
    snprintf(path, sizeof path, "%s/modelDescription.xml", folder);
    unit.description = read_file(path);
    attribute(unit.description, "guid", guid, sizeof guid);
    attribute(strstr(unit.description, "<CoSimulation"), "modelIdentifier", identifier, sizeof identifier);
    snprintf(path, sizeof path, "%s/binaries/linux64/%s.so", folder, identifier);
    unit.library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (unit.library == NULL) stop("%s", dlerror());
    fmi2InstantiateTYPE *instantiate = (fmi2InstantiateTYPE *)function(&unit, "fmi2Instantiate");
    fmi2SetupExperimentTYPE *set_up = (fmi2SetupExperimentTYPE *)function(&unit, "fmi2SetupExperiment");
    fmi2EnterInitializationModeTYPE *enter =
        (fmi2EnterInitializationModeTYPE *)function(&unit, "fmi2EnterInitializationMode");
    fmi2ExitInitializationModeTYPE *leave =
        (fmi2ExitInitializationModeTYPE *)function(&unit, "fmi2ExitInitializationMode");
    unit.set_real = (fmi2SetRealTYPE *)function(&unit, "fmi2SetReal");
    unit.set_integer = (fmi2SetIntegerTYPE *)function(&unit, "fmi2SetInteger");
    unit.get_real = (fmi2GetRealTYPE *)function(&unit, "fmi2GetReal");
    unit.do_step = (fmi2DoStepTYPE *)function(&unit, "fmi2DoStep");
    snprintf(path, sizeof path, "file://%s/resources", folder);
    unit.instance = instantiate("real time", fmi2CoSimulation, guid, path, &callbacks, fmi2False, fmi2False);
    if (unit.instance == NULL) stop("the FMU gives no instance");
    set(&unit, "solver.method", 3.0);  // fixed
    set(&unit, "shaft.omega", speed(0.0));
    for (int i = 0; i < settings; i++) {
        char *equals = strchr(setting[i], '=');
        if (equals == NULL) stop("--set %s: NAME=VALUE is wanted", setting[i]);
        *equals = 0;
        set(&unit, setting[i], strtod(equals + 1, NULL));
    }
    if (set_up(unit.instance, fmi2False, 0.0, 0.0, fmi2False, 0.0) > fmi2Warning ||
        enter(unit.instance) > fmi2Warning || leave(unit.instance) > fmi2Warning)
        stop("the FMU cannot be initialized");
    return unit;
}

// ---- the clock --------------------------------------------------------------------------------------------
static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void sleep_until(double time)
{
    const struct timespec at = {(time_t)time, (long)(1e9 * (time - floor(time)))};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, NULL) == EINTR) {
    }
}

// Instructions of this thread; -1 where the system does not count them.
static int open_counter(void)
{
#ifdef __linux__
    struct perf_event_attr attr = {.type = PERF_TYPE_HARDWARE,
                                   .size = sizeof attr,
                                   .config = PERF_COUNT_HW_INSTRUCTIONS,
                                   .exclude_kernel = 1,
                                   .exclude_hv = 1};
    return (int)syscall(SYS_perf_event_open, &attr, 0, -1, -1, 0);
#else
    return -1;
#endif
}

static unsigned long long count(int counter)
{
    unsigned long long value = 0;
    if (counter >= 0 && read(counter, &value, sizeof value) != sizeof value) value = 0;
    return value;
}

static void become_urgent(void)
{
    const struct sched_param priority = {.sched_priority = 80};
    const int fifo = sched_setscheduler(0, SCHED_FIFO, &priority),
              locked = mlockall(MCL_CURRENT | MCL_FUTURE);
    printf("SCHED_FIFO %s, memory %s\n", fifo == 0 ? "on" : "not allowed",
           locked == 0 ? "locked" : "not locked");
}

// ---- the loop ---------------------------------------------------------------------------------------------
static void add(Record *record, double step, double took, double started_late,
                unsigned long long instructions)
{
    const int bin = took > 0.0 ? (int)floor(2.0 * log2(16.0 * took / step)) : 0;
    record->histogram[bin < 0 ? 0 : bin < BINS ? bin : BINS - 1]++;
    record->steps++;
    record->sum += took;
    record->worst = fmax(record->worst, took);
    record->latest_start = fmax(record->latest_start, started_late);
    record->instructions += instructions;
    if (instructions > record->most_instructions) record->most_instructions = instructions;
}

// Runs for some seconds; unit NULL: does nothing in its steps.
static Record run(const Unit *unit, double step, double seconds, int counter)
{
    enum { INPUTS = 3, OUTPUTS = 5 };

    static const char *IN[INPUTS] = {"shaft.omega", "shaft.F_y", "shaft.F_x"},
                      *OUT[OUTPUTS] = {"housing.F_y", "housing.F_x", "ring.y", "rivet.sigma_head_max",
                                       "cage.F_pocket_peak"};
    fmi2ValueReference in[INPUTS], out[OUTPUTS];
    for (int i = 0; unit && i < INPUTS; i++) in[i] = reference(unit, IN[i]);
    for (int i = 0; unit && i < OUTPUTS; i++) out[i] = reference(unit, OUT[i]);
    Record record = {0};
    const long steps = lround(seconds / step);
    double due = now() + step;
    for (long n = 0; n < steps; n++) {
        sleep_until(due);
        const double begin = now(), t = n * step;
        const unsigned long long before = count(counter);
        if (unit) {
            const double value[INPUTS] = {speed(t), 2994.0 * load_factor(t), 515.0 * load_factor(t)};
            double read_back[OUTPUTS];
            if (unit->set_real(unit->instance, in, INPUTS, value) > fmi2Warning ||
                unit->do_step(unit->instance, t, step, fmi2True) > fmi2Warning ||
                unit->get_real(unit->instance, out, OUTPUTS, read_back) > fmi2Warning)
                stop("step %ld at t = %g s has failed", n, t);
        }
        const unsigned long long instructions = count(counter) - before;
        const double end = now();
        due += step;
        if (end > due) record.late++;
        add(&record, step, end - begin, begin - (due - step), instructions);
        if (end > due) due = end;  // a late step moves the next ones: each is judged by itself
    }
    return record;
}

static void show(const char *title, const Record *record, double step)
{
    printf("\n%s: %ld steps, mean %.1f us, worst %.1f us of %.1f us, late %ld (%.3g %%), begun %.1f us late "
           "at most\n",
           title, record->steps, 1e6 * record->sum / record->steps, 1e6 * record->worst, 1e6 * step,
           record->late, 100.0 * record->late / record->steps, 1e6 * record->latest_start);
    if (record->instructions > 0) {
        const double mean = (double)record->instructions / record->steps;
        printf("instructions a step: mean %.0f, most %.2f times that\n", mean,
               record->most_instructions / mean);
    }
    long most = 1;
    for (int i = 0; i < BINS; i++) most = record->histogram[i] > most ? record->histogram[i] : most;
    for (int i = 0; i < BINS; i++) {
        if (record->histogram[i] == 0) continue;
        printf("  from %6.3f of a step  %9ld  ", exp2(0.5 * i) / 16.0, record->histogram[i]);
        const int bar = (int)ceil(50.0 * log1p((double)record->histogram[i]) / log1p((double)most));
        for (int k = 0; k < bar; k++) putchar('#');
        putchar('\n');
    }
}

int main(int argc, char **argv)
{
    double step = 1e-4, seconds = 60.0;
    char *settings[64];
    int count_of_settings = 0;
    const char *const usage = "usage: host FOLDER [--step 1e-4] [--seconds 60] [--set NAME=VALUE]...";
    if (argc < 2) stop("%s", usage);
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        puts(usage);
        return 0;
    }
    for (int i = 2; i < argc; i++) {
        if (i + 1 >= argc) stop("%s: a value is missing", argv[i]);
        if (strcmp(argv[i], "--step") == 0)
            step = strtod(argv[++i], NULL);
        else if (strcmp(argv[i], "--seconds") == 0)
            seconds = strtod(argv[++i], NULL);
        else if (strcmp(argv[i], "--set") == 0 && count_of_settings < 64)
            settings[count_of_settings++] = argv[++i];
        else
            stop("%s: unknown", argv[i]);
    }
    if (!(step > 0.0) || !(seconds >= step))
        stop("--step %g --seconds %g: a step above 0, no longer than the run", step, seconds);
    const double begin = now();
    const Unit unit = load(argv[1], count_of_settings, settings);
    printf("start of the unit: %.1f ms\n", 1e3 * (now() - begin));
    become_urgent();
    const int counter = open_counter();
    if (counter < 0) printf("instructions are not counted here\n");
    const Record empty = run(NULL, step, fmin(seconds, 5.0), counter);
    show("empty loop", &empty, step);
    const Record record = run(&unit, step, seconds, counter);
    show("FMU", &record, step);
    return 0;
}
