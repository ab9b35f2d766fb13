# SPDX-License-Identifier: GPL-3.0-or-later
# A Dask scheduler and workers as processes of their own, on loopback only, and
# a wire to the scheduler that can be cut.
import json
import os
import socket
import subprocess
import sys
import threading
import time

QUIET = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}


def wait_for(what, condition, seconds=60):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.05)
    raise AssertionError(f"{what}: not within {seconds} s")


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Processes:
    """Ends all of them when left."""

    def __init__(self, folder):
        self.folder = folder
        self.port = free_port()
        self.address = f"tcp://127.0.0.1:{self.port}"
        self.scheduler = None
        self.workers = []

    def __enter__(self):
        return self

    def __exit__(self, *error):
        for process in [*self.workers, self.scheduler]:
            if process is not None and process.poll() is None:
                process.kill()
                process.wait()

    def _start(self, module, *arguments):
        environment = dict(os.environ, OMP_NUM_THREADS="1",
                           DASK_DISTRIBUTED__WORKER__PROFILE__ENABLED="False")
        return subprocess.Popen(
            [sys.executable, "-m", f"distributed.cli.{module}", *arguments],
            env=environment, cwd=self.folder, **QUIET)

    def start_scheduler(self):
        self.scheduler = self._start(
            "dask_scheduler", "--host", "127.0.0.1", "--port", str(self.port),
            "--no-dashboard", "--no-show", "--dashboard-address", "127.0.0.1:0")
        wait_for("scheduler", self._listens)

    def _listens(self):
        with socket.socket() as one:
            return one.connect_ex(("127.0.0.1", self.port)) == 0

    def start_worker(self, *arguments):
        worker = self._start(
            "dask_worker", self.address, "--host", "127.0.0.1", "--nthreads",
            "1", "--no-dashboard", "--local-directory", str(self.folder),
            "--death-timeout", "60", *(arguments or ("--no-nanny",)))
        self.workers.append(worker)
        return worker

    def kill(self, process):
        process.kill()
        process.wait()


class Wire:
    """Carries what comes to its port to another one; cut() ends all there is
    and lets nothing through until restore()."""

    def __init__(self, port):
        self._to = port
        self._lock = threading.Lock()
        self._open = []
        self._is_cut = False
        self._socket = socket.create_server(("127.0.0.1", 0))
        self.address = f"tcp://127.0.0.1:{self._socket.getsockname()[1]}"
        threading.Thread(target=self._accept, daemon=True).start()

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self._socket.close()
        self.cut()

    def cut(self):
        with self._lock:
            self._is_cut = True
            for one in self._open:
                try:
                    one.shutdown(socket.SHUT_RDWR)
                except OSError:  # its end was closed
                    pass
            self._open.clear()

    def restore(self):
        with self._lock:
            self._is_cut = False

    def _accept(self):
        while True:
            try:
                near, _ = self._socket.accept()
            except OSError:
                return
            with self._lock:
                if self._is_cut:
                    near.close()
                    continue
                far = socket.create_connection(("127.0.0.1", self._to))
                self._open += [near, far]
            for a, b in ((near, far), (far, near)):
                threading.Thread(target=self._carry, args=(a, b),
                                 daemon=True).start()

    @staticmethod
    def _carry(a, b):
        try:
            while data := a.recv(65536):
                b.sendall(data)
            b.shutdown(socket.SHUT_WR)
        except OSError:
            pass


def rows_in(path):
    """Whole rows of a file that is perhaps not there, or being written."""
    if not path.exists():
        return []
    data = path.read_bytes()
    return [json.loads(line) for line in data[:data.rfind(b"\n") + 1].splitlines()]
