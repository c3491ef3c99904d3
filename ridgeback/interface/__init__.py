"""The verbs as functions: what the command line does, from Python, with objects and arrays in place of files.

May import every room and the console; knows no options, and computes nothing of its own.
"""
