"""The tabs and forms of the side panel."""
