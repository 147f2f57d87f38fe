"""The process of a program on a system that does not let it leave the others' namespaces."""

from unittest import mock

from ai4u_edu.games.tournament import python_child

if __name__ == "__main__":
    with mock.patch.object(python_child, "_leave_namespaces", return_value=False):
        python_child.main()
