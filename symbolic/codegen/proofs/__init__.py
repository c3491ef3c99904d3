"""What is certain about generated code: rounding over the whole domain, truncation, and scripts for other provers.

Reads the operations of ``ridgeback.symbolic.codegen.program``; writes lines of documentation.
"""
