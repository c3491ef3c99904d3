"""Ridgeback: the ridge of a time-frequency distribution against the backbone of perturbation theory."""
