"""What is measured and not tested: how often intervals hold, time and memory, other packages beside ours.

A table in ``docs/results`` names the command that prints it; every module is run from the root of the tree, as
``python -m benchmarks.trials.confusion``, and what begins with ``test_`` by ``python -m pytest benchmarks``.
"""
