"""Cheats: what a dishonest student's program tries, and who stops it.

Each is the source of a function `attack`, run once when the file is imported; it prints "cheated"
where nothing else shows its success. RESULTS, TASKS, CHECKOUT, GRADER, PORT and SERVICE stand for
what the cheat would first have to find out: the results' and the task file's paths, Lucida's
folder, the grader's process id, a port and a socket on which somebody listens.
"""

from __future__ import annotations

SCORE = '{"score": 999, "tests": [], "output": "cheated"}'
WRITES = f"open(RESULTS, 'w').write({SCORE!r})"
# name: who stops it, source. Walls: bubblewrap or Landlock.
SYSTEM = {
    "write the results by their path": ("walls", WRITES),
    "rename another file to the results": (
        "walls",
        f"open('mine', 'w').write({SCORE!r}); os.replace('mine', RESULTS)",
    ),
    "delete the results": ("walls", "os.unlink(RESULTS)"),
    "make the results a link": ("walls", "os.symlink('/tmp/elsewhere', RESULTS + '.html')"),
    "write beside the results": (
        "walls",
        "open(os.path.join(os.path.dirname(RESULTS), 'left'), 'w')",
    ),
    "find the results in a parent's command line": (
        "walls",
        """
    words = open(f'/proc/{os.getppid()}/cmdline').read().split(chr(0))
    words += open(f'/proc/{GRADER}/cmdline').read().split(chr(0))
    open(words[words.index('--json') + 1], 'w').write('999')
    """,
    ),
    "search all command lines": (
        "walls",
        """
    for process in os.listdir('/proc'):
        words = open(f'/proc/{process}/cmdline').read().split(chr(0)) if process.isdigit() else []
        assert 'results.json' not in str(words), print('cheated')
    """,
    ),
    "take the results from the environment": (
        "walls",
        "assert 'results' not in str(os.environ).lower(), print('cheated')",
    ),
    "a daemon that writes when the check is over": (
        "supervisor",
        f"""
    if os.fork() == 0:
        os.setsid()
        if os.fork():
            os._exit(0)
        os.closerange(0, 256)
        os.environ.clear()
        while True:
            time.sleep(0.05)
            try: {WRITES}
            except OSError: pass
    """,
    ),
    "a daemon that becomes another program": (
        "supervisor",
        """
    subprocess.Popen(['/bin/sh', '-c', 'while :; do sleep 1000000; done'], env={}, stdin=-3,
                     stdout=-3, stderr=-3, start_new_session=True, cwd='/')
    """,
    ),
    "kill the grader": ("walls", "os.kill(GRADER, 9)"),
    "stop the grader": ("walls", "os.kill(GRADER, 19)"),
    "kill the parent": ("walls", "assert os.getppid() > 1; os.kill(os.getppid(), 9)"),
    "stop the parent": (
        "walls",
        """
    os.kill(os.getppid(), 19)
    state = open(f'/proc/{os.getppid()}/stat').read().split()[2]
    assert state not in 'tT', print('cheated')
    """,
    ),
    "kill the group of the grader": ("walls", "os.killpg(os.getpgid(GRADER), 9)"),
    "trace the grader": (
        "walls",
        "assert libc.ptrace(16, GRADER, 0, 0) < 0, print('cheated')",
    ),
    "read the grader's memory": ("walls", "open(f'/proc/{GRADER}/mem', 'rb').read(1)"),
    "read the memory by process_vm_readv": (
        "walls",
        """
    held = ctypes.create_string_buffer(64)
    vector = (ctypes.c_size_t * 2)(ctypes.addressof(held), 64)
    assert libc.process_vm_readv(GRADER, vector, 1, vector, 1, 0) < 0, print('cheated')
    """,
    ),
    "write into the grader's memory": ("walls", "open(f'/proc/{GRADER}/mem', 'r+b').write(b'x')"),
    "take the grader's descriptors": (
        "walls",
        """
    file = libc.syscall(438, libc.syscall(434, GRADER, 0), 1, 0)
    assert file < 0, print('cheated')
    """,
    ),
    "write into the grader's output": ("walls", "open(f'/proc/{GRADER}/fd/1', 'w').write('999')"),
    "take away the grader's limits": (
        "walls",
        "__import__('resource').prlimit(GRADER, 1, (0, 0))",
    ),
    "use inherited descriptors": (
        "supervisor",
        """
    for number in range(3, 999):
        try: name = os.readlink(f'/proc/self/fd/{number}')
        except OSError: continue
        assert name.startswith(('pipe:', '/dev/null', '/proc/')), print('cheated')
    """,
    ),
    "import Lucida": ("hook", "import renderer, app, shaders"),
    "import Lucida without the hook": (
        "walls",
        """
    sys.meta_path[:] = [one for one in sys.meta_path if type(one).__name__ != 'StudentFile']
    from renderer.camera import Camera
    """,
    ),
    "import Lucida from its folder": (
        "walls",
        """
    sys.meta_path[:] = [one for one in sys.meta_path if type(one).__name__ != 'StudentFile']
    sys.path.insert(0, CHECKOUT)
    from renderer.camera import Camera
    """,
    ),
    "load a file of Lucida": (
        "walls",
        """
    from importlib.util import spec_from_file_location as of
    spec = of('c', CHECKOUT + '/renderer/camera.py')
    spec.loader.get_code('c')
    """,
    ),
    "search for Lucida beside numpy": (
        "walls",
        """
    import numpy
    for folder in (*sys.path, os.path.dirname(os.path.dirname(numpy.__file__)), '..', '/'):
        if os.path.exists(path := os.path.join(folder, 'renderer', 'camera.py')):
            open(path).read()
            print('cheated')
    raise OSError
    """,
    ),
    "run Lucida": (
        "walls",
        """
    command = [CHECKOUT + '/.venv/bin/python', '-c', 'import renderer.camera']
    assert subprocess.run(command, cwd=CHECKOUT).returncode, print('cheated')
    """,
    ),
    "read the task file": ("walls", "open(TASKS).read()"),
    "take away the walls": (
        "walls",
        """
    libc.unshare(0x10020000)
    for path in (TASKS, RESULTS, CHECKOUT + '/renderer', '/proc'):
        libc.umount2(path.encode(), 2)
    libc.mount(b'/', b'/', None, 0x1000 | 0x20, None)
    open(TASKS).read()
    """,
    ),
    "leave by chroot": (
        "walls",
        "os.chroot(tempfile.mkdtemp()); [os.chdir('..') for _ in range(99)]; open(TASKS)",
    ),
    "let the kernel run a program": ("walls", "open('/proc/sys/kernel/core_pattern', 'a')"),
    "mount /proc anew": (
        "walls",
        """
    libc.unshare(0x30020000)
    process = os.fork()
    if process == 0:
        libc.mount(b'proc', b'/tmp', b'proc', 0, None)
        libc.mount(b'proc', b'/dev/shm', b'proc', 0, None)
        for folder in ('/tmp', '/dev/shm'):
            try: open(folder + '/sys/kernel/core_pattern', 'a'); os._exit(7)
            except OSError: pass
        os._exit(0)
    assert os.waitpid(process, 0)[1] == 0, print('cheated')
    """,
    ),
    "make a device of the disk": ("walls", "os.mknod(tempfile.mkdtemp() + '/d', 0o60600, 1 << 8)"),
    "become another user": ("walls", "os.setuid(12345); open(TASKS)"),
    "remember for the next time": ("walls", "open('asked.json', 'w').write('[1, 2, 3]')"),
    "ask another machine": (
        "walls",
        "socket.create_connection(('127.0.0.1', PORT), 5); print('cheated')",
    ),
    "ask by UDP": (
        "walls",
        """
    udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    udp.connect(('127.0.0.1', PORT))
    udp.send(b'?')
    udp.settimeout(0.1)
    udp.recv(1)
    """,
    ),
    "ask a service of this machine": (
        "walls",
        "socket.socket(socket.AF_UNIX).connect(SERVICE); print('cheated')",
    ),
    "open the results to others": (
        "walls",
        """
    for change in (lambda: os.chmod(os.path.dirname(RESULTS), 0o777), lambda: os.chmod(RESULTS, 7)):
        try: change()
        except OSError: pass
    assert os.path.exists(RESULTS) <= (os.stat(RESULTS).st_mode & 7 != 7), print('cheated')
    """,
    ),
    "hold memory as files of no process": (
        "limits",
        "held = [os.memfd_create('x') for _ in range(9)]; print('cheated')",
    ),
    "leave shared memory behind": (
        "walls",
        "libc.shmget(0x4C756369, 1 << 20, 0o1777); raise OSError",
    ),
    "ask the machine's host": ("walls", "socket.socket(40, 1); print('cheated')"),
    "hide folders in one another": (
        "supervisor",
        """
    os.chdir(tempfile.gettempdir())
    for _ in range(2000): os.mkdir('d'); os.chdir('d')
    raise OSError
    """,
    ),
    "fill the disk": (
        "limits",
        "file = tempfile.TemporaryFile(buffering=0); [file.write(bytes(2**20)) for _ in range(99)]",
    ),
}

