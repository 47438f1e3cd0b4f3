/** Finds the system's Chromium; no browser is ever downloaded. */
import { existsSync } from 'node:fs';
import { delimiter, join } from 'node:path';

const NAMES = ['chromium', 'chromium-browser', 'google-chrome'];

/** @returns {import('@playwright/test').LaunchOptions} */
export function systemChromium() {
  return {
    executablePath: chromiumPath(),
    ignoreDefaultArgs: ['--enable-unsafe-swiftshader'],
    args: [
      '--no-sandbox', // containers have no user namespaces
      '--disable-gpu',
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
    ],
  };
}

/** @returns {string} */
function chromiumPath() {
  const folders = (process.env.PATH ?? '').split(delimiter);
  const found = NAMES.flatMap((name) => folders.map((folder) => join(folder, name))).find((path) => existsSync(path));
  if (!found) throw new Error(`No Chromium on the PATH (${NAMES.join(', ')}); on Debian: apt-get install chromium`);
  return found;
}
