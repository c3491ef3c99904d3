"""A motion under slowly drifting parameters: omega0(t) by the action, held against the integrated solution.

Knows the comparison of a motion; makes what a report shows of it.
"""
