# SPDX-License-Identifier: BSD-3-Clause
"""Chromium without a window, driven over a pipe by its DevTools protocol (standard library only)."""
import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time


def find_chromium():
    """None: this machine has no Chromium."""
    names = ('chromium', 'chromium-browser', 'google-chrome')
    return next(filter(None, map(shutil.which, names)), None)


class Browser:
    """One page. Messages of its console and uncaught exceptions gather in `problems`."""

    def __init__(self, program):
        self.folder = tempfile.mkdtemp(prefix='sslcd_browser_')
        to_read, self.to = os.pipe()
        self.back, to_write = os.pipe()
        arguments = [program, '--headless=new', '--remote-debugging-pipe', '--no-sandbox', '--no-first-run', '--disable-dev-shm-usage',
                     '--disable-extensions', '--disable-background-networking', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
                     '--hide-scrollbars', f'--user-data-dir={self.folder}', 'about:blank']
        shell = ['/bin/sh', '-c', f'exec "$@" 3<&{to_read} 4>&{to_write}', 'sh', *arguments]
        self.process = subprocess.Popen(shell, pass_fds=(to_read, to_write), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                        env={**os.environ, 'HOME': self.folder})
        os.close(to_read)
        os.close(to_write)
        self.buffer, self.count, self.session, self.problems = b'', 0, None, []
        target = self.call('Target.createTarget', url='about:blank')['targetId']
        self.session = self.call('Target.attachToTarget', targetId=target, flatten=True)['sessionId']
        for domain in ('Page', 'Runtime', 'Log'):
            self.call(domain + '.enable')

    def close(self):
        self.session = None
        try:
            self.call('Browser.close')
            self.process.wait(10)
        except (OSError, EOFError, TimeoutError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        os.close(self.to)
        os.close(self.back)
        shutil.rmtree(self.folder, ignore_errors=True)

    def message(self, deadline):
        while b'\0' not in self.buffer:
            if not select.select([self.back], [], [], max(0, deadline - time.monotonic()))[0]:
                raise TimeoutError('the browser does not answer')
            received = os.read(self.back, 1 << 20)
            if not received:
                raise EOFError('the browser has ended')
            self.buffer += received
        text, self.buffer = self.buffer.split(b'\0', 1)
        message = json.loads(text)
        parameters = message.get('params', {})
        if message.get('method') == 'Runtime.exceptionThrown':
            details = parameters['exceptionDetails']
            self.problems.append(details.get('exception', {}).get('description', details['text']))
        elif message.get('method') == 'Runtime.consoleAPICalled' and parameters['type'] in ('error', 'assert'):
            self.problems.append(' '.join(str(a.get('value', a.get('description'))) for a in parameters['args']))
        elif message.get('method') == 'Log.entryAdded' and parameters['entry']['level'] == 'error':
            self.problems.append(parameters['entry']['text'])
        return message

    def call(self, method, **parameters):
        self.count += 1
        request = {'id': self.count, 'method': method, 'params': parameters}
        if self.session:
            request['sessionId'] = self.session
        os.write(self.to, json.dumps(request).encode() + b'\0')
        deadline = time.monotonic() + 60
        while True:
            message = self.message(deadline)
            if message.get('id') == self.count:
                if 'error' in message:
                    raise RuntimeError(f'{method}: {message["error"]}')
                return message['result']

    def open(self, path, width, height, ready="window.report && window.report.world.first_frame_ms"):
        self.call('Emulation.setDeviceMetricsOverride', width=width, height=height, deviceScaleFactor=1, mobile=width < 600)
        self.call('Page.navigate', url='file://' + os.path.abspath(path))
        self.wait(ready, 60)

    def run(self, script):
        """The value of a JavaScript expression; a promise is awaited."""
        result = self.call('Runtime.evaluate', expression=script, returnByValue=True, awaitPromise=True, userGesture=True)
        if 'exceptionDetails' in result:
            raise RuntimeError(result['exceptionDetails'].get('exception', {}).get('description', str(result)))
        return result['result'].get('value')

    def wait(self, condition, seconds=20):
        deadline = time.monotonic() + seconds
        while not self.run(f'Boolean({condition})'):
            if time.monotonic() > deadline:
                raise TimeoutError(f'not within {seconds} s: {condition}')
            time.sleep(0.05)

    def screenshot(self, path, whole=False):
        with open(path, 'wb') as file:
            file.write(base64.b64decode(self.call('Page.captureScreenshot', captureBeyondViewport=whole)['data']))
