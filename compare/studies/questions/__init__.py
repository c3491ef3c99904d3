"""Questions by name: each reduces the finished cells of a study to a table, a picture and sentences.

A question computes no cell; cells that have a reason in the place of values are counted and left out.
"""
