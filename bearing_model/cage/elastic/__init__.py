"""Vibrating halves: modes, walls, joints, substeps."""
