"""The catalogue's oscillators as data: equation, values, potential, exact frequency, the work each is taken from.

Nothing here is read by SymPy before an oscillator is asked for; ``catalogue`` makes it.
"""
