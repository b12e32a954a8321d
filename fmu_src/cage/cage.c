// Functions of cage.h for an evaluation and for a step of the default method: each calls the code of rigid or of
// elastic halves (cage_setup.c and cage_read.c have the other functions of cage.h).
#include "cage/cage.h"

#include "cage/common/cage_joint.h"
#include "cage/common/halves.h"
#include "cage/common/pocket.h"
#include "cage/common/pocket_spheres.h"
#include "cage/elastic/cage_elastic.h"

void cage_kinematics(const Model *model, const scalar *y, Work *w)
{
    halves_kinematics(model, y, w);
    if (model->modes) cage_elastic_kinematics(model, y, w);
}

void cage_pockets(const Model *model, Work *w)
{
    if (model->d->spheres.on)
        (model->modes ? spheres_elastic : spheres_rigid)(model, w);
    else
        (model->modes ? pocket_elastic : pocket_rigid)(model, w);
}

void cage_joints(const Model *model, const scalar *y, Work *w)
{
    cage_joint_kinematics(model, w);
    (model->modes ? cage_elastic_joints : two_half_joints)(model, y, w);
}

// Trial deflections follow the joints, heads the plates' slip alone.
static void friction_rates(const scalar *v_y, const scalar *v_z, scalar *y_dot)
{
    memcpy(&y_dot[Y_JOINT_PLATE_Y], v_y, Z * sizeof *y_dot);
    memcpy(&y_dot[Y_JOINT_PLATE_Z], v_z, Z * sizeof *y_dot);
    for (int k = 0; k < Z; k++) y_dot[Y_JOINT_HEAD_Y + k] = y_dot[Y_JOINT_HEAD_Z + k] = 0.0;
}

void cage_acceleration(const Model *model, const scalar *y, Work *w, scalar *y_dot)
{
    halves_acceleration(model, y, w, y_dot);
    if (model->modes) {
        friction_rates(w->cage.elastic.joints.v_y, w->cage.elastic.joints.v_z, y_dot);
        cage_elastic_acceleration(model, y, w, y_dot);
    } else
        friction_rates(w->v_jy, w->v_jz, y_dot);
}

void cage_loads(const Model *model, const Work *w, JointLoads *load)
{
    (model->modes ? cage_elastic_rivets : two_half_loads)(model, w, load);
}

#ifndef DUAL
void cage_split(const Model *model, const double *y, const Work *w, double *f, CageMemory *memory)
{
    memory->elastic.fast.omega_2 = cage_elastic_speed_2(w);
    pocket_films_split(model, w, &memory->halves.pockets);
    if (model->modes) elastic_split(model, y, w, f, &memory->elastic);
}

void cage_begin(const Model *model, double h, const StepFrom *from, const CageMemory *memory,
                const double *middle, double *y, CageStep *step, Work *w)
{
    if (model->modes)
        elastic_begin(model, h, from, &memory->halves, &memory->elastic, middle, y, &step->halves,
                      &step->elastic, w);
    else
        two_half_begin(model, h, from, &memory->halves, middle, y, &step->halves, w);
}

double cage_end(const Model *model, CageStep *step, const StepFrom *from, const CageMemory *before,
                const StepTo *to, CageMemory *memory, Work *w)
{
    memory->elastic.fast.omega_2 = cage_elastic_speed_2(w);
    pocket_films_split(model, w, &memory->halves.pockets);
    if (model->modes)
        return elastic_end(model, &step->halves, &step->elastic, from, &before->halves, &before->elastic, to,
                           &memory->halves, &memory->elastic, w);
    memset(to->balls, 0, BALL_MOTIONS * sizeof *to->balls);
    two_half_end(model, &step->halves, from, &before->halves, to, &memory->halves, w);
    return 0.0;
}

void cage_slide(const Model *model, const double *before, double *y, Work *w)
{
    JointStep joints = {0};
    memcpy(joints.before, &before[Y_JOINT_PLATE_Y], sizeof joints.before);
    (model->modes ? elastic_slide : two_half_slide)(model, y, &joints, w);
}
#endif
