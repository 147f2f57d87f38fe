"""Episodes as files for other programs: CSV, GIF and MP4, a web page."""
