"""A small learner to read, in NumPy alone: a network, cloning, PPO, and the file it writes.

Each file adds one idea. Read them in this order:

1. :mod:`~ai4u_edu.learn.small.neural_network`: layers of neurons, and how they are changed.
2. :mod:`~ai4u_edu.learn.small.actor_critic`: from readings to an action, and to its worth.
3. :mod:`~ai4u_edu.learn.small.behaviour_cloning`: learn from somebody's drives.
4. :mod:`~ai4u_edu.learn.small.ppo`: learn from rewards.
5. :mod:`~ai4u_edu.learn.small.easy_starts`: learn near the goal first.
6. :mod:`~ai4u_edu.learn.small.opponents`: learn against somebody, or against itself.
7. :mod:`~ai4u_edu.learn.small.ppo_training`: check, keep the best, go on after a break.
8. :mod:`~ai4u_edu.learn.small.onnx_file`: the file of a network.

It needs neither torch nor Stable-Baselines3; see ``docs/adr/0014-a-small-learner-of-our-own.md``.
"""