# Cheats of answers: the whole program.
ANSWERS = {
    "an answer that is equal to all": (
        "JSON",
        """
class Any(float):
    __eq__ = __lt__ = __le__ = lambda *other: True
    __sub__ = __rsub__ = __abs__ = lambda *other: 0.0
def memory_offset(i, j, width): return Any(3)
""",
    ),
    "not a number": ("tolerances", "def memory_offset(i, j, width): return float('nan')"),
    "infinite": ("tolerances", "def memory_offset(i, j, width): return float('inf')"),
    "too large": ("tolerances", "def memory_offset(i, j, width): return 10 ** 400"),
    "no answer at all": ("shapes", "def memory_offset(i, j, width): return []"),
    "all answers at once": (
        "shapes",
        "def memory_offset(i, j, width): return [[*range(99)]] * 9",
    ),
    "replace json": (
        "supervisor",
        """
import json
json.dumps = json.JSONEncoder.encode = json.JSONEncoder.iterencode = lambda *a: '{"score": 999}'
def memory_offset(i, j, width): return 0
""",
    ),
    "replace our functions through frames": (
        "grader",
        """
import sys
frame = sys._getframe()
while frame:
    for name in ("written", "encode", "answer"):
        if name in frame.f_globals: frame.f_globals[name] = lambda *given: "true"
    frame = frame.f_back
def memory_offset(i, j, width): return 0
""",
    ),
    "look for the right answers with gc": (
        "grader",
        """
import gc
def memory_offset(i, j, width):
    for one in gc.get_objects():
        if type(one) is dict and ("right" in one or "expected" in one or "answers" in one):
            return [*one.values()][0]
    return 0
""",
    ),
    "answer before being asked": (
        "grader",
        """
import os
for number in range(3, 64):
    try: os.write(number, b"a0\\n" * 4096)
    except OSError: pass
def memory_offset(i, j, width): return 0
""",
    ),
    "end in the middle with status 0": (
        "grader",
        """
import os
def memory_offset(i, j, width):
    if i + j > 2: os._exit(0)
    return i * width + j
""",
    ),
    "sys.exit as an answer": (
        "grader",
        "import sys\ndef memory_offset(i, j, width): sys.exit(0)",
    ),
    "half of the answers, then time": (
        "limits",
        """
def memory_offset(i, j, width):
    while i + j > 2: pass
    return i * width + j
""",
    ),
    "print the results": (
        "grader",
        f"def memory_offset(i, j, width): print({SCORE!r}); return 0",
    ),
    "raise every limit": (
        "limits",
        """
import resource
def memory_offset(i, j, width):
    try: resource.setrlimit(resource.RLIMIT_AS, (-1, -1))
    except (ValueError, OSError): return 0
    while True: held = [bytearray(1 << 20) for _ in range(900)]
""",
    ),
}

# Answers in our process' stead: the first line, for the file, and the next ones, for calls.
FORGED = """
import os, sys
channel, frame = None, sys._getframe()
while frame:
    channel = [v for v in list(frame.f_locals.values()) if type(v).__name__ == "Channel"] or channel
    frame = frame.f_back
def say(text): os.write(channel[0]._answers, text.encode() + b"\\n")
say({first!r})
while True:
    for call in channel[0].next()["calls"]: say({then!r})
"""
_HAS, _FAILS = '{"functions": ["memory_offset"], "own": [], "files": []}', '"where": "", "lines": '
FORGERIES = {
    "names": ('i{"functions": [[1]], "own": [], "files": []}', "a0"),
    "text": ("i" + _HAS, 'f{"kind": "exception", "text": 5, ' + _FAILS + "[]}"),
    "kind": ("i" + _HAS, 'f{"kind": [], "text": "t", ' + _FAILS + "[]}"),
    "lines": ("i" + _HAS, 'f{"kind": "exception", "text": "t", ' + _FAILS + "[1, {}]}"),
    "import": ('f{"kind": "exception", "text": 5, "files": [], ' + _FAILS + "[]}", ""),
}
