#!/usr/bin/env python3
"""The npm package in a headless Chromium: by script elements and from bundles, plain and inlined; and how soon it is ready.

Usage: browser_test.py PROJECT BUNDLER CHROMIUM. PROJECT is a folder in which the package is installed (tools/wasm_check.sh makes
it), BUNDLER one with esbuild. Exit status 77 means skipped, because there is no browser.
"""

import functools
import http.server
import pathlib
import subprocess
import sys
import threading
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "view"))
from devtools import Browser  # noqa: E402

project, bundler = pathlib.Path(sys.argv[1]).resolve(), str(pathlib.Path(sys.argv[2]).resolve())
chromium = sys.argv[3] if len(sys.argv) > 3 else ""
ANSWER = {"verdict": "contact", "time": 0.6398059071839116, "kind": "edge_edge", "refusal": "InvalidInput: moving: is no Polyhedron"}
RELOADS = 4


def module(file: str, workers: str = "undefined") -> str:
    """A page that imports a build from its place in node_modules."""
    address = f"/node_modules/chasles/{file}"
    return f'<script type="module">import {{ load }} from "{address}"; import {{ ask }} from "/question.mjs"; ask(load, {{}}, {workers})</script>'


def classic(question: str) -> str:
    """A page without modules: the question, which is a module elsewhere, stands in the page."""
    text = question.replace("export async", "async")
    return f'<script src="node_modules/chasles/script.js"></script><script>{text}; ask(chasles.load, {{}}, {{}})</script>'


class QuietHandler(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".js": "text/javascript", ".mjs": "text/javascript"}

    def log_message(self, *_: object) -> None:
        pass


class InABrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        subprocess.run(["node", "bundles.mjs", bundler, str(project / "bundles")], cwd=project, check=True)
        handler = functools.partial(QuietHandler, directory=str(project))
        cls.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
        threading.Thread(target=cls.server.serve_forever, daemon=True).start()

    @classmethod
    def tearDownClass(cls) -> None:
        cls.server.shutdown()
        cls.server.server_close()

    def open_once(self, name: str, body: str) -> dict:
        """Writes the page and opens it. Returns what it answers, which may be an error."""
        (project / f"{name}.html").write_text(f'<!doctype html><meta charset="utf-8"><title>{name}</title><link rel="icon" href="data:,">{body}\n')
        with Browser(chromium, 400, 300, patience=60) as browser:
            browser.open(f"http://127.0.0.1:{self.server.server_port}/{name}.html", "!!window.isDone")
            return browser.evaluate("window.answer")

    def ask(self, name: str, body: str, *, from_disk: bool = False) -> dict:
        """Writes the page and opens it several times in a new browser. Returns the first answer."""
        (project / f"{name}.html").write_text(f'<!doctype html><meta charset="utf-8"><title>{name}</title><link rel="icon" href="data:,">{body}\n')
        address = f"{project.as_uri()}/{name}.html" if from_disk else f"http://127.0.0.1:{self.server.server_port}/{name}.html"
        answers = []
        with Browser(chromium, 400, 300, patience=60) as browser:
            for _ in range(1 + RELOADS):
                browser.call("Page.navigate", url="about:blank")
                browser.open(address, "!!window.isDone")
                answers.append(browser.evaluate("window.answer"))
            requests = {e["params"]["request"]["url"] for e in browser.events if e["method"] == "Network.requestWillBeSent"}
        for answer in answers:
            self.assertNotIn("error", answer)
            self.assertEqual({key: answer[key] for key in ANSWER}, ANSWER)
        best = min(answers[1:], key=lambda answer: answer["ready"])
        print(f"  {name}: load() takes {answers[0]['load']:.0f} ms in a new browser, then {best['load']:.0f}; "
              f"the first answer comes {answers[0]['ready']:.0f} ms after the page begins to load, then {best['ready']:.0f}")
        self.assertLess(best["load"], 2000, "even on a busy machine")
        return {**answers[0], "fetches": any(request.endswith(".wasm") for request in requests)}

    def check_workers(self, answer: dict) -> None:
        self.assertEqual(answer["byWorkers"], 9 * [ANSWER["time"]])

    def test_modules_from_a_server(self) -> None:
        plain = self.ask("module_plain", module("index.js", "{}"))
        self.assertTrue(plain["fetches"])
        self.check_workers(plain)
        inlined = self.ask("module_inlined", module("inline.js", "{}"))
        self.assertFalse(inlined["fetches"])
        self.check_workers(inlined)

    def test_a_script_on_a_page_from_the_disk(self) -> None:
        self.check_workers(self.ask("script", classic((project / "question.mjs").read_text()), from_disk=True))

    def test_a_script_from_a_server(self) -> None:
        answer = self.ask("script_from_server", classic((project / "question.mjs").read_text()))
        self.assertFalse(answer["fetches"])
        self.check_workers(answer)

    def guarded(self, name: str, file: str, policy: str) -> str:
        """The body of a page with a policy, which forbids scripts in the page itself."""
        script = f'import {{ load }} from "/node_modules/chasles/{file}"; import {{ ask }} from "/question.mjs"; ask(load, {{}}, {{}});'
        (project / f"{name}.mjs").write_text(script)
        return f'<meta http-equiv="Content-Security-Policy" content="{policy}"><script type="module" src="/{name}.mjs"></script>'

    def test_content_security_policies(self) -> None:
        always = "default-src 'none'; img-src data:; script-src 'self' 'wasm-unsafe-eval'"
        for name, file, more in [("plain", "index.js", "connect-src 'self'; worker-src 'self'"), ("inlined", "inline.js", "worker-src blob:")]:
            self.check_workers(self.ask(f"policy_{name}", self.guarded(f"policy_{name}", file, f"{always}; {more}")))
            refused = self.open_once(f"strict_{name}", self.guarded(f"strict_{name}", file, f"default-src 'self' blob:; img-src data:"))
            self.assertEqual(
                refused, {"error": "InvalidInput: wasm: the Content-Security-Policy of the page forbids WebAssembly: its script-src needs 'wasm-unsafe-eval'"}
            )
            stuck = self.open_once(f"no_workers_{name}", self.guarded(f"no_workers_{name}", file, f"{always}; connect-src 'self'; worker-src 'none'"))
            self.assertIn("a worker cannot be started", stuck["error"])
            self.assertIn('import "chasles/inline"' if name == "plain" else "needs worker-src blob:", stuck["error"])

    def test_trusted_types(self) -> None:
        """As a page demands that gives addresses of scripts only by a policy of its own."""
        for name, file in [("plain", "index.js"), ("inlined", "inline.js")]:
            page = self.guarded(f"trusted_{name}", file, "require-trusted-types-for 'script'")
            self.assertRegex(self.open_once(f"untrusted_{name}", page)["error"], r"cannot be started: the page demands Trusted Types .* give workers\(\{ worker \}\)")
            script = project / f"trusted_{name}.mjs"
            worker = 'new Worker(trustedTypes.createPolicy("own", { createScriptURL: (url) => url }).createScriptURL("/node_modules/chasles/worker.js"), { type: "module" })'
            script.write_text(script.read_text().replace("ask(load, {}, {})", f"ask(load, {{}}, {{ count: 1, worker: () => {worker} }})"))
            self.check_workers(self.open_once(f"trusted_{name}", page))

    def test_a_service_worker(self) -> None:
        """It has no Worker: questions are answered, and the refusal of workers says where they can be."""
        (project / "service.mjs").write_text(
            'import { load } from "/node_modules/chasles/inline.js"; import { ask } from "/question.mjs"; globalThis.window = globalThis;'
            "onmessage = async ({ source }) => { await ask(load, {}, undefined); const { verdict } = window.answer; await ask(load, {}, {}); source.postMessage({ verdict, ...window.answer }); };"
        )
        asking = (
            'navigator.serviceWorker.onmessage = ({ data }) => { window.answer = data; window.isDone = true; };'
            'navigator.serviceWorker.register("/service.mjs", { type: "module" }).then(() => navigator.serviceWorker.ready).then(({ active }) => active.postMessage(null));'
        )
        answer = self.open_once("service_page", f'<script type="module">{asking}</script>')
        self.assertEqual(answer["verdict"], ANSWER["verdict"])
        self.assertRegex(answer["error"], r"^InvalidInput: workers: there is no Worker here, as in a service worker: make them in the page")

    def test_a_server_that_answers_with_a_page(self) -> None:
        """As development servers do for a file that they do not find."""
        (project / "fallback.html").write_text("<!doctype html>")
        script = '<script type="module">import { load } from "/node_modules/chasles/index.js"; import { ask } from "/question.mjs"; ask(load, { wasm: "fallback.html" })</script>'
        refused = self.open_once("fallback_page", script)["error"]
        self.assertRegex(refused, r"^InvalidInput: wasm: http://.*/fallback\.html is a web page, .*: import \"chasles/inline\"")

    def test_bundles(self) -> None:
        script = lambda name, kind: f'<script {kind}src="bundles/{name}/app.js"></script>'  # noqa: E731
        plain = self.ask("bundle_plain", script("plain", 'type="module" '))
        self.assertTrue(plain["fetches"])
        self.check_workers(plain)
        self.assertTrue(self.ask("bundle_loaded", '<base href="/bundles/loaded/">' + '<script type="module" src="app.js"></script>')["fetches"])
        inlined = self.ask("bundle_inlined", script("inlined", ""))
        self.assertFalse(inlined["fetches"])
        self.check_workers(inlined)
        self.ask("bundle_inlined_from_disk", script("inlined", ""), from_disk=True)


def main() -> int:
    if not chromium:
        print("skipped: no chromium")
        return 77
    return 0 if unittest.main(argv=sys.argv[:1], exit=False).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
