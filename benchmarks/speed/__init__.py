"""Time and memory, beside what is written by hand for one equation and beside what was predicted."""
