"""A small cage half put together from its pitches, in the place of waves of one pitch."""

import numpy as np
import scipy.sparse as sp

from rivet_model.geometry import Geometry

# few pitches for models of the whole half
SMALL = Geometry(Z=6, d_m=40e-3, cage_outer_diameter=46e-3, cage_inner_diameter=36.2e-3)


def whole(elastic):
    """Matrices [Z] that put the displacements and loads of the pitches, each in its own frame, together to those of the
    whole half.
    """
    Z, x, member = elastic.Z, elastic.x, []
    for k in range(Z):
        c, s = np.cos(2 * np.pi * k / Z), np.sin(2 * np.pi * k / Z)
        member.append(
            np.stack([1e8 * x[0], 1e8 * (c * x[1] - s * x[2]), 1e8 * (s * x[1] + c * x[2]), elastic.component])
        )
    _, member = np.unique(np.round(np.concatenate(member, axis=1)).astype(np.int64), axis=1, return_inverse=True)
    member, matrices = member.ravel().reshape(Z, -1), []
    assert member.max() + 1 < 0.99 * member.size, "neighbours meet"
    for k in range(Z):
        c, s = np.cos(2 * np.pi * k / Z), np.sin(2 * np.pi * k / Z)
        # dofs of a node follow each other
        turn = sp.block_diag([np.array([[1, 0, 0], [0, c, -s], [0, s, c]])] * (x.shape[1] // 3), format="csr")
        matrices.append(
            sp.csr_matrix(
                (np.ones(x.shape[1]), (member[k], np.arange(x.shape[1]))), shape=(member.max() + 1, x.shape[1])
            )
            @ turn
        )
    return matrices
