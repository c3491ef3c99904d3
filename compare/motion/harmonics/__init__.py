"""The harmonics of a motion: what each multiple of the fundamental holds, how it is tracked, and what sampling folds.

Knows the trajectory and the clock of its crossings; an estimate's track is used only to lock to.
"""
