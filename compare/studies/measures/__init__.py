"""Kinds of cells: what a study can compute, each with its coordinates, its values and its blocks.

A measure knows how its cells are found and nothing of the questions that are answered from them.
"""
