"""Exact expansions of oscillators: equations in, frequencies as rational series out.

Read the folders in this order: arithmetic, grammar, systems, series, expansion, high_order, singularities,
resummation, enclosure, cycles, flow, certificates, codegen.  Each may import those before it.  No float stands in a
derivation; numpy is unknown here.
"""
