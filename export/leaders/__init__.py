"""Leaders that are composed, not recorded: steps in counts, feet by their steps, the body by inverse kinematics."""
