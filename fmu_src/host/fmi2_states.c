// Saved states: one block of bytes, in memory as in a file (FMI 2.0.4, section 2.1.8).
#include "host/build_info.h"
#include "host/fmi2_instance.h"
#include "numbers/saved_numbers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    char magic[8];
    uint64_t version;   // of this layout
    char guid[40];      // of the model
    char build[72];     // digest of the sources
    char data[72];      // digest of data built in
    uint64_t size;      // of the whole block
    uint64_t checksum;  // of all that follows the header
} BlobHeader;

static const char BLOB_MAGIC[8] = "RBstate";

enum { BLOB_VERSION = 5 };

static size_t blob_size(void)
{
    return (sizeof(BlobHeader) + sizeof(Session) + part_saved_size() + 7) / 8 * 8;
}

// 64 bits, eight bytes at a time: each step is a permutation of the hash, so a change of any single word changes it.
static uint64_t blob_checksum(const unsigned char *blob)
{
    uint64_t hash = 0xcbf29ce484222325u, word;
    for (size_t i = sizeof(BlobHeader); i + sizeof word <= blob_size(); i += sizeof word) {
        memcpy(&word, blob + i, sizeof word);
        hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

// The header of this model's states, the checksum left out.
static BlobHeader blob_header(void)
{
    BlobHeader header = {.version = BLOB_VERSION, .guid = MODEL_GUID, .size = blob_size()};
    memcpy(header.magic, BLOB_MAGIC, sizeof header.magic);
    snprintf(header.build, sizeof header.build, "%s", BUILD_DIGEST);
    snprintf(header.data, sizeof header.data, "%s", part_data_digest());
    return header;
}

// Why a block is not a state of this model; NULL if it is.
static const char *blob_problem(const unsigned char *blob, size_t size, bool checked)
{
    const BlobHeader ours = blob_header();
    BlobHeader header;
    if (size < sizeof header) return "the saved state is truncated";
    memcpy(&header, blob, sizeof header);
    if (memcmp(header.magic, BLOB_MAGIC, sizeof header.magic) != 0)
        return "this is not a saved state of a " MODEL_IDENTIFIER;
    if (header.version != BLOB_VERSION) return "the saved state is of another version of this FMU";
    if (memcmp(header.guid, ours.guid, sizeof header.guid) != 0)
        return "the saved state is of another model (its GUID is not " MODEL_GUID ")";
    if (memcmp(header.data, ours.data, sizeof header.data) != 0)
        return "the saved state is of an FMU with other data built in (of a bearing: another rivet table)";
    if (memcmp(header.build, ours.build, sizeof header.build) != 0)
        return "the saved state is of an FMU that was built from other sources";
    if (header.size != ours.size) return "the saved state has another size than this FMU's";
    if (size != header.size) return "the saved state is truncated or too long";
    if (checked && header.checksum != blob_checksum(blob))
        return "the saved state is corrupted (its checksum is wrong)";
    return NULL;
}

enum { REASON = 300 };

// The messages about a state that is tried go into a text of this size: the last one is the reason.
static void keep_reason(void *reason, LogCategory category, const char *message)
{
    if (category == LOG_ERROR) snprintf(reason, REASON, "the saved state cannot be restored: %s", message);
}

// Why this cannot be the session of a part at this time; NULL if it can.
static const char *session_problem(const Session *s, const Part *part)
{
    const Variable *tolerance = variable_named("solver.tol");
    const double time = part_time(part),
                 slack = clock_rounding(s, time, 0.0) + 1e-6 * (1.0 + time - s->start_time);
    if (!(s->phase == INSTANTIATED || s->phase == INITIALIZING || s->phase == STEPPING ||
          s->phase == FAILED || s->phase == TERMINATED || s->phase == ERRONEOUS))
        return "there is no such phase";
    if (s->initialized > 1 || (s->initialized && (s->phase == INSTANTIATED || !part_is_initialized(part))))
        return "phase and part do not belong together";
    if (s->phase & (STEPPING | FAILED | TERMINATED) && !part_is_initialized(part))
        return "it has this phase without a start";
    if (!values_are_within(&s->start_time, 1, LARGEST_TIME) || !(s->stop_time >= s->start_time))
        return "start and stop time are not in order";
    if (s->phase & (STEPPING | FAILED | TERMINATED) &&
        !(time >= s->start_time && time <= s->stop_time + slack))
        return "its time is not between start and stop";
    if (s->tolerance != 0.0 &&
        !(tolerance && s->tolerance >= tolerance->min && s->tolerance <= tolerance->max))
        return "its tolerance is out of range";
    if (s->step_status > fmi2Error) return "there is no such status of a step";
    return NULL;
}

// Whether a block of this model, from outside, holds a state from which an instance can go on: tried on a part of its own.
static bool blob_can_be_restored(const unsigned char *blob, char reason[REASON])
{
    const PartHost listener = {reason, keep_reason};
    Session session;
    memcpy(&session, blob + sizeof(BlobHeader), sizeof session);
    snprintf(reason, REASON, "out of memory");
    Part *part = part_create(&listener);
    if (!part) return false;
    bool fine = part_restore_unknown(part, blob + sizeof(BlobHeader) + sizeof session);
    const char *problem = fine ? session_problem(&session, part) : NULL;
    if (problem) keep_reason(reason, LOG_ERROR, problem);
    part_destroy(part);
    return fine && !problem;
}

fmi2Status slave_GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    Instance *m = c;
    if (!state) return refuse(m, "a null pointer for the state");
    unsigned char *blob = *state ? *state : calloc(1, blob_size());
    if (!blob) return refuse(m, "out of memory");
    const BlobHeader header = blob_header();
    memcpy(blob, &header, sizeof header);
    memcpy(blob + sizeof header, &m->session, sizeof m->session);
    part_save(m->part, blob + sizeof header + sizeof m->session);
    *state = blob;
    return fmi2OK;
}

fmi2Status slave_SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    Instance *m = c;
    const unsigned char *blob = state;
    const char *problem = blob ? blob_problem(blob, blob_size(), false) : "a null pointer for the state";
    if (problem) return refuse(m, "%s", problem);
    memcpy(&m->session, blob + sizeof(BlobHeader), sizeof m->session);
    part_restore(m->part, blob + sizeof(BlobHeader) + sizeof m->session);
    return fmi2OK;
}

