# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""A server of the files of one folder, for pages that need one."""

import functools
import http.server
import threading


class Handler(http.server.SimpleHTTPRequestHandler):
    """Sends files; a path with `?strict` gets the narrowest policy that the package needs."""

    extensions_map = {".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript"}

    def end_headers(self):
        if self.path.endswith("?strict"):
            policy = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; img-src data:"
            self.send_header("Content-Security-Policy", policy)
        super().end_headers()

    def log_message(self, *_):
        """Says nothing."""


class Server:
    """Serves a folder on a free port of this machine while it is entered; `address` is where."""

    def __init__(self, folder):
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=folder))
        self.address = f"http://127.0.0.1:{self.server.server_port}"

    def __enter__(self):
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        return self

    def __exit__(self, *_):
        self.server.shutdown()
        self.server.server_close()
