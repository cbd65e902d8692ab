"""Run a command and print what it took, as JSON: a script by itself, that imports nothing large.

The most memory that Linux tells of a process is at least what the one held that started it.
"""

import json
import os
import sys
import time

if __name__ == "__main__":
    quiet = (os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)
    begun = time.perf_counter()
    process = os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ, file_actions=[quiet])
    _, status, usage = os.wait4(process, 0)
    real = time.perf_counter() - begun
    cpu = usage.ru_utime + usage.ru_stime  # of its own processes too, once they have ended
    print(json.dumps({"cpu": cpu, "real": real, "memory": usage.ru_maxrss / 1024}))
    sys.exit(os.waitstatus_to_exitcode(status) and 1)
