"""Messages from a page's panel: what the page looks at, and commands.

They are checked strictly: no unknown fields, no conversion of types, bounded texts and numbers.
"""
