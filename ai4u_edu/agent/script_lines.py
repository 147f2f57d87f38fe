"""Python code that drives an agent from another process."""

from keyword import iskeyword

from ai4u_edu.agent.agent import BasicAgent


def script_lines(address: str, agent: BasicAgent) -> str:
    """Return the code of a script that drives an agent.

    Names are inserted by ``repr``, so a hostile name can't inject code.

    Args:
        address: the world's address, as of its page.
        agent: the agent.
    """
    example = {
        name: [1] + [0] * (len(actuator.limits()[0]) - 1)
        for name, actuator in agent.bound_blocks.actuators.items()
        if actuator.is_output
    }
    if all(name.isidentifier() and not iskeyword(name) for name in example):
        numbers = ", ".join(f"{name}={values}" for name, values in example.items())
    else:
        numbers = repr(example)
    return (
        "from ai4u_edu.remote import connect\n\n"
        f"robot = connect({address!r}, agent={agent.id!r})\n"
        "robot.reset()\n"
        "for percept in robot:\n"
        f"    robot.act({numbers})\n"
        "robot.close()\n"
    )
