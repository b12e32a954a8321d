"""Read from one evaluation or recorded over accepted steps: outputs, events, energy, statistics, fatigue."""
