"""From a finished formula to the coefficient form: which functions there are, and what must be said.

Series, slow flows, rational powers, quotients and closed forms; each file makes a ``Form`` of one kind of result.
"""
