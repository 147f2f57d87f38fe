"""A running world's page: its server, drawing, panel and editing."""
