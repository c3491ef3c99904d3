"""Where expansions and numbers meet: studies, comparisons along a motion, error budgets, identification.

The only room that knows both symbolic and numeric.  Order: binding, study, identification, motion, drift, benchmark,
noise, studies, recording, report.  Figures and HTML are unknown here.
"""
