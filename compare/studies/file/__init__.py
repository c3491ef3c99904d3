"""The TOML file of a study: read whole, checked whole, every message with file, line and key.

Text is parsed by the standard library's reader and never evaluated; decimals keep the digits that they are
written with.
"""
