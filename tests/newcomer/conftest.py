collect_ignore = ["robot.py"]  # it is loaded as a newcomer's file is, not imported from here
