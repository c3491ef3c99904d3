"""How a function is evaluated in each mode: Horner's rule plain, in parts, with exact leading terms, or compensated.

Reads and makes the operations of ``ridgeback.symbolic.codegen.program``; which is taken, the proved bounds decide.
"""