fmi2Status slave_FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    (void)c;
    if (!state) return fmi2OK;
    free(*state);
    *state = NULL;
    return fmi2OK;
}

fmi2Status slave_SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    Instance *m = c;
    if (!state || !size) return refuse(m, "a null pointer");
    *size = blob_size();
    return fmi2OK;
}

fmi2Status slave_SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    Instance *m = c;
    if (!state || !bytes) return refuse(m, "a null pointer");
    if (size < blob_size())
        return refuse(m, "size = %zu is not allowed: the state has %zu bytes", size, blob_size());
    BlobHeader header;
    memcpy(&header, state, sizeof header);
    header.checksum = blob_checksum(state);
    memcpy(bytes, &header, sizeof header);
    memcpy(bytes + sizeof header, (const unsigned char *)state + sizeof header, blob_size() - sizeof header);
    return fmi2OK;
}

fmi2Status slave_DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                     fmi2FMUstate *state)
{
    Instance *m = c;
    if (!bytes || !state) return refuse(m, "a null pointer");
    const char *problem = blob_problem((const unsigned char *)bytes, size, true);
    if (problem) return refuse(m, "%s", problem);
    char reason[REASON];
    if (!blob_can_be_restored((const unsigned char *)bytes, reason)) return refuse(m, "%s", reason);
    if (!*state) *state = calloc(1, blob_size());
    if (!*state) return refuse(m, "out of memory");
    memcpy(*state, bytes, blob_size());
    return fmi2OK;
}
