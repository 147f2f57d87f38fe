"""Find what only POSIX systems have, where no branch asks for the system first.

Names are searched in the syntax tree; a use counts as having a branch if an `if` or `try` around it
or before it in the same function asks for the platform, or whether the name is there.
"""

import ast
from collections.abc import Iterator
from pathlib import Path

MODULES = {"curses", "fcntl", "grp", "posix", "pty", "pwd", "readline", "resource", "syslog",
           "termios", "tty"}  # fmt: skip
NAMES = {
    "asyncio": {"open_unix_connection", "start_unix_server"},
    "multiprocessing": {"get_context"},  # with the FORKS below
    # on Windows, execv hands the prompt back, kill ends a process at once, and getppid names one
    # that has ended
    "os": {
        "O_CLOEXEC", "O_DIRECTORY", "O_NOFOLLOW", "O_NONBLOCK", "chown", "execl", "execv", "execve",
        "execvp", "fchmod", "fchown", "fork", "forkpty", "getegid", "geteuid", "getgid",
        "getloadavg", "getpgid", "getpgrp", "getppid", "getuid", "kill", "killpg", "lchown",
        "mkfifo", "nice", "pipe2", "pread", "pwrite", "register_at_fork", "sched_getaffinity",
        "sched_setaffinity", "setpgid", "setpriority", "setsid", "statvfs", "sysconf", "uname",
        "wait", "wait3", "wait4",
    },
    "select": {"epoll", "kqueue", "poll"},
    "signal": {
        "ITIMER_REAL", "SIGALRM", "SIGCHLD", "SIGCONT", "SIGHUP", "SIGKILL", "SIGPIPE", "SIGQUIT",
        "SIGSTOP", "SIGTSTP", "SIGUSR1", "SIGUSR2", "SIGWINCH", "alarm", "pause", "pthread_kill",
        "pthread_sigmask", "setitimer", "sigwait",
    },
    "socket": {"AF_UNIX", "MSG_DONTWAIT", "MSG_ERRQUEUE", "MSG_NOSIGNAL", "SO_REUSEADDR",
               "SO_REUSEPORT"},
    "time": {"clock_gettime", "tzset"},
}  # fmt: skip
"""Names of modules that are missing on Windows, or do something else there."""
METHODS = {"add_signal_handler", "create_unix_connection", "create_unix_server", "recvmsg",
           "remove_signal_handler", "sendmsg"}  # fmt: skip
ARGUMENTS = {"preexec_fn", "start_new_session"}
PARTS_OF_USES = [
    *METHODS,
    *ARGUMENTS,
    *(f"{word} {module}" for word in ("import", "from") for module in [*MODULES]),
    *(f"from {module} import" for module in NAMES),
    *(f"{module}.{name}" for module, names in NAMES.items() for name in names),
]
"""One of them is in each file with a use; to parse all files would take seconds."""
FORKS = "'fork'", "'forkserver'"
ASKS = "sys.platform", "os.name", "hasattr(", "platform.system("
"""Parts of a condition that asks for the system."""
MISSING_ERRORS = "AttributeError", "ImportError", "NotImplementedError"


def uses_without_branch(path: Path) -> list[str]:
    """Return the uses in a file that have no branch, as ``file:line name``."""
    text = path.read_text(encoding="utf-8")
    if not any(part in text for part in PARTS_OF_USES):
        return []
    tree = ast.parse(text)
    asks = ASKS + tuple(_constants(tree))
    return [f"{path}:{line} {name}" for line, name in _find(tree, asks, False)]


def _constants(tree: ast.Module) -> Iterator[str]:
    """Give the module's constants whose value asks for the system."""
    for node in tree.body:
        if isinstance(node, ast.Assign) and _asks(node.value, ASKS):
            yield from (each.id for each in node.targets if isinstance(each, ast.Name))


def _asks(node: ast.expr, asks: tuple[str, ...]) -> bool:
    text = ast.unparse(node)
    return any(each in text for each in asks)


def _find(node: ast.AST, asks: tuple[str, ...], has_branch: bool) -> Iterator[tuple[int, str]]:
    if isinstance(node, ast.If | ast.IfExp) and _asks(node.test, asks):
        has_branch = True
    if isinstance(node, ast.keyword) and _asks(node.value, asks):
        has_branch = True
    if isinstance(node, ast.Try) and any(
        handler.type and any(each in ast.unparse(handler.type) for each in MISSING_ERRORS)
        for handler in node.handlers
    ):
        has_branch = True
    if not has_branch:
        yield from ((node.lineno, name) for name in _names(node))  # type: ignore[attr-defined]
    for _, value in ast.iter_fields(node):
        has_one = has_branch
        for child in value if isinstance(value, list) else [value]:
            if not isinstance(child, ast.AST):
                continue
            yield from _find(child, asks, has_one)
            # what follows `if sys.platform == "win32": return` is for the others
            has_one |= isinstance(child, ast.If) and _asks(child.test, asks) and _leaves(child)


def _leaves(branch: ast.If) -> bool:
    last = branch.body[-1]
    if isinstance(last, ast.Expr) and ast.unparse(last).startswith("sys.exit("):
        return True
    return isinstance(last, ast.Return | ast.Raise | ast.Continue | ast.Break)


def _names(node: ast.AST) -> Iterator[str]:
    """Give what only POSIX has in one node, without its children."""
    match node:
        case ast.Import(names=names):
            yield from (each.name for each in names if each.name in MODULES)
        case ast.ImportFrom(module=str(module), names=names):
            if module in MODULES:
                yield module
            known = NAMES.get(module, set())
            yield from (f"{module}.{each.name}" for each in names if each.name in known)
        case ast.Call(func=ast.Attribute(value=ast.Name(id="multiprocessing"), attr="get_context")):
            if node.args and ast.unparse(node.args[0]) in FORKS:
                yield "multiprocessing.get_context"
        case ast.Attribute(value=ast.Name(id=module), attr=name) if name in NAMES.get(module, ()):
            if module != "multiprocessing":
                yield f"{module}.{name}"
        case ast.Attribute(attr=name) if name in METHODS:
            yield name
        case ast.keyword(arg=str(name)) if name in ARGUMENTS:
            yield name
