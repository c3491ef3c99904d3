"""The target languages of generated code, one file each, and those that other distributions add.

All of them print the same operations in the same order (``ridgeback.symbolic.codegen.program``); none of them knows
what an oscillator is.
"""
