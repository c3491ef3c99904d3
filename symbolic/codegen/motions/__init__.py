"""Code for what goes on in time: u(t) from its harmonics, the transient of a slow flow, and the sines that they need.

All of it in the operations of ``ridgeback.symbolic.codegen.program``, so that it too is the same in every language.
"""
