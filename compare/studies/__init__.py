"""Studies: many cells asked for by one file, computed in blocks on any executor, kept in a store, answered by name.

Knows everything that a cell may be made of; a plan says what is asked, a task computes a block of cells, a store keeps
what is done, a question reduces the cells to a table, a picture and sentences.
"""
