"""Equations as text: tokens, expression tree, parser, and the way from the tree to SymPy.

Text is never evaluated.  Knows what may be written, not what an oscillator is.
"""
