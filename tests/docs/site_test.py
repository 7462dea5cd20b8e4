#!/usr/bin/env python3
"""Builds the documentation site without warnings and reads it in a browser: types a search and opens its first
result.

    site_test.py --source DIRECTORY

Exits with code 77 and a message if MkDocs or a browser is missing.
"""
import argparse
import functools
import http.server
import json
import os
import queue
import re
import shutil
import subprocess
import sys
import tempfile
import threading

# Types into the search field, waits for results, and sends them to the server of the test.
READER = """<script>addEventListener('load', () => {
  const query = document.querySelector('[data-md-component=search-query]');
  query.focus();
  query.value = 'rattlers';
  query.dispatchEvent(new KeyboardEvent('keyup', {key: 's'}));
  const began = Date.now();
  const look = setInterval(() => {
    const links = Array.from(document.querySelectorAll('a.md-search-result__link'));
    if (!links.length && Date.now() - began < 60000) return;
    clearInterval(look);
    const images = Array.from(document.images);
    fetch('/seen', {method: 'POST', body: JSON.stringify({
      results: links.map(a => [a.href, a.textContent.trim()]),
      images: images.length, shown: images.filter(i => i.complete && i.naturalWidth > 1).length,
      fetched: performance.getEntriesByType('resource').map(r => r.name)})});
  }, 100);
});</script>"""


class Handler(http.server.SimpleHTTPRequestHandler):
    seen = queue.Queue()

    def do_GET(self):
        if self.path != "/":
            return super().do_GET()
        page = open(os.path.join(self.directory, "index.html"), encoding="utf-8").read()
        page = page.replace("</body>", READER + "</body>").encode()
        self.send_response(200)
        self.send_header("Content-Type", "text/html; charset=utf-8")
        self.send_header("Content-Length", str(len(page)))
        self.end_headers()
        self.wfile.write(page)

    def do_POST(self):
        self.seen.put(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
        self.send_response(204)
        self.end_headers()

    def log_message(self, *_):
        pass


def browse(browser, site, directory):
    """Returns the results that the browser showed on the first page, and the messages that it logged."""
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=site))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    address = f"http://127.0.0.1:{server.server_port}/"
    with open(os.path.join(directory, "log"), "w+", encoding="utf-8", errors="replace") as log:
        process = subprocess.Popen(
            [browser, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
             f"--user-data-dir={directory}/profile", "--enable-logging=stderr", "--remote-debugging-port=0", address],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=log)
        try:
            seen = Handler.seen.get(timeout=120)
        finally:
            process.terminate()
            process.wait()
            server.shutdown()
        log.seek(0)
        return address, seen, [line for line in log if "CONSOLE" in line]


def faults_of(site, address, seen, console):
    faults = [f"the browser logged {line.strip()}" for line in console]
    if seen["images"] < 1 or seen["shown"] != seen["images"]:
        faults.append(f"{seen['shown']} of {seen['images']} pictures of the first page are shown")
    faults += [f"the first page fetches {name}" for name in seen["fetched"] if not name.startswith(address)]
    if not seen["results"]:
        return faults + ["the search for 'rattlers' found nothing"]
    for href, words in seen["results"]:
        place = re.sub(r"[?#].*", "", href[len(address):])
        path = os.path.join(site, place, "index.html")
        if not os.path.exists(path):
            faults.append(f"the search leads to {href}, which is no page")
        elif "rattler" not in open(path, encoding="utf-8").read().lower():
            faults.append(f"the search leads to {href} ({words[:60]!r}), which says nothing of rattlers")
    return faults


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--source", required=True)
    source = parser.parse_args().source
    browser = next(filter(shutil.which, ("chromium", "chromium-browser", "google-chrome")), None)
    if not shutil.which("mkdocs"):
        print("NOT TESTED: mkdocs is not installed; on Debian: apt install mkdocs mkdocs-material")
        return 77
    with tempfile.TemporaryDirectory(prefix="floc-site-", ignore_cleanup_errors=True) as directory:
        site = os.path.join(directory, "site")
        built = subprocess.run([os.path.join(source, "docs/build"), site], capture_output=True, text=True)
        if built.returncode or built.stderr.strip():
            print(f"docs/build ends with {built.returncode}:\n{built.stdout}{built.stderr}")
            return 1
        if not browser:
            print("NOT TESTED beyond building: no chromium is installed (.ci/deps installs it)")
            return 77
        address, seen, console = browse(browser, site, directory)
        faults = faults_of(site, address, seen, console)
    for fault in faults:
        print("FAULT:", fault)
    print(f"{len(seen['results'])} results, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
